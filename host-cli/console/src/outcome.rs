//! The end of a command: its exit code and its message on standard error.

use crate::messages::tell;
use crate::refusal::InWords;
use goodbot_lesson::Fault;
use std::fmt;
use std::io;

/// Why a command failed.
#[derive(Debug)]
pub enum Failure {
    /// A command whose result is a failure: exit code 1.
    Result(String),
    /// Bad use or bad input: exit code 2.
    Input(String),
    /// Bad input that was reported already: exit code 2.
    Told,
    /// Standard output was closed, which is no fault, or cannot be written.
    Output(io::Error),
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::Output(error)
    }
}

impl From<Fault> for Failure {
    fn from(fault: Fault) -> Self {
        Self::Input(fault.to_string())
    }
}

impl From<Vec<Fault>> for Failure {
    fn from(faults: Vec<Fault>) -> Self {
        Self::Input(faults.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
    }
}

impl<E: InWords> From<E> for Failure {
    fn from(refused: E) -> Self {
        Self::Input(refused.in_words())
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Result(message) | Self::Input(message) => f.write_str(message),
            Self::Told => Ok(()),
            Self::Output(error) => write!(f, "cannot write to standard output: {error}"),
        }
    }
}

/// The exit code of a command. A failure is reported on standard error.
pub fn exit_code(done: Result<(), Failure>) -> u8 {
    let Err(failure) = done else { return 0 };
    let code = match &failure {
        Failure::Output(error) if error.kind() == io::ErrorKind::BrokenPipe => return 0,
        Failure::Told => return 2,
        Failure::Result(_) | Failure::Output(_) => 1,
        Failure::Input(_) => 2,
    };
    tell(&format!("error: {failure}"));
    code
}
