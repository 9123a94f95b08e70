//! The library's errors in the user's words, without names of constants, and without advice to change the program.

use goodbot::AgentError;
use goodbot::capacity::{Capacity, CapacityError};
use goodbot::snapshot::{RestoreError, SaveError};
use goodbot::task::TaskTextError;
use goodbot_lesson::home;
use goodbot_lesson::live::LiveError;

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
