//! The end of a command: its exit code and its message on standard error, in the user's words, without names of constants, and without advice to
//! change the program.

use crate::messages::tell;
use goodbot::AgentError;
use goodbot::capacity::{Capacity, CapacityError};
use goodbot::snapshot::{RestoreError, SaveError};
use goodbot::task::TaskTextError;
use goodbot_lesson::live::LiveError;
use goodbot_lesson::{Fault, home};
use std::path::Path;
use std::{fmt, io};

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

impl Failure {
    /// The fault of a file, or of an error about it.
    pub fn of(file: &Path, fault: impl fmt::Display) -> Self {
        Self::Input(format!("{}: {fault}", file.display()))
    }
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

/// An agent's error for a robot in a world from a file: the field at fault, and the fault with its remedy.
pub fn in_a_world(error: &AgentError) -> (&'static str, String) {
    let &AgentError::Capacity(CapacityError { capacity, limit, given }) = error else { return ("objects", error.to_string()) };
    let (field, what, remedy) = match capacity {
        Capacity::Tasks => ("task_kinds", "tasks in one world", "leave out objects or kinds of task"),
        Capacity::LiftedTasks => ("task_kinds", "kinds of task", "leave out some"),
        Capacity::FactsPerTask => ("task_kinds", "values of objects in one task", "let kinds of task have fewer variables"),
        Capacity::TokensPerCommand => ("task_kinds", "machine tokens in one task", "let kinds of task have fewer propositions"),
        Capacity::NameBytes => ("objects", "bytes in a word or name", "shorten it"),
        _ => ("objects", "entries of one table", "use a smaller world, fewer kinds of task or fewer sessions"),
    };
    (field, format!("give too many {what}: {given} or more, and {limit} are the most; {remedy}"))
}

/// An error that can be told in the user's words.
pub trait InWords: std::fmt::Display {
    /// The limit that was exceeded, if that is the fault.
    fn full(&self) -> Option<&CapacityError>;

    /// The fault, and its remedy.
    fn in_words(&self) -> String {
        self.full().map_or_else(|| self.to_string(), full)
    }
}

macro_rules! in_words {
    ($($Error:ty: $full:pat => $error:expr),*) => {
        $(impl InWords for $Error {
            fn full(&self) -> Option<&CapacityError> {
                if let $full = self { Some($error) } else { None }
            }
        })*
    };
}
in_words! {
    AgentError: Self::Capacity(error) => error,
    RestoreError: Self::Capacity(error) => error,
    TaskTextError: Self::Capacity(error) => error,
    LiveError: Self::Agent(AgentError::Capacity(error)) => error
}

impl InWords for CapacityError {
    fn full(&self) -> Option<&CapacityError> {
        Some(self)
    }
}

impl InWords for SaveError {
    fn full(&self) -> Option<&CapacityError> {
        None
    }
}

/// The limit that was exceeded, and the remedy.
pub fn full(error: &CapacityError) -> String {
    if let Some(full) = home::full(error) {
        return full;
    }
    let &CapacityError { capacity, limit, given } = error;
    let (what, remedy) = match capacity {
        Capacity::WordsPerCommand => ("words in a command", "shorten it"),
        Capacity::Tasks => ("tasks in one home", "leave out rooms, blocks or kinds of tasks"),
        Capacity::LiftedTasks => ("kinds of tasks", "name fewer with --task"),
        Capacity::Strategies => ("trainer strategies", "leave out the least probable"),
        Capacity::FactsPerTask => ("colours and shapes in one task", "name kinds of tasks with fewer objects"),
        Capacity::TokensPerCommand => ("machine tokens in one task", "name kinds of tasks with fewer propositions"),
        Capacity::Sessions | Capacity::SentenceWords | Capacity::Pairs => ("sessions in one model", "learn from fewer at once"),
        Capacity::Words | Capacity::WordBytes => ("different words in one model", "learn from fewer sessions at once"),
        _ => ("entries of one table", "use a smaller home, fewer kinds of tasks or fewer sessions"),
    };
    format!("too many {what}: {given} or more, and {limit} are the most; {remedy}")
}
