//! What the next steps of the plan that is followed are expected to tell.

use super::question::Question;
use crate::task::TaskSet;

/// How many steps ahead it looks.
pub(super) const STEPS: u8 = 12;

/// A look ahead under way.
#[derive(Clone, Copy, Debug)]
pub(super) struct LookingAhead {
    /// The question that would be asked.
    pub(super) question: Question,
    /// What it tells for each step that it costs, in bits.
    pub(super) worth: f32,
    /// The state in which it would be asked.
    pub(super) start: u64,
    /// The state that the look has come to.
    pub(super) at: u64,
    /// The task that is followed.
    pub(super) followed: usize,
    /// The dead ends known at the start.
    pub(super) dead: TaskSet,
    /// How many steps were looked at, and what they tell together.
    pub(super) steps: u8,
    pub(super) told: f32,
    /// Whether to ask, once that is known.
    pub(super) asks: Option<bool>,
}

impl LookingAhead {
    /// Takes in what the next step tells, in bits. Decides where it can.
    pub(super) fn add(&mut self, information: f32) {
        self.steps = self.steps.saturating_add(1);
        self.told += information;
        if self.told >= self.worth * f32::from(self.steps) {
            self.asks = Some(false);
        } else if self.steps >= STEPS {
            self.asks = Some(true);
        }
    }
}
