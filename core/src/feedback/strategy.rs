//! Trainer strategies: how probable reward, punishment and silence are after a correct and an incorrect action (paper, section 3), and
//! how late they come.

use crate::planning::Judgement;
use core::fmt;
use core::str::FromStr;

/// What the trainer says after an action.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
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
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct UnknownFeedback;

impl fmt::Display for UnknownFeedback {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("feedback is reward, punish or neutral")
    }
}

impl core::error::Error for UnknownFeedback {}

/// The number of actions that a word can judge: the last one, and those before it.
pub const LAGS: usize = 3;

/// The tolerance for the sum of the lags' probabilities.
const LAG_TOLERANCE: f32 = 1e-3;

/// A trainer strategy: three probabilities for feedback, and three for its lag.
///
/// With lag k a word is about the action k actions before the last one. The paper's strategies have no lag: each word is about the last
/// action.
///
/// ```
/// use goodbot::feedback::{Feedback, Strategy};
/// let balanced = Strategy::BALANCED;
/// // Right actions are rewarded three times out of ten, but one time in ten the trainer takes a right action for a wrong one.
/// assert!((balanced.probability(Feedback::Reward, true) - 0.27).abs() < 1e-6);
/// assert!(Strategy::new(0.7, 1.2, 0.1).is_err());
///
/// // One word in four is about the action before the last one.
/// let slow = balanced.with_lags([0.75, 0.25, 0.0])?;
/// assert_eq!(slow.lags(), [0.75, 0.25, 0.0]);
/// assert_eq!(balanced.with_lags([0.75, 0.0, 0.0]).unwrap_err().to_string(), "the lags must be three numbers from 0 to 1 that sum to 1");
/// # Ok::<(), goodbot::feedback::StrategyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strategy {
    mu_plus: f32,
    mu_minus: f32,
    epsilon: f32,
    lags: [f32; LAGS],
}

/// Which parameter of a strategy is not a probability.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum StrategyError {
    /// mu+ is outside [0, 1] or not a number.
    MuPlus,
    /// mu- is outside [0, 1] or not a number.
    MuMinus,
    /// epsilon is outside [0, 1] or not a number.
    Epsilon,
    /// The probabilities of the lags are not from 0 to 1, or do not sum to 1.
    Lags,
}

impl fmt::Display for StrategyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::MuPlus => "mu+ must be a number from 0 to 1",
            Self::MuMinus => "mu- must be a number from 0 to 1",
            Self::Epsilon => "epsilon must be a number from 0 to 1",
            Self::Lags => "the lags must be three numbers from 0 to 1 that sum to 1",
        })
    }
}

impl core::error::Error for StrategyError {}

impl Strategy {
    /// Each word is about the last action.
    pub const NO_LAG: [f32; LAGS] = [1.0, 0.0, 0.0];

    /// The paper's setting: silence seven times out of ten, one error in ten.
    pub const BALANCED: Self = Self { mu_plus: 0.7, mu_minus: 0.7, epsilon: 0.1, lags: Self::NO_LAG };
    /// The paper's trainer who punishes nearly every wrong action.
    pub const PUNISH_ONLY: Self = Self { mu_plus: 0.7, mu_minus: 0.05, epsilon: 0.1, lags: Self::NO_LAG };
    /// The mirror image: a trainer who rewards nearly every right action.
    pub const REWARD_ONLY: Self = Self { mu_plus: 0.05, mu_minus: 0.7, epsilon: 0.1, lags: Self::NO_LAG };

    /// The value of unused memory.
    pub const UNUSED: Self = Self { mu_plus: 0.0, mu_minus: 0.0, epsilon: 0.0, lags: [0.0; LAGS] };

    /// A strategy: the probability of silence after a correct action (`mu_plus`) and after an incorrect one (`mu_minus`), and of taking
    /// one for the other (`epsilon`), each in [0, 1]. It has no lag.
    ///
    /// # Errors
    /// [`StrategyError`] names the parameter outside [0, 1].
    pub fn new(mu_plus: f32, mu_minus: f32, epsilon: f32) -> Result<Self, StrategyError> {
        let check = |value: f32, error| if (0.0..=1.0).contains(&value) { Ok(()) } else { Err(error) };
        check(mu_plus, StrategyError::MuPlus)?;
        check(mu_minus, StrategyError::MuMinus)?;
        check(epsilon, StrategyError::Epsilon)?;
        Ok(Self { mu_plus, mu_minus, epsilon, lags: Self::NO_LAG })
    }

    /// A strategy without checks; the caller guarantees sound numbers.
    pub(super) const fn known(mu_plus: f32, mu_minus: f32, epsilon: f32, lags: [f32; LAGS]) -> Self {
        Self { mu_plus, mu_minus, epsilon, lags }
    }

    /// The same strategy, whose words are about the last action with probability `lags[0]`, about the one before with `lags[1]`, and about
    /// the one before that with `lags[2]`.
    ///
    /// # Errors
    /// [`StrategyError::Lags`] where they are outside [0, 1] or do not sum to 1.
    pub fn with_lags(self, lags: [f32; LAGS]) -> Result<Self, StrategyError> {
        let sum: f32 = lags.iter().sum();
        let sound = lags.iter().all(|lag| (0.0..=1.0).contains(lag)) && (1.0 - LAG_TOLERANCE..=1.0 + LAG_TOLERANCE).contains(&sum);
        if sound { Ok(Self { lags, ..self }) } else { Err(StrategyError::Lags) }
    }

    /// The probability that a word is about the last action, about the one before, and about the one before that.
    pub fn lags(&self) -> [f32; LAGS] {
        self.lags
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

    /// The probability of a feedback after these actions, the last one first, each judged for one task: the mean over the actions that the
    /// word may judge. The mean leaves out actions that are missing or have an unknown judgement; `None` if none is left.
    ///
    /// ```
    /// use goodbot::feedback::{Feedback, Strategy};
    /// use goodbot::planning::Judgement::{Correct, Incorrect, Unknown};
    /// let slow = Strategy::BALANCED.with_lags([0.5, 0.5, 0.0])?;
    /// let (right, wrong) = (slow.probability(Feedback::Reward, true), slow.probability(Feedback::Reward, false));
    /// assert_eq!(slow.likelihood(Feedback::Reward, [Correct, Incorrect, Correct]), Some((right + wrong) / 2.0));
    /// // The first action of a session: the word can only be about it.
    /// assert_eq!(slow.likelihood(Feedback::Reward, [Correct, Unknown, Unknown]), Some(right));
    /// assert_eq!(slow.likelihood(Feedback::Reward, [Unknown; 3]), None);
    /// # Ok::<(), goodbot::feedback::StrategyError>(())
    /// ```
    pub fn likelihood(&self, feedback: Feedback, judged: [Judgement; LAGS]) -> Option<f32> {
        let (mut sum, mut whole) = (0.0, 0.0);
        for (lag, judgement) in self.lags.into_iter().zip(judged) {
            if judgement != Judgement::Unknown && lag > 0.0 {
                sum += lag * self.probability(feedback, judgement == Judgement::Correct);
                whole += lag;
            }
        }
        (whole > 0.0).then_some(sum / whole)
    }
}
