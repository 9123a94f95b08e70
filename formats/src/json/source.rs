//! A text that knows the lines of its parts.

use super::Node;
use super::scan::{self, JsonFault};
use crate::error::{FormatError, not_json};

/// A JSON text and the number of its first line.
pub(crate) struct Source<'a> {
    text: &'a str,
    first_line: usize,
}

impl<'a> Source<'a> {
    pub(crate) fn new(text: &'a str, first_line: usize) -> Self {
        Source { text, first_line }
    }

    /// The text's one value, if the text is JSON.
    pub(crate) fn root(&'a self) -> Result<Node<'a>, FormatError> {
        if self.text.trim().is_empty() {
            return Err(FormatError::new(self.first_line, "there is nothing here; give a file with a JSON text"));
        }
        match scan::whole(self.text) {
            Ok(raw) => Ok(Node { source: self, raw, path: String::new() }),
            Err(JsonFault { at, message }) => {
                let problem = message.map_or_else(
                    || "the text ends in the middle of a value; complete it, or remove what is left of it".to_owned(),
                    not_json,
                );
                let (line, column) = self.place_of(at);
                let mut error = FormatError::new(line, problem);
                error.column = Some(column);
                Err(error)
            }
        }
    }

    /// The line and the column of a slice of the text.
    pub(super) fn place(&self, slice: &str) -> (usize, usize) {
        self.place_of((slice.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize))
    }

    fn place_of(&self, offset: usize) -> (usize, usize) {
        let before = &self.text.as_bytes()[..offset.min(self.text.len())];
        let line_start = before.iter().rposition(|&b| b == b'\n').map_or(0, |i| i + 1);
        let lines = before.iter().filter(|&&b| b == b'\n').count();
        (self.first_line + lines, 1 + characters(&before[line_start..]))
    }
}

/// The number of characters in these bytes of a UTF-8 text.
fn characters(bytes: &[u8]) -> usize {
    bytes.iter().filter(|&&b| b & 0xC0 != 0x80).count()
}
