//! A simulated trainer: draws its feedback from a strategy.

use super::strategy::{Feedback, LAGS, Strategy};
use crate::planning::Judgement;
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

    /// Its feedback after these actions, the last one first, each judged for the intended task: about the last one, or one of the two
    /// before it, according to its lags. It is silent about a missing action and about one with an unknown judgement.
    pub fn late_feedback<R: Rng + ?Sized>(&self, judged: [Judgement; LAGS], random: &mut R) -> Feedback {
        let mut draw = unit(random);
        let mut about = Judgement::Unknown;
        for (lag, judgement) in self.strategy.lags().into_iter().zip(judged) {
            if (0.0..lag).contains(&draw) {
                about = judgement;
            }
            draw -= lag;
        }
        match about {
            Judgement::Correct => self.feedback(true, random),
            Judgement::Incorrect => self.feedback(false, random),
            Judgement::Unknown => Feedback::Neutral,
        }
    }
}
