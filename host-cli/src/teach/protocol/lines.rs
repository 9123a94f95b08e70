//! Lines of an input, each of a bounded length.

use std::io::{self, BufRead};

/// The longest line that is taken, in bytes.
const LONGEST_LINE: usize = 1 << 20;

/// Lines of an input, each of a bounded length.
pub struct Lines<R> {
    /// The input.
    pub input: R,
}

impl<R: BufRead> Lines<R> {
    /// The next line, or why it is none.
    pub fn next(&mut self) -> io::Result<Option<Result<String, &'static str>>> {
        let (mut bytes, mut any, mut long) = (Vec::new(), false, false);
        loop {
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
            long |= bytes.len() + part.len() > LONGEST_LINE;
            if !long {
                bytes.extend_from_slice(part);
            }
            let used = part.len() + usize::from(end.is_some());
            self.input.consume(used);
            if end.is_some() {
                break;
            }
        }
        Ok(match (any, long) {
            (false, _) => None,
            (true, true) => Some(Err("this line is longer than 1 MiB")),
            (true, false) => Some(String::from_utf8(bytes).map_err(|_| "this line is no text in UTF-8")),
        })
    }
}
