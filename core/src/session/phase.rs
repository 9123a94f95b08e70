//! The agent's phase: it hears a command, is ready to plan and act, ends the session, or learns from it.

use super::agent::Agent;
use super::options::Weights;
use crate::language::forgetting::Step;
use crate::probability::Scaled;
use core::fmt;

/// What an agent is doing. [`Agent::phase`] tells.
///
/// ```text
/// Idle -- hear --> Hearing -> Ready -- finish --> Finishing -> Learning -- learn --> Ended
///                              ^                                                      |
///                              +----------------------- hear_again -------------------+
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Phase {
    /// It waits for a command: [`Agent::hear`].
    Idle,
    /// It hears a command in parts: [`Agent::hear_on`].
    Hearing,
    /// A session is under way: [`Agent::plan`], [`Agent::decide`], [`Agent::feedback`], [`Agent::finish`].
    Ready,
    /// The session ends in parts: [`Agent::finish_on`].
    Finishing,
    /// The language model is trained in parts: [`Agent::learn`].
    Learning,
    /// The session has ended: [`Agent::hear`], or [`Agent::hear_again`] to take it up again.
    Ended,
    /// A model comes back in parts, and the robot has learned nothing until it is all there: `Agent::restore_on`.
    Restoring,
}

impl fmt::Display for Phase {
    /// Names the phase and the call that leads on.
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

/// The phase, with how far its work has come. Learning is the language model's own work.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Progressed {
    Idle,
    /// The tasks that are possible are known.
    Opened,
    /// The tasks get their priors, from this machine command on.
    Hearing(Position, Prior),
    Ready,
    /// The machine commands get their weights, from this one on.
    Weighing(Position, Weights),
    /// The session joins the training data; others give way.
    Keeping(Step),
    /// The vocabulary gets room again; others give way for that too.
    Tidying(Step),
    Ended,
    /// A model comes back. The number says which, and how far it has come.
    #[cfg(feature = "snapshot")]
    Restoring(u32),
}

/// A machine command among those of all tasks, and the sum over those of its task before it.
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

/// Whether some task so far has a prior of more than 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Prior {
    Zero,
    Positive,
}

impl<M> Agent<M> {
    /// The agent's phase. Calls of another phase are refused with [`AgentError::NotNow`](crate::AgentError::NotNow).
    ///
    /// ```
    /// use goodbot::{Agent, HeapMemory, Options, home, session::Phase};
    /// let memory = HeapMemory::new(&goodbot::Capacities::SMALL);
    /// let agent = Agent::new(memory.agent, &home::paper_tasks()?, Options::DEFAULT)?;
    /// assert_eq!(agent.phase(), Phase::Idle);
    /// assert_eq!(agent.phase().to_string(), "no session is under way; give a command first");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn phase(&self) -> Phase {
        match self.progressed {
            Progressed::Opened | Progressed::Hearing(..) => Phase::Hearing,
            Progressed::Weighing(..) | Progressed::Keeping(_) | Progressed::Tidying(_) => Phase::Finishing,
            Progressed::Idle | Progressed::Ready | Progressed::Ended if self.language.is_training() => Phase::Learning,
            Progressed::Idle => Phase::Idle,
            #[cfg(feature = "snapshot")]
            Progressed::Restoring(_) => Phase::Restoring,
            Progressed::Ready => Phase::Ready,
            Progressed::Ended => Phase::Ended,
        }
    }

    /// The session is over; it can be taken up again where one was begun.
    pub(super) const fn set_ended(&mut self) {
        self.progressed = if self.start.is_some() { Progressed::Ended } else { Progressed::Idle };
    }
}
