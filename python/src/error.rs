//! The exceptions that Python gets: the core's own error texts, each in an exception of its kind.

use goodbot::AgentError;
use goodbot::capacity::CapacityError as Full;
use goodbot::snapshot::{RestoreError, SaveError};
use goodbot_course::CourseError;
use goodbot_formats::FormatError as Misformed;
use pyo3::create_exception;
use pyo3::exceptions::{PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use std::fmt::Display;
use std::path::Path;

create_exception!(
    goodbot,
    CapacityError,
    PyValueError,
    "A table was full. `capacity` is the name of the table to raise, `limit` its size, and `given` the least size that is needed."
);
create_exception!(
    goodbot,
    FormatError,
    PyValueError,
    "A text is not in the format. `line` counts from 1; `field` is the field at fault, or None."
);
create_exception!(goodbot, ModelError, PyValueError, "The bytes are no model that this agent can take.");
create_exception!(
    goodbot,
    SessionError,
    PyRuntimeError,
    "A call is out of order: a command must be heard, a plan done or an action acted first."
);
create_exception!(goodbot, InUseError, PyRuntimeError, "Another thread, or an outer call, is using this agent.");
create_exception!(goodbot, InternalError, PyRuntimeError, "goodbot itself is at fault; the agent cannot be used any more.");

/// A `ValueError` with this text.
pub fn value(text: impl Display) -> PyErr {
    PyValueError::new_err(text.to_string())
}

/// The exception for a file that cannot be read: it names the file, as that of Python's own `open` does.
pub fn file(path: &Path, error: &std::io::Error) -> PyErr {
    let (text, name) = (error.to_string(), path.display().to_string());
    match error.raw_os_error() {
        Some(number) => PyOSError::new_err((number, text.split(" (os error").next().unwrap_or_default().to_owned(), name)),
        None => value(format!("{name}: {text}")),
    }
}

/// The same exception, with the file's name before its text.
pub fn in_file(py: Python<'_>, path: &Path, error: PyErr) -> PyErr {
    let value = error.value(py);
    if let Ok((first,)) = value.getattr("args").and_then(|args| args.extract::<(String,)>()) {
        // Setting the arguments of an exception fails only if memory runs out.
        let _ = value.setattr("args", (format!("{}: {first}", path.display()),));
    }
    error
}

/// The exception for a full table.
pub fn full(py: Python<'_>, error: Full) -> PyErr {
    let raised = CapacityError::new_err(error.to_string());
    // Plain attributes of a plain object: setting them fails only if memory runs out.
    let _ = raised.value(py).setattr("capacity", error.capacity.name());
    let _ = raised.value(py).setattr("limit", error.limit);
    let _ = raised.value(py).setattr("given", error.given);
    raised
}

/// The exception for an agent's error.
pub fn agent(py: Python<'_>, error: AgentError) -> PyErr {
    match error {
        AgentError::Capacity(error) => full(py, error),
        AgentError::OtherVocabulary => value("this agent's tasks are of another vocabulary; make it with domain= this robot"),
        AgentError::EmptyCommand
        | AgentError::NoTask
        | AgentError::StateNumber
        | AgentError::NotApplicable
        | AgentError::Prior { .. }
        | AgentError::NoPrior
        | AgentError::NoAnswer
        | AgentError::Strategy(_)
        | AgentError::Setting(_) => value(error),
        _ => SessionError::new_err(error.to_string()),
    }
}

/// The exception for a lesson or a course that could not go on.
pub fn course(py: Python<'_>, error: CourseError) -> PyErr {
    match error {
        CourseError::Agent(error) => agent(py, error),
        error => value(error),
    }
}

/// The exception for a model that was not restored.
pub fn restore(py: Python<'_>, error: RestoreError) -> PyErr {
    match error {
        RestoreError::Capacity(error) => full(py, error),
        error => ModelError::new_err(error.to_string()),
    }
}

/// The exception for a model that was not written.
pub fn save(error: SaveError) -> PyErr {
    ModelError::new_err(error.to_string())
}

/// The exception for a malformed text.
pub fn format(py: Python<'_>, error: &Misformed) -> PyErr {
    misformed(py, error, error.line, error.field.as_deref())
}

/// The exception for a malformed text, with its line.
pub fn misformed(py: Python<'_>, text: impl Display, line: usize, field: Option<&str>) -> PyErr {
    let raised = FormatError::new_err(text.to_string());
    let _ = raised.value(py).setattr("line", line);
    let _ = raised.value(py).setattr("field", field);
    raised
}
