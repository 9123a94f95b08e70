//! Lines of a file, one in memory at a time.

use std::io::{BufRead, ErrorKind};

use crate::error::{FormatError, Problem};

/// The most bytes that a line of a log may have, its end not counted: 16 MiB.
pub const MAX_LINE_BYTES: usize = 16 << 20;

/// The bytes of a longer line that are skipped, at most, to find the next one. A file beyond that has no lines, and is not read on.
const MOST_PASSED_OVER: usize = 8 * MAX_LINE_BYTES;

/// A file, line by line.
pub(crate) struct Lines<R> {
    input: R,
    read: usize,
    failed: bool,
}

/// A line, and its number. What could be read of it is there even if it is not a line to use.
pub(crate) struct Line {
    pub(crate) number: usize,
    pub(crate) text: String,
    pub(crate) error: Option<FormatError>,
}

impl<R: BufRead> Lines<R> {
    pub(crate) fn new(input: R) -> Self {
        Lines { input, read: 0, failed: false }
    }

    /// Reads no more: what is wrong, on the line that was read last.
    pub(crate) fn give_up(&mut self, problem: Problem) -> FormatError {
        self.failed = true;
        FormatError::new(self.read, problem)
    }

    /// The next line without its end, be that LF or CRLF, and without a byte order mark.
    pub(crate) fn next(&mut self) -> Option<Line> {
        if self.failed {
            return None;
        }
        let mut bytes = Vec::new();
        let mut length = 0usize;
        let mut started = false;
        let mut problem = None;
        loop {
            let buffer = match self.input.fill_buf() {
                Ok(buffer) => buffer,
                Err(error) if error.kind() == ErrorKind::Interrupted => continue,
                Err(error) => {
                    self.failed = true;
                    started = true;
                    problem = Some(Problem::Read(error.to_string()));
                    break;
                }
            };
            if buffer.is_empty() {
                break;
            }
            started = true;
            let end = buffer.iter().position(|&b| b == b'\n');
            let part = &buffer[..end.unwrap_or(buffer.len())];
            // One byte more than a line may have, in case that it is the end's CR.
            let room = (MAX_LINE_BYTES + 1).saturating_sub(bytes.len());
            bytes.extend_from_slice(&part[..part.len().min(room)]);
            length = length.saturating_add(part.len());
            let used = part.len() + usize::from(end.is_some());
            self.input.consume(used);
            if end.is_some() {
                break;
            }
            if length > MOST_PASSED_OVER {
                self.failed = true;
                break;
            }
        }
        if !started {
            return None;
        }
        self.read += 1;
        if bytes.len() == length && bytes.last() == Some(&b'\r') {
            bytes.pop();
            length -= 1;
        }
        if self.read == 1 && bytes.starts_with("\u{feff}".as_bytes()) {
            bytes.drain(..3);
            length -= 3;
        }
        if problem.is_none() && length > MAX_LINE_BYTES {
            problem = Some(Problem::LineTooLong { limit: MAX_LINE_BYTES });
        }
        let mut column = None;
        let text = String::from_utf8(bytes).unwrap_or_else(|error| {
            let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
            if problem.is_none() {
                problem = Some(Problem::NotUtf8);
                let valid = &text[..error.utf8_error().valid_up_to()];
                column = Some(1 + valid.chars().count());
            }
            text
        });
        let error = problem.map(|problem| {
            let mut error = FormatError::new(self.read, problem);
            error.column = column;
            error
        });
        Some(Line { number: self.read, text, error })
    }
}
