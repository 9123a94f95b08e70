//! A text, and where in it something stands.

use serde_json::value::RawValue;

use super::Node;
use crate::error::{FormatError, Problem};

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
            return Err(FormatError::new(self.first_line, Problem::NoText));
        }
        match serde_json::from_str::<&RawValue>(self.text) {
            Ok(raw) => Ok(Node { source: self, raw, path: String::new() }),
            Err(error) => Err(self.syntax(&error)),
        }
    }

    fn syntax(&self, error: &serde_json::Error) -> FormatError {
        let problem = match error.is_eof() {
            true => Problem::CutShort,
            false => Problem::Syntax(message(error)),
        };
        let before = error.line().saturating_sub(1);
        let mut found = FormatError::new(self.first_line + before, problem);
        // The column counts bytes, up to and with the one at fault.
        let line = self.text.split('\n').nth(before).unwrap_or("");
        let bytes = error.column().saturating_sub(1).min(line.len());
        found.column = Some(1 + characters(&line.as_bytes()[..bytes]));
        found
    }

    /// The line and the column of a slice of the text.
    pub(super) fn place(&self, slice: &str) -> (usize, usize) {
        let offset = (slice.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize);
        let before = &self.text.as_bytes()[..offset.min(self.text.len())];
        let line_start = before.iter().rposition(|&b| b == b'\n').map_or(0, |i| i + 1);
        let lines = before.iter().filter(|&&b| b == b'\n').count();
        (self.first_line + lines, 1 + characters(&before[line_start..]))
    }
}

/// The JSON reader's message without the place, which the error itself names.
pub(super) fn message(error: &serde_json::Error) -> String {
    let text = error.to_string();
    match text.find(" at line ") {
        Some(end) => text[..end].to_string(),
        None => text,
    }
}

/// How many characters there are in these bytes of a UTF-8 text.
fn characters(bytes: &[u8]) -> usize {
    bytes.iter().filter(|&&b| b & 0xC0 != 0x80).count()
}
