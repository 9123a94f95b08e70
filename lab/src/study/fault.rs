//! Why a run of the study could not continue.

use std::fmt;

/// Why a run could not continue: an agent, a home or a language program failed.
#[derive(Debug)]
pub struct StudyError(pub String);

impl<E: std::error::Error> From<E> for StudyError {
    fn from(error: E) -> Self {
        Self(error.to_string())
    }
}

impl fmt::Display for StudyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}
