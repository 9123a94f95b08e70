//! Reads lines of bounded length.

use std::io::{self, BufRead, Read as _};

/// The longest accepted line, in bytes.
const LONGEST_LINE: u64 = 1 << 20;

/// After this many further bytes without a line end, reading stops.
const NO_LINE: u64 = 64 << 20;

/// Lines of bounded length.
pub struct Lines<R> {
    input: R,
    /// Whether reading stopped in a line without an end.
    endless: bool,
}

impl<R: BufRead> Lines<R> {
    /// The lines of an input.
    pub const fn new(input: R) -> Self {
        Self { input, endless: false }
    }

    /// The next line, or the reason why it cannot be read.
    pub fn next(&mut self) -> io::Result<Option<Result<String, &'static str>>> {
        let mut line = Vec::new();
        if self.endless || self.input.by_ref().take(LONGEST_LINE + 1).read_until(b'\n', &mut line)? == 0 {
            return Ok(None);
        }
        if line.last() == Some(&b'\n') {
            line.pop();
        } else if line.len() as u64 > LONGEST_LINE {
            self.endless = self.input.by_ref().take(NO_LINE).skip_until(b'\n')? as u64 == NO_LINE;
            return Ok(Some(Err(match self.endless {
                true => "this line has no end, and nothing more is read",
                false => "this line is longer than 1 MiB",
            })));
        }
        Ok(Some(String::from_utf8(line).map_err(|_| "this line is no text in UTF-8")))
    }
}
