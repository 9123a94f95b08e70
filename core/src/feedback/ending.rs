//! When trainers end a session: more often at the goal than elsewhere, so that the end is evidence.

/// How probable it is that the trainer ends the session after an action.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ending {
    /// If the task is done, from 0 to less than 1.
    pub at_goal: f32,
    /// If it is not, from 0 to less than 1.
    pub elsewhere: f32,
}

impl Ending {
    /// An end says nothing: a robot may not know why a session ended.
    pub const NO_EVIDENCE: Self = Self { at_goal: 0.0, elsewhere: 0.0 };

    /// Whether an end says anything.
    pub fn is_evidence(&self) -> bool {
        self.at_goal != self.elsewhere
    }

    /// Whether both are probabilities of less than 1.
    pub(crate) fn is_sound(&self) -> bool {
        [self.at_goal, self.elsewhere].iter().all(|value| (0.0..1.0).contains(value))
    }

    /// The probability that the session ends, or goes on, in a state with the task done or not done.
    pub fn probability(&self, ends: bool, at_goal: bool) -> f32 {
        let ending = if at_goal { self.at_goal } else { self.elsewhere };
        if ends { ending } else { 1.0 - ending }
    }
}

impl Default for Ending {
    fn default() -> Self {
        Self::NO_EVIDENCE
    }
}
