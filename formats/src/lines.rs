//! Lines of a file, one in memory at a time.

use std::io::{BufRead, Read as _};

use crate::error::{FormatError, NOT_UTF8};

/// The most bytes that a line of a log may have, its end not counted: 16 MiB.
pub const MAX_LINE_BYTES: usize = 16 << 20;

/// The most bytes of a longer line that are skipped to find the next one. If the line is longer still, reading stops.
const MOST_PASSED_OVER: u64 = 8 * MAX_LINE_BYTES as u64;

/// A file, line by line.
pub struct Lines<R> {
    input: R,
    read: usize,
    failed: bool,
}

/// A line and its number. A line with an error has the text that could be read.
pub struct Line {
    /// The number, counted from 1.
    pub number: usize,
    /// The text.
    pub text: String,
    /// The reason why it is not a text of this length.
    pub error: Option<FormatError>,
}

impl<R: BufRead> Lines<R> {
    /// The lines of a file.
    pub fn new(input: R) -> Self {
        Lines { input, read: 0, failed: false }
    }

    /// Stops reading, with an error on the last line.
    pub(crate) fn give_up(&mut self, problem: String) -> FormatError {
        self.failed = true;
        FormatError::new(self.read, problem)
    }
}

impl<R: BufRead> Iterator for Lines<R> {
    type Item = Line;

    /// The next line, without LF or CRLF at its end, and without a byte order mark.
    fn next(&mut self) -> Option<Line> {
        if self.failed {
            return None;
        }
        let mut bytes = Vec::new();
        // The line, a byte order mark, and the line's end.
        let mut read = self.input.by_ref().take(MAX_LINE_BYTES as u64 + 5).read_until(b'\n', &mut bytes);
        if matches!(read, Ok(0)) {
            return None;
        }
        self.read += 1;
        if bytes.last() == Some(&b'\n') {
            bytes.pop();
        } else if bytes.len() > MAX_LINE_BYTES {
            read = read.and_then(|_| self.input.by_ref().take(MOST_PASSED_OVER).skip_until(b'\n'));
            self.failed = read.as_ref().is_ok_and(|&skipped| skipped as u64 == MOST_PASSED_OVER);
        }
        let mut problem = read.err().map(|error| format!("could not be read ({error}); check the file and its disk"));
        self.failed |= problem.is_some();
        if bytes.last() == Some(&b'\r') {
            bytes.pop();
        }
        if self.read == 1 && bytes.starts_with("\u{feff}".as_bytes()) {
            bytes.drain(..3);
        }
        if problem.is_none() && bytes.len() > MAX_LINE_BYTES {
            problem = Some(format!("the line has more than {MAX_LINE_BYTES} bytes; put each record on a line of its own"));
        }
        let (is_fatal, mut column) = (problem.is_some(), None);
        let text = String::from_utf8(bytes).unwrap_or_else(|error| {
            let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
            if problem.is_none() {
                problem = Some(NOT_UTF8.to_owned());
                let valid = &text[..error.utf8_error().valid_up_to()];
                column = Some(1 + valid.chars().count());
            }
            text
        });
        let error = problem.map(|problem| {
            let mut error = FormatError::new(self.read, problem);
            (error.column, error.is_fatal) = (column, is_fatal);
            error
        });
        Some(Line { number: self.read, text, error })
    }
}
