//! A simulated trainer, who draws feedback from a strategy.

use super::judged::Judged;
use super::strategy::{Feedback, LAGS, Strategy};
use crate::random::unit;
use rand_core::Rng;

/// A trainer who knows the intended task and follows a strategy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimulatedTrainer {
    /// The probabilities of its feedback.
    pub strategy: Strategy,
}

impl SimulatedTrainer {
    /// Its feedback to an action that is correct, or not, for the intended task. The same generator gives the same feedback on every
    /// target.
    pub fn feedback<R: Rng + ?Sized>(&self, correct: bool, random: &mut R) -> Feedback {
        self.said_to(if correct { Judged::Nearer } else { Judged::NotNearer }, random)
    }

    /// Its feedback to an action of this kind for the intended task; silence if the kind is unknown.
    fn said_to<R: Rng + ?Sized>(&self, judged: Judged, random: &mut R) -> Feedback {
        let probability = |feedback| self.strategy.probability_after(feedback, judged);
        let (Some(reward), Some(punish)) = (probability(Feedback::Reward), probability(Feedback::Punish)) else { return Feedback::Neutral };
        let draw = unit(random);
        if draw < reward {
            Feedback::Reward
        } else if draw < reward + punish {
            Feedback::Punish
        } else {
            Feedback::Neutral
        }
    }

    /// Its feedback after these actions, the last one first, each judged for the intended task. The lags decide which of the three the
    /// feedback is about. The trainer is silent about a missing action and about one with an unknown judgement.
    pub fn late_feedback<R: Rng + ?Sized>(&self, judged: [Judged; LAGS], random: &mut R) -> Feedback {
        let mut draw = unit(random);
        let mut about = Judged::Unknown;
        for (lag, judged) in self.strategy.lags().into_iter().zip(judged) {
            if (0.0..lag).contains(&draw) {
                about = judged;
            }
            draw -= lag;
        }
        self.said_to(about, random)
    }
}
