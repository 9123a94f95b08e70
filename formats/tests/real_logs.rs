//! Logs of real trainers, from the data beside the project, are read and written without loss. Ignored without these data.

use std::fs;
use std::path::Path;
use std::process::ExitCode;

use goodbot_formats::posterior::PosteriorLine;
use goodbot_formats::session::{Record, SessionReader};
use libtest_mimic::{Arguments, Failed, Trial};
use serde_json::Value;

/// The logs of session format 1.
const LOGS: [&str; 6] =
    ["coarse.jsonl", "expert.jsonl", "feedback-beliefs.jsonl", "feedback.jsonl", "turk-original.jsonl", "turk-simplified.jsonl"];
const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data");

fn main() -> ExitCode {
    let absent = !Path::new(DATA).is_dir();
    let test =
        |name: &str, run: fn() -> Result<(), Failed>| Trial::test(name, run).with_ignored_flag(absent).with_kind("needs ../shared/data");
    let tests = vec![
        test("every_line_is_written_equal_to_what_was_read", every_line_is_written_equal_to_what_was_read),
        test("every_session_is_whole_and_is_written_equal_to_what_was_read", every_session_is_whole_and_is_written_equal_to_what_was_read),
    ];
    libtest_mimic::run(&Arguments::from_args(), tests).exit_code()
}

/// The logs, as names and texts.
fn logs() -> impl Iterator<Item = (&'static str, String)> {
    LOGS.into_iter().map(|name| (name, fs::read_to_string(Path::new(DATA).join(name)).expect("can be read")))
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("is JSON")
}

fn every_line_is_written_equal_to_what_was_read() -> Result<(), Failed> {
    for (name, text) in logs() {
        let mut same_text = 0;
        for (index, line) in text.lines().enumerate() {
            let written = match line.starts_with("{\"session\"") {
                true => PosteriorLine::parse(line, index + 1).and_then(|p| p.to_json_line()),
                false => Record::parse(line, index + 1).and_then(|r| r.to_json_line()),
            };
            let written = written.unwrap_or_else(|error| panic!("{}", error.with_file(name)));
            assert_eq!(json(&written), json(line), "{name}:{}", index + 1);
            same_text += usize::from(written == line);
        }
        let lines = text.lines().count();
        println!("{name}: {lines} lines, {same_text} of them to the letter");
    }
    Ok(())
}

fn every_session_is_whole_and_is_written_equal_to_what_was_read() -> Result<(), Failed> {
    for (name, text) in logs() {
        if text.starts_with("{\"session\"") {
            continue;
        }
        let mut written = Vec::new();
        for session in SessionReader::new(text.as_bytes()) {
            let session = session.unwrap_or_else(|error| panic!("{}", error.with_file(name)));
            assert_eq!(session.header_line, written.len() + 1);
            written.extend(session.to_lines().unwrap_or_else(|error| panic!("{name}: {error}")));
            assert_eq!(session.end_line, written.len());
        }
        let read: Vec<_> = text.lines().map(json).collect();
        let written: Vec<_> = written.iter().map(|line| json(line)).collect();
        assert!(read == written, "{name}");
    }
    Ok(())
}
