//! Why an agent refused a call.

use super::phase::Phase;
use crate::capacity::CapacityError;
use crate::decimal::Decimal;
use crate::feedback::belief::BeliefError;
use crate::language::SettingError;
use crate::oomdp::DomainFlaw;
use core::fmt;

/// Why the agent refused a call.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum AgentError {
    /// The command has no word.
    EmptyCommand,
    /// There is no task to do here: none is possible, or all are done already.
    NoTask,
    /// The tasks are written in the vocabulary of another robot: read them with this domain's schema.
    OtherVocabulary,
    /// The domain breaks a rule of [`Domain`](crate::oomdp::Domain).
    Domain(DomainFlaw),
    /// A task was given twice: it would be twice as probable as the others.
    SameTask {
        /// Its first position.
        first: u8,
        /// Its second position.
        second: u8,
    },
    /// The number of the state is not below the domain's `state_count`.
    StateNumber,
    /// The agent's phase does not allow this call. The phase names the call that comes next.
    NotNow(Phase),
    /// The plan for this state is not done: call `plan` until it is.
    NotPlanned,
    /// The session was begun in another domain: hear a command in this one.
    OtherDomain,
    /// No action was done since the command: there is nothing to judge.
    NothingDone,
    /// The action cannot be done in the planned state.
    NotApplicable,
    /// No question waits for an answer.
    NotAsked,
    /// This is no answer to the question that was asked.
    NoAnswer,
    /// The prior of a task is negative or not a number.
    Prior {
        /// The task, by its position.
        task: u8,
        /// Its prior.
        value: f32,
    },
    /// The priors of all tasks are 0.
    NoPrior,
    /// The weight of a transcript is negative or not a number.
    Weight {
        /// The transcript, by its position.
        hypothesis: u8,
        /// Its weight.
        value: f32,
    },
    /// A trainer strategy was refused.
    Strategy(BeliefError),
    /// An option is out of range.
    Setting(SettingError),
    /// The caller stopped the work in a [pause](crate::Agent::listen_in_parts): no session is under way.
    #[cfg(feature = "talk")]
    Stopped,
    /// A table was full. Everything learned before is kept.
    Capacity(CapacityError),
}

impl From<CapacityError> for AgentError {
    fn from(error: CapacityError) -> Self {
        Self::Capacity(error)
    }
}

impl From<DomainFlaw> for AgentError {
    fn from(flaw: DomainFlaw) -> Self {
        Self::Domain(flaw)
    }
}

impl From<SettingError> for AgentError {
    fn from(error: SettingError) -> Self {
        Self::Setting(error)
    }
}

impl From<BeliefError> for AgentError {
    fn from(error: BeliefError) -> Self {
        match error {
            BeliefError::Capacity(error) => Self::Capacity(error),
            error => Self::Strategy(error),
        }
    }
}

impl fmt::Display for AgentError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::EmptyCommand => "the command has no word; say what to do",
            Self::NoTask => {
                "there is nothing to do here: every task is done already or needs objects that are not here, or no kind of task was given"
            }
            Self::OtherVocabulary => "the tasks are written in another robot's vocabulary; read them with this domain's schema",
            Self::StateNumber => "the number of this state is not below state_count; state_count must be more than every number of a state",
            Self::NotPlanned => "the plan for this state is not done; plan on until it is",
            Self::OtherDomain => "the session was begun in another environment; give a command in this one",
            Self::NothingDone => "no action was done that could be judged; act first",
            Self::NotApplicable => "the action cannot be done in this state; choose one that leads to a state",
            Self::NotAsked => "no question was asked that waits for an answer; ask first",
            #[cfg(feature = "talk")]
            Self::Stopped => "the robot was told to stop listening; say it again",
            Self::NoAnswer => "this is no answer to that question; answer yes, no, or one of the tasks that it names",
            Self::NotNow(phase) => return phase.fmt(f),
            Self::Prior { task, value } => {
                return write!(f, "the prior of task {task} is {}; it must be a number of 0 or more", Decimal(*value));
            }
            Self::Weight { hypothesis, value } => {
                return write!(f, "the weight of transcript {hypothesis} is {}; it must be a number of 0 or more", Decimal(*value));
            }
            Self::NoPrior => "every task's prior is 0; give one of them more",
            Self::Domain(flaw) => return flaw.fmt(f),
            Self::SameTask { first, second } => return write!(f, "task {second} is task {first} once more; give each task once"),
            Self::Strategy(error) => return error.fmt(f),
            Self::Setting(error) => return error.fmt(f),
            Self::Capacity(error) => return error.fmt(f),
        })
    }
}

impl core::error::Error for AgentError {}
