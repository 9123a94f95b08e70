//! A simulated trainer: draws its feedback from a strategy.

use super::strategy::{Feedback, Strategy};
use crate::random::unit;
use rand_core::Rng;

/// A trainer who knows the intended task and follows a strategy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimulatedTrainer {
    /// How it rewards, punishes and stays silent.
    pub strategy: Strategy,
}

impl SimulatedTrainer {
    /// Its feedback to an action that is correct, or is not, for the intended task. The same generator gives the same feedback on every
    /// target.
    pub fn feedback<R: Rng + ?Sized>(&self, correct: bool, random: &mut R) -> Feedback {
        let draw = unit(random);
        let reward = self.strategy.probability(Feedback::Reward, correct);
        let punish = self.strategy.probability(Feedback::Punish, correct);
        if draw < reward {
            Feedback::Reward
        } else if draw < reward + punish {
            Feedback::Punish
        } else {
            Feedback::Neutral
        }
    }
}
