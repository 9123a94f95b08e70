//! What an agent looks for before it asks: the most informative question, then the expected information of the next steps of its plan.

use super::question::{Question, Step};
use crate::oomdp::StateKey;
use crate::task::TaskSet;

/// The number of steps that it looks ahead.
pub(super) const STEPS: u8 = 12;

/// A question that is being considered.
#[derive(Clone, Debug)]
pub(super) enum Looking {
    /// The most informative question is looked for, in this state: the best one yet, and the next step.
    Proposing(StateKey, Option<Question>, Step),
    Ahead(LookingAhead),
}

impl Looking {
    /// The state in which the question would be asked.
    pub(super) const fn start(&self) -> StateKey {
        match self {
            Self::Proposing(start, ..) => *start,
            Self::Ahead(ahead) => ahead.start,
        }
    }
}

/// A look ahead under way.
#[derive(Clone, Copy, Debug)]
pub(super) struct LookingAhead {
    /// The question that would be asked.
    pub(super) question: Question,
    /// Its information per step of its cost, in bits.
    pub(super) worth: f32,
    /// The state in which it would be asked.
    pub(super) start: StateKey,
    /// The state that the look has reached.
    pub(super) at: StateKey,
    /// The followed task.
    pub(super) followed: usize,
    /// The dead ends known at the start.
    pub(super) dead: TaskSet,
    /// The number of steps looked at, and their information, in bits.
    pub(super) steps: u8,
    pub(super) told: f32,
    /// Whether to ask, once it is decided.
    pub(super) asks: Option<bool>,
}

impl LookingAhead {
    /// Adds the information of the next step, in bits. Decides if it can.
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
