//! Lines of an input, each of a bounded length.

use std::io::{self, BufRead};

/// The longest line that is taken, in bytes.
const LONGEST_LINE: usize = 1 << 20;

/// After this many bytes without an end of line, no end is waited for.
const NO_LINE: usize = 64 << 20;

/// Lines of an input, each of a bounded length.
pub struct Lines<R> {
    input: R,
    /// The input has no lines.
    endless: bool,
}

impl<R: BufRead> Lines<R> {
    /// The lines of an input.
    pub const fn new(input: R) -> Self {
        Self { input, endless: false }
    }

    /// The next line, or why it cannot be read.
    pub fn next(&mut self) -> io::Result<Option<Result<String, &'static str>>> {
        let (mut bytes, mut length, mut any) = (Vec::new(), 0, false);
        while !self.endless {
            let buffer = match self.input.fill_buf() {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                buffer => buffer?,
            };
            if buffer.is_empty() {
                break;
            }
            any = true;
            let end = buffer.iter().position(|&byte| byte == b'\n');
            let part = buffer.get(..end.unwrap_or(buffer.len())).unwrap_or(&[]);
            length += part.len();
            self.endless = length > NO_LINE;
            if length <= LONGEST_LINE {
                bytes.extend_from_slice(part);
            }
            let used = part.len() + usize::from(end.is_some());
            self.input.consume(used);
            if end.is_some() {
                break;
            }
        }
        Ok(match any {
            false => None,
            true if self.endless => Some(Err("this line has no end, and nothing more is read")),
            true if length > LONGEST_LINE => Some(Err("this line is longer than 1 MiB")),
            true => Some(String::from_utf8(bytes).map_err(|_| "this line is no text in UTF-8")),
        })
    }
}
