//! Trainer strategies: how probable reward, punishment and silence are after a correct and an incorrect action (paper, section 3).

use core::fmt;
use core::str::FromStr;

/// What the trainer says after an action.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Feedback {
    /// "Good bot."
    Reward,
    /// "Bad bot."
    Punish,
    /// Silence.
    #[default]
    Neutral,
}

impl Feedback {
    /// Its name in logs.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Reward => "reward",
            Self::Punish => "punish",
            Self::Neutral => "neutral",
        }
    }
}

impl fmt::Display for Feedback {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Feedback {
    type Err = UnknownFeedback;

    /// ```
    /// use goodbot::feedback::Feedback;
    /// assert_eq!(Feedback::Punish.to_string().parse(), Ok(Feedback::Punish));
    /// assert_eq!("bad bot".parse::<Feedback>().unwrap_err().to_string(), "feedback is reward, punish or neutral");
    /// ```
    fn from_str(name: &str) -> Result<Self, UnknownFeedback> {
        [Self::Reward, Self::Punish, Self::Neutral].into_iter().find(|feedback| feedback.name() == name).ok_or(UnknownFeedback)
    }
}

/// There is no feedback of this name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnknownFeedback;

impl fmt::Display for UnknownFeedback {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("feedback is reward, punish or neutral")
    }
}

impl core::error::Error for UnknownFeedback {}

/// A trainer strategy: three probabilities.
///
/// ```
/// use goodbot::feedback::{Feedback, Strategy};
/// let balanced = Strategy::BALANCED;
/// // Right actions are rewarded three times out of ten, but one time in ten the trainer takes a right action for a wrong one.
/// assert!((balanced.probability(Feedback::Reward, true) - 0.27).abs() < 1e-6);
/// assert!(Strategy::new(0.7, 1.2, 0.1).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strategy {
    mu_plus: f32,
    mu_minus: f32,
    epsilon: f32,
}

/// Which parameter of a strategy is not a probability.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum StrategyError {
    /// mu+ is outside [0, 1] or not a number.
    MuPlus,
    /// mu- is outside [0, 1] or not a number.
    MuMinus,
    /// epsilon is outside [0, 1] or not a number.
    Epsilon,
}

impl fmt::Display for StrategyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::MuPlus => "mu+ must be a number from 0 to 1",
            Self::MuMinus => "mu- must be a number from 0 to 1",
            Self::Epsilon => "epsilon must be a number from 0 to 1",
        })
    }
}

impl core::error::Error for StrategyError {}

impl Strategy {
    /// The paper's setting: silence seven times out of ten, one error in ten.
    pub const BALANCED: Self = Self { mu_plus: 0.7, mu_minus: 0.7, epsilon: 0.1 };
    /// The paper's trainer who punishes nearly every wrong action.
    pub const PUNISH_ONLY: Self = Self { mu_plus: 0.7, mu_minus: 0.05, epsilon: 0.1 };
    /// The mirror image: a trainer who rewards nearly every right action.
    pub const REWARD_ONLY: Self = Self { mu_plus: 0.05, mu_minus: 0.7, epsilon: 0.1 };

    /// What unused memory holds.
    pub const UNUSED: Self = Self { mu_plus: 0.0, mu_minus: 0.0, epsilon: 0.0 };

    /// A strategy: the probability of silence after a correct action (`mu_plus`) and after an incorrect one (`mu_minus`), and of taking
    /// one for the other (`epsilon`), each in [0, 1].
    ///
    /// # Errors
    /// [`StrategyError`] names the parameter that is not.
    pub fn new(mu_plus: f32, mu_minus: f32, epsilon: f32) -> Result<Self, StrategyError> {
        let check = |value: f32, error| if (0.0..=1.0).contains(&value) { Ok(()) } else { Err(error) };
        check(mu_plus, StrategyError::MuPlus)?;
        check(mu_minus, StrategyError::MuMinus)?;
        check(epsilon, StrategyError::Epsilon)?;
        Ok(Self { mu_plus, mu_minus, epsilon })
    }

    /// The probability of silence after a correct action.
    pub fn mu_plus(&self) -> f32 {
        self.mu_plus
    }

    /// The probability of silence after an incorrect action.
    pub fn mu_minus(&self) -> f32 {
        self.mu_minus
    }

    /// The probability of taking a correct action for an incorrect one, or the other way round.
    pub fn epsilon(&self) -> f32 {
        self.epsilon
    }

    /// The probability of a feedback after an action that is correct, or is not, for the intended task.
    pub fn probability(&self, feedback: Feedback, correct: bool) -> f32 {
        let seen_correct = if correct { 1.0 - self.epsilon } else { self.epsilon };
        let seen_incorrect = 1.0 - seen_correct;
        match feedback {
            Feedback::Reward => seen_correct * (1.0 - self.mu_plus),
            Feedback::Punish => seen_incorrect * (1.0 - self.mu_minus),
            Feedback::Neutral => seen_correct * self.mu_plus + seen_incorrect * self.mu_minus,
        }
    }
}
