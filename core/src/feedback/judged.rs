//! What an action is for a task: trainers speak otherwise of a move than of a rest.

use crate::planning::Judgement;

/// What an action is for a task.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Judged {
    /// A move that begins a shortest way to the goal.
    Nearer,
    /// Another move.
    NotNearer,
    /// A rest where it is right: at the goal, and in a dead end.
    RestsAtGoal,
    /// A rest where there is still something to do.
    RestsElsewhere,
    /// A move from the goal to the goal: a robot that goes on in the room that it was sent to.
    MovesInside,
    /// Not known exactly.
    #[default]
    Unknown,
}

impl Judged {
    /// An action with this judgement, which was a rest or not. Where it was a move inside the goal is not seen from these.
    pub const fn of(judgement: Judgement, rests: bool) -> Self {
        match (judgement, rests) {
            (Judgement::Correct, false) => Self::Nearer,
            (Judgement::Incorrect, false) => Self::NotNearer,
            (Judgement::Correct, true) => Self::RestsAtGoal,
            (Judgement::Incorrect, true) => Self::RestsElsewhere,
            (Judgement::Unknown, _) => Self::Unknown,
        }
    }
}
