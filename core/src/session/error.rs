//! Why an agent refused a call.

use super::phase::Phase;
use crate::capacity::CapacityError;
use crate::decimal::Decimal;
use crate::feedback::belief::BeliefError;
use crate::language::SettingError;
use crate::oomdp::DomainFlaw;

/// Why the agent refused a call.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AgentError {
    /// The command has no word.
    #[error("the command has no word; say what to do")]
    EmptyCommand,
    /// There is no task to do here: none is possible, or all are done already.
    #[error("there is nothing to do here: every task is done already or needs objects that are not here, or no kind of task was given")]
    NoTask,
    /// The tasks are written in the vocabulary of another robot: read them with this domain's schema.
    #[error("the tasks are written in another robot's vocabulary; read them with this domain's schema")]
    OtherVocabulary,
    /// The domain breaks a rule of [`Domain`](crate::oomdp::Domain).
    #[error(transparent)]
    Domain(#[from] DomainFlaw),
    /// A task was given twice: it would be twice as probable as the others.
    #[error("task {second} is task {first} once more; give each task once")]
    SameTask {
        /// Its first position.
        first: u8,
        /// Its second position.
        second: u8,
    },
    /// The number of the state is not below the domain's `state_count`.
    #[error("the number of this state is not below state_count; state_count must be more than every number of a state")]
    StateNumber,
    /// The agent's phase does not allow this call. The phase names the call that comes next.
    #[error("{0}")]
    NotNow(Phase),
    /// The plan for this state is not done: call `plan` until it is.
    #[error("the plan for this state is not done; plan on until it is")]
    NotPlanned,
    /// The session was begun in another domain: hear a command in this one.
    #[error("the session was begun in another environment; give a command in this one")]
    OtherDomain,
    /// No action was done since the command: there is nothing to judge.
    #[error("no action was done that could be judged; act first")]
    NothingDone,
    /// The action cannot be done in the planned state.
    #[error("the action cannot be done in this state; choose one that leads to a state")]
    NotApplicable,
    /// No question waits for an answer.
    #[error("no question was asked that waits for an answer; ask first")]
    NotAsked,
    /// This is no answer to the question that was asked.
    #[error("this is no answer to that question; answer yes, no, or one of the tasks that it names")]
    NoAnswer,
    /// The prior of a task is negative or not a number.
    #[error("the prior of task {task} is {}; it must be a number of 0 or more", Decimal(*.value))]
    Prior {
        /// The task, by its position.
        task: u8,
        /// Its prior.
        value: f32,
    },
    /// The priors of all tasks are 0.
    #[error("every task's prior is 0; give one of them more")]
    NoPrior,
    /// The weight of a transcript is negative, infinite or not a number; a logarithm may be negative.
    #[error("the weight of transcript {hypothesis} is {}; it must be a number of 0 or more, or any number as a logarithm", Decimal(*.value))]
    Weight {
        /// The transcript, by its position.
        hypothesis: u8,
        /// Its weight.
        value: f32,
    },
    /// A trainer strategy was refused.
    #[error(transparent)]
    Strategy(BeliefError),
    /// An option is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// The caller stopped the work in a [pause](crate::Agent::listen_in_parts): no session is under way.
    #[cfg(feature = "talk")]
    #[error("the robot was told to stop listening; say it again")]
    Stopped,
    /// A table was full. Everything learned before is kept.
    #[error(transparent)]
    Capacity(#[from] CapacityError),
}

impl From<BeliefError> for AgentError {
    fn from(error: BeliefError) -> Self {
        match error {
            BeliefError::Capacity(error) => Self::Capacity(error),
            error => Self::Strategy(error),
        }
    }
}
