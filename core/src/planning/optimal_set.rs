//! What planning gives for one task in one state.

use crate::oomdp::ActionSet;

/// What the search found for one task: which actions are right here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OptimalSet {
    /// The task holds: only doing nothing is right.
    Goal,
    /// These actions begin a shortest way to the goal.
    Toward(ActionSet),
    /// No goal can be reached any more: every applicable action and doing nothing are equally right.
    DeadEnd(ActionSet),
    /// The search was bounded before it found out, or the task is so improbable that it was not planned.
    Unknown,
}

impl OptimalSet {
    /// The actions, `None` where they are unknown.
    pub fn actions(self) -> Option<ActionSet> {
        match self {
            Self::Goal => Some(ActionSet::NOOP),
            Self::Toward(actions) | Self::DeadEnd(actions) => Some(actions),
            Self::Unknown => None,
        }
    }
}
