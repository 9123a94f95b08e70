//! Models, and the robots that `goodbot teach` keeps by name: a model and a log each.

use super::{Finding, State};
use crate::teach::kept::RobotFiles;
use goodbot::snapshot::Contents;
use goodbot_console::load::content::Content;
use goodbot_console::load::input;
use goodbot_console::messages::counted;
use goodbot_console::whole_file::{is_unfinished, read_model};
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};

/// Checks all robots that are kept.
pub fn kept() -> Vec<Finding> {
    let folder = match RobotFiles::folder() {
        Ok(folder) => folder,
        Err(failure) => return vec![Finding::new(State::Wrong, failure.to_string())],
    };
    let mut files: Vec<PathBuf> = match std::fs::read_dir(&folder) {
        Ok(entries) => entries.flatten().map(|entry| entry.path()).collect(),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Vec::new(),
        Err(error) => {
            let text = format!("{} cannot be read ({error}); check that you may, or name files with --model", folder.display());
            return vec![Finding::new(State::Wrong, text)];
        }
    };
    files.sort();
    let mut findings: Vec<Finding> =
        files.iter().filter(|file| file.extension().is_some_and(|end| end == "goodbot")).map(|file| robot(file)).collect();
    for file in files.iter().filter(|file| is_unfinished(file)) {
        let text = format!("{}: a program was stopped while it wrote this; it can be removed", file.display());
        findings.push(Finding::new(State::Missing, text));
    }
    if findings.is_empty() {
        findings.push(Finding::new(State::Fine, format!("none yet in {}; goodbot teach makes one", folder.display())));
    }
    findings
}

/// Whether a file begins like a model.
pub fn is_model(file: impl AsRef<Path>) -> bool {
    let mut head = Vec::new();
    File::open(file).and_then(|file| file.take(64).read_to_end(&mut head)).is_ok() && Content::of(&head) == Content::Model
}

/// Checks a single model.
pub fn model(path: &Path) -> Finding {
    match sessions(path) {
        Ok(sessions) => Finding::new(State::Fine, format!("{}: a model of {}", path.display(), counted(sessions, "session"))),
        Err(message) => Finding::new(State::Wrong, message),
    }
}

/// The number of sessions of a model, or its fault.
fn sessions(path: &Path) -> Result<usize, String> {
    let bytes = read_model(path).map_err(|failure| failure.to_string())?;
    let contents =
        Contents::read(&bytes).map_err(|error| format!("{}: {error}; goodbot learn makes a new one from its log", path.display()))?;
    Ok(contents.sessions.len())
}

/// Checks a model and the log beside it.
fn robot(path: &Path) -> Finding {
    let known = match sessions(path) {
        Ok(known) => known,
        Err(message) => return Finding::new(State::Wrong, message),
    };
    let log = path.with_extension("jsonl");
    let Ok(file) = File::open(&log) else {
        return Finding::new(State::Fine, format!("{}: {}, and no log", path.display(), counted(known, "session")));
    };
    let mut taught = 0;
    for session in input::sessions(BufReader::new(file)) {
        match session {
            Ok(session) => taught += usize::from(session.learn),
            Err(_) => {
                let text =
                    format!("{}: is no complete log, so goodbot teach refuses the robot; goodbot check names the faults", log.display());
                return Finding::new(State::Wrong, text);
            }
        }
    }
    if known < taught {
        let text = format!(
            "{}: knows {}, and its log has {taught}: older ones gave way, or a program was stopped; goodbot learn {} --out NEW learns from all",
            path.display(),
            counted(known, "session"),
            log.display()
        );
        return Finding::new(State::Missing, text);
    }
    Finding::new(State::Fine, format!("{}: {}", path.display(), counted(known, "session")))
}
