//! Simulated trainers. They need not behave as the agent expects.

use goodbot::feedback::{Feedback, Judged, LAGS, Strategy};
use goodbot::random::unit;
use rand_core::Rng;

/// A trainer who judges actions by the intended task.
pub trait Trainer {
    /// The feedback to an action that is correct, or not, for the intended task.
    fn feedback<R: Rng + ?Sized>(&self, correct: bool, random: &mut R) -> Feedback;
}

/// The feedback that a number from 0 to 1 draws, by the probabilities of reward and punishment; else silence.
pub fn drawn(draw: f32, [reward, punish]: [f32; 2]) -> Feedback {
    if draw < reward {
        Feedback::Reward
    } else if draw < reward + punish {
        Feedback::Punish
    } else {
        Feedback::Neutral
    }
}

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
        drawn(unit(random), [reward, punish])
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

impl Trainer for SimulatedTrainer {
    fn feedback<R: Rng + ?Sized>(&self, correct: bool, random: &mut R) -> Feedback {
        SimulatedTrainer::feedback(self, correct, random)
    }
}

/// A trainer who follows a strategy but may never reward, or never punish: silence replaces the withheld feedback.
///
/// The paper's second trainer "was only allowed to punish" (section 5), while its agent took a correct action to be rewarded three times out
/// of ten.
///
/// ```
/// use goodbot::feedback::Feedback;
/// use goodbot_course::{CourseTrainer, Trainer, generator};
/// let mut random = generator(1);
/// let said = (0..1_000).map(|_| CourseTrainer::PUNISH_ONLY.feedback(true, &mut random));
/// assert!(said.into_iter().all(|feedback| feedback != Feedback::Reward));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CourseTrainer {
    /// How often it is silent, and how often it takes a correct action for an incorrect one or the reverse.
    pub strategy: Strategy,
    /// Whether it ever rewards.
    pub rewards: bool,
    /// Whether it ever punishes.
    pub punishes: bool,
}

impl CourseTrainer {
    /// The paper's first trainer: silent seven times out of ten, one error in ten.
    pub const BALANCED: Self = Self::of(Strategy::BALANCED);
    /// The paper's second trainer: punishes nearly every action that it takes for incorrect, and never rewards.
    pub const PUNISH_ONLY: Self = Self { rewards: false, ..Self::of(Strategy::PUNISH_ONLY) };
    /// The mirror image: rewards nearly every action that it takes for correct, and never punishes.
    pub const REWARD_ONLY: Self = Self { punishes: false, ..Self::of(Strategy::REWARD_ONLY) };

    /// The three trainers, by name.
    pub const NAMED: [(&'static str, Self); 3] =
        [("balanced", Self::BALANCED), ("punish-only", Self::PUNISH_ONLY), ("reward-only", Self::REWARD_ONLY)];

    /// A trainer who withholds nothing.
    pub const fn of(strategy: Strategy) -> Self {
        Self { strategy, rewards: true, punishes: true }
    }
}

impl Trainer for CourseTrainer {
    fn feedback<R: Rng + ?Sized>(&self, correct: bool, random: &mut R) -> Feedback {
        match (SimulatedTrainer { strategy: self.strategy }).feedback(correct, random) {
            Feedback::Reward if !self.rewards => Feedback::Neutral,
            Feedback::Punish if !self.punishes => Feedback::Neutral,
            feedback => feedback,
        }
    }
}
