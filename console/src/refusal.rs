//! What the library refuses, in the words of who uses the program: no name of a constant, and no advice to change the program.

use goodbot::AgentError;
use goodbot::capacity::{Capacity, CapacityError};

/// What an agent refused, and what to do.
pub fn in_words(error: &AgentError) -> String {
    match error {
        AgentError::Capacity(error) => full(error),
        error => error.to_string(),
    }
}

/// What was full, and what to do.
pub fn full(error: &CapacityError) -> String {
    let &CapacityError { capacity, limit, given } = error;
    let (what, remedy) = match capacity {
        Capacity::WordsPerCommand => ("words in a command", "shorten it"),
        Capacity::NameBytes => ("bytes in a word or name", "shorten it"),
        Capacity::Tasks => ("tasks in one home", "leave out rooms, blocks or kinds of tasks"),
        Capacity::LiftedTasks => ("kinds of tasks", "name fewer with --task"),
        Capacity::Objects => ("objects in a home", "leave out some"),
        Capacity::Names | Capacity::NameBytesTogether => ("names, colours and shapes in a home", "use fewer or shorter ones"),
        Capacity::Cells => ("free cells in a home", "make rooms smaller"),
        Capacity::Blocks => ("blocks in a home", "leave out some"),
        Capacity::Strategies => ("trainer strategies", "leave out the least probable"),
        Capacity::FactsPerTask => ("colours and shapes in one task", "name kinds of tasks with fewer objects"),
        Capacity::TokensPerCommand => ("machine tokens in one task", "name kinds of tasks with fewer propositions"),
        Capacity::Sessions | Capacity::SentenceWords | Capacity::Pairs => ("sessions in one model", "learn from fewer at once"),
        Capacity::Words | Capacity::WordBytes => ("different words in one model", "learn from fewer sessions at once"),
        _ => ("entries of one table", "use a smaller home, fewer kinds of tasks or fewer sessions"),
    };
    format!("too many {what}: {given} or more, and {limit} are the most; {remedy}")
}
