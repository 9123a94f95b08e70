//! What is wrong with a file, where, and what to do about it.

use goodbot_formats::FormatError;
pub use goodbot_formats::quoted;
use std::fmt;

/// A fault in a file. Displayed as `FILE:LINE: field "x": what is wrong; what to do`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The file's name.
    pub file: String,
    /// The line, counted from 1; `None` where the fault is in the file as a whole.
    pub line: Option<usize>,
    /// The field, with its way from the outside: `environment.objects[2]`.
    pub field: Option<String>,
    /// What is wrong, and what to do.
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

    /// The fault that a reader found.
    pub fn from_format(file: &str, error: FormatError) -> Self {
        Self { file: file.to_owned(), line: Some(error.line), field: error.field, message: error.problem.to_string() }
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
