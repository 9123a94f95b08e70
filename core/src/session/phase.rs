//! The agent's phase: it hears a command, is ready to plan and act, ends the session, or learns from it.

use super::options::Weights;
use crate::language::forgetting::Step;
use crate::language::hearing::Heard;
use crate::probability::Scaled;
use core::fmt;

/// The agent's current phase: see [`Agent::phase`](crate::Agent::phase).
///
/// ```text
/// Idle -- hear --> Hearing -> Ready -- finish --> Finishing -> Learning -- learn --> Ended
///                              ^                                                      |
///                              +----------------------- hear_again -------------------+
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Phase {
    /// Waiting for a command: [`Agent::hear`](crate::Agent::hear).
    Idle,
    /// Hearing a command in parts: [`Agent::hear_on`](crate::Agent::hear_on).
    Hearing,
    /// A session is under way: [`Agent::plan`](crate::Agent::plan), [`Agent::decide`](crate::Agent::decide), [`Agent::feedback`](crate::Agent::feedback), [`Agent::finish`](crate::Agent::finish).
    Ready,
    /// Ending the session in parts: [`Agent::finish_on`](crate::Agent::finish_on).
    Finishing,
    /// Training the language model in parts: [`Agent::learn`](crate::Agent::learn).
    Learning,
    /// The session has ended: [`Agent::hear`](crate::Agent::hear), or [`Agent::hear_again`](crate::Agent::hear_again) to resume it.
    Ended,
    /// Restoring a model in parts; until it is complete, the robot has learned nothing: `Agent::restore_on`.
    Restoring,
}

impl fmt::Display for Phase {
    /// Names the phase and the call that comes next.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Idle => "no session is under way; give a command first",
            Self::Hearing => "the command is not heard to its end; hear on until it is",
            Self::Ready => "the session goes on; begin to finish it first",
            Self::Finishing => "the session is not finished; finish on until it is",
            Self::Learning => "the last session is still being learned from; learn on until it is done",
            Self::Ended => "the session has ended; give a command first",
            Self::Restoring => "a model is coming back; restore on until it is all there",
        })
    }
}

/// The phase with its progress. The language model keeps the progress of learning.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Progressed {
    Idle,
    /// The possible tasks are found, so many; the belief is still that of the session before. The command, of this many bytes, is at the
    /// front of the workspace.
    Begun(u8, u32),
    /// The command's words are being heard. The command, of this many bytes, is at the front of the
    /// workspace.
    Words(Heard, u32),
    /// The words are known.
    Opened,
    /// The tasks get their priors; the next machine command is at this position.
    Hearing(Position, Prior),
    Ready,
    /// The machine commands get their weights; the next one is at this position.
    Weighing(Position, Weights),
    /// The session joins the training data; older ones give way.
    Keeping(Step),
    /// The vocabulary is freed of unused entries; older sessions give way for that too.
    Tidying(Step),
    Ended,
    /// A model is being restored. The number identifies the model and its progress.
    Restoring(u32),
}

impl Progressed {
    /// The phase, of an agent whose language model is in training or not.
    pub(super) const fn phase(&self, is_training: bool) -> Phase {
        match self {
            Self::Begun(..) | Self::Words(..) | Self::Opened | Self::Hearing(..) => Phase::Hearing,
            Self::Weighing(..) | Self::Keeping(_) | Self::Tidying(_) => Phase::Finishing,
            Self::Idle | Self::Ready | Self::Ended if is_training => Phase::Learning,
            Self::Idle => Phase::Idle,
            Self::Restoring(_) => Phase::Restoring,
            Self::Ready => Phase::Ready,
            Self::Ended => Phase::Ended,
        }
    }
}

/// The position of a machine command among those of all tasks, and the sum over the earlier ones of its task.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Position {
    pub(super) task: usize,
    pub(super) constraint: u16,
    pub(super) sum: Scaled,
}

impl Position {
    /// The first machine command of a task.
    pub(super) const fn of_task(task: usize) -> Self {
        Self { task, constraint: 0, sum: Scaled::ZERO }
    }
}

/// Whether any task so far has a prior above 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Prior {
    Zero,
    Positive,
}
