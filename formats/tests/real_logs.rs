//! Logs of real trainers, where they are at hand: nothing of them is lost.

use std::fs;
use std::path::PathBuf;

use goodbot_formats::posterior::PosteriorLine;
use goodbot_formats::session::{Record, SessionReader};
use serde_json::Value;

/// The logs beside the project, as names and texts; none where there are none.
fn logs() -> Vec<(String, String)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../shared/data");
    let Ok(entries) = fs::read_dir(&folder) else {
        println!("skipped: there is no ../shared/data");
        return Vec::new();
    };
    let paths = entries.flatten().map(|entry| entry.path());
    let mut logs: Vec<_> = paths
        .filter(|path| path.extension().is_some_and(|e| e == "jsonl"))
        .map(|path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            (name.into_owned(), fs::read_to_string(&path).expect("can be read"))
        })
        .collect();
    logs.sort();
    logs
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("is JSON")
}

#[test]
fn every_line_is_written_equal_to_what_was_read() {
    for (name, text) in logs() {
        let mut same_text = 0;
        for (index, line) in text.lines().enumerate() {
            let written = match line.starts_with("{\"session\"") {
                true => PosteriorLine::parse(line, index + 1).and_then(|p| p.to_json_line()),
                false => Record::parse(line, index + 1).and_then(|r| r.to_json_line()),
            };
            let written = written.unwrap_or_else(|error| panic!("{}", error.with_file(&name)));
            assert_eq!(json(&written), json(line), "{name}:{}", index + 1);
            same_text += usize::from(written == line);
        }
        let lines = text.lines().count();
        println!("{name}: {lines} lines, {same_text} of them to the letter");
    }
}

#[test]
fn every_session_is_whole_and_is_written_equal_to_what_was_read() {
    for (name, text) in logs() {
        if text.starts_with("{\"session\"") {
            continue;
        }
        let mut written = Vec::new();
        for session in SessionReader::new(text.as_bytes()).with_file(&name) {
            let session = session.unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(session.header_line, written.len() + 1);
            written.extend(session.to_lines().unwrap_or_else(|error| panic!("{name}: {error}")));
            assert_eq!(session.end_line, written.len());
        }
        let read: Vec<_> = text.lines().map(json).collect();
        let written: Vec<_> = written.iter().map(|line| json(line)).collect();
        assert!(read == written, "{name}");
    }
}
