//! The end of a log that was being written when the power went, or when the program was stopped.
//!
//! Lines are appended to a log, so what can be missing is its end: the rest of the last line, and the lines up to the end of the last
//! session. That session was not learned from, because the log is on the disk before the model is written.

use serde_json::Value;
use std::fs::OpenOptions;
use std::io::{ErrorKind, Result, Write};
use std::path::{Path, PathBuf};

/// The beginnings of the lines that are appended to a log.
const LINES: [&[u8]; 5] =
    [br#"{"type":"session""#, br#"{"type":"step""#, br#"{"type":"answer""#, br#"{"type":"end""#, br#"{"type":"world""#];
/// A line that ends a session.
const END: &[u8] = b"{\"type\":\"end\",\"learn\":false}\n";
/// The most ends of one log that are kept.
const MOST_ENDS: usize = 1_000;

/// Where the unfinished end of a log begins. `None` if the log is at fault elsewhere: then somebody else has written it. `reads` says
/// whether a text is a log without a fault.
pub fn begins_at(log: &[u8], reads: impl Fn(&[u8]) -> bool) -> Option<usize> {
    let (mut session, mut at) = (None, 0);
    for line in log.split_inclusive(|&byte| byte == b'\n').filter(|line| line.ends_with(b"\n")) {
        let line_read: Value = serde_json::from_slice(line).unwrap_or_default();
        match line_read.get("type").and_then(Value::as_str) {
            Some("session") => session = Some(at),
            Some("end" | "world") => session = None,
            _ => {}
        }
        at += line.len();
    }
    let (whole, last) = log.split_at_checked(at)?;
    // Where a file system has noted the length of a file before its content, zeros are in its place.
    let zeros = last.iter().rev().take_while(|&&byte| byte == 0).count();
    let begun = last.get(..last.len() - zeros)?;
    let is_ours = LINES.iter().any(|line| begun.starts_with(line) || line.starts_with(begun));
    let begins = session.unwrap_or(at);
    // Zeros alone are nobody's log.
    let is_torn = is_ours && (session.is_some() || !begun.is_empty() || !last.is_empty() && begins > 0);
    let ends = || session.is_none() || reads(&[whole, END].concat());
    (is_torn && reads(whole.get(..begins)?) && ends()).then_some(begins)
}

/// Writes the unfinished end of a log to a new file beside it, and returns that file's path.
///
/// # Errors
/// The file system's error.
pub fn keep_beside(log: &Path, end: &[u8]) -> Result<PathBuf> {
    for number in 1..=MOST_ENDS {
        let mut path = log.as_os_str().to_owned();
        path.push(format!(".end{number}"));
        let path = PathBuf::from(path);
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
            Ok(mut file) => return file.write_all(end).and_then(|()| file.sync_all()).map(|()| path),
        }
    }
    Err(ErrorKind::AlreadyExists.into())
}
