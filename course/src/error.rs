//! Why a course could not continue.

use core::fmt;
use goodbot::AgentError;
use goodbot::home::HomeError;

/// Why a course could not continue.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum CourseError {
    /// The agent refused.
    Agent(AgentError),
    /// A layout is no valid home, or does not fit into the memory.
    Home(HomeError),
    /// The intended task is not among the agent's tasks here: it holds already, or its objects are missing.
    NotPosed,
}

impl From<AgentError> for CourseError {
    fn from(error: AgentError) -> Self {
        Self::Agent(error)
    }
}

impl From<HomeError> for CourseError {
    fn from(error: HomeError) -> Self {
        Self::Home(error)
    }
}

impl fmt::Display for CourseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Agent(error) => error.fmt(f),
            Self::Home(error) => error.fmt(f),
            Self::NotPosed => f.write_str("the intended task is not possible here: it holds already, or the home lacks its objects"),
        }
    }
}

impl core::error::Error for CourseError {}
