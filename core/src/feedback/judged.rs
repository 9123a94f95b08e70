//! The kind of an action for a task: trainers respond to moves and rests differently.

use crate::planning::Judgement;

/// The kind of an action for a task.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Judged {
    /// A move that begins a shortest way to the goal.
    Nearer,
    /// Another move.
    NotNearer,
    /// A correct rest: at the goal, or in a dead end.
    RestsAtGoal,
    /// A rest before the goal is reached.
    RestsElsewhere,
    /// A move from the goal to the goal: the robot moves on within the target room.
    MovesInside,
    /// Not known exactly.
    #[default]
    Unknown,
}

impl Judged {
    /// An action with this judgement, which was a rest or not. It cannot be seen from these whether it was a move inside the goal.
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
