//! The faults of a file: the place, the fault, and the remedy.

use goodbot_formats::FormatError;
pub use goodbot_formats::quoted;
use std::fmt;

/// A fault in a file. Displayed as `FILE:LINE: field "x": the fault; the remedy`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The file's name.
    pub file: String,
    /// The line, counted from 1; `None` for a fault of the file as a whole.
    pub line: Option<usize>,
    /// The field, with its path from the outside: `environment.objects[2]`.
    pub field: Option<String>,
    /// The fault, and the remedy.
    pub message: String,
}

impl Fault {
    /// A fault in a file as a whole.
    pub fn new(file: &str, message: impl fmt::Display) -> Self {
        Self { file: file.to_owned(), line: None, field: None, message: message.to_string() }
    }

    /// A fault on a line.
    pub fn on_line(file: &str, line: usize, message: impl fmt::Display) -> Self {
        Self { line: Some(line), ..Self::new(file, message) }
    }

    /// The same fault, naming the field.
    pub fn in_field(self, field: impl Into<String>) -> Self {
        Self { field: Some(field.into()), ..self }
    }

    /// A fault that a reader found.
    pub fn from_format(file: &str, error: FormatError) -> Self {
        Self { file: file.to_owned(), line: Some(error.line), field: error.field, message: error.problem }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.file)?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        f.write_str(": ")?;
        if let Some(field) = &self.field {
            write!(f, "field {}: ", quoted(field))?;
        }
        f.write_str(&self.message)
    }
}
