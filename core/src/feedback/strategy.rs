//! Trainer strategies: the probabilities of reward, punishment and silence after a correct and an incorrect action (paper, section 3), and
//! of their lag.

use super::judged::Judged;
use core::fmt;
use core::str::FromStr;

/// The trainer's word after an action.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("feedback is reward, punish or neutral")]
pub struct UnknownFeedback;

/// The number of actions that a word may be about: the last one, and those before it.
pub const LAGS: usize = 3;

/// The tolerance for the sum of the lags' probabilities.
const LAG_TOLERANCE: f32 = 1e-3;

/// The number of parameters for rests: see [`Strategy::with_rests`].
pub const RESTS: usize = 4;

/// A trainer strategy: three parameters for feedback to moves, four for rests and moves inside the goal, and three for the lag.
///
/// With lag k a word is about the action k actions before the last one. The paper's strategies have no lag: each word is about the last
/// action. They treat a rest like a move, and a move inside the goal as wrong.
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
    rests: [f32; RESTS],
}

/// The parameter of a strategy that is not a probability.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum StrategyError {
    /// mu+ is outside [0, 1] or not a number.
    #[error("mu+ must be a number from 0 to 1")]
    MuPlus,
    /// mu- is outside [0, 1] or not a number.
    #[error("mu- must be a number from 0 to 1")]
    MuMinus,
    /// epsilon is outside [0, 1] or not a number.
    #[error("epsilon must be a number from 0 to 1")]
    Epsilon,
    /// The probabilities of the lags are not from 0 to 1, or do not sum to 1.
    #[error("the lags must be three numbers from 0 to 1 that sum to 1")]
    Lags,
    /// A parameter for rests is outside [0, 1] or not a number.
    #[error("the four numbers about rests must be from 0 to 1")]
    Rests,
}

impl Strategy {
    /// Each word is about the last action.
    pub const NO_LAG: [f32; LAGS] = [1.0, 0.0, 0.0];

    /// The paper's setting: silence seven times out of ten, one error in ten.
    pub const BALANCED: Self = Self::known(0.7, 0.7, 0.1);
    /// The paper's trainer who punishes nearly every wrong action.
    pub const PUNISH_ONLY: Self = Self::known(0.7, 0.05, 0.1);
    /// The mirror image: a trainer who rewards nearly every right action.
    pub const REWARD_ONLY: Self = Self::known(0.05, 0.7, 0.1);

    /// Trainers who use both words, "good bot" alone or "bad bot" alone, each as probable as the others: the robot finds out which (I-SABL;
    /// paper, footnote 1). Silence then says something, so tell it too: [`Feedback::Neutral`].
    ///
    /// ```
    /// use goodbot::{Agent, HeapMemory, Options, feedback::Strategy, home::paper_tasks};
    /// let memory = HeapMemory::new(&goodbot::Capacities::SMALL);
    /// let mut agent = Agent::new(memory.agent, &paper_tasks()?, Options::DEFAULT)?;
    /// agent.set_strategies(&Strategy::ONE_BUTTON_OR_BOTH)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub const ONE_BUTTON_OR_BOTH: [(Self, f32); 3] = [(Self::BALANCED, 1.0), (Self::REWARD_ONLY, 1.0), (Self::PUNISH_ONLY, 1.0)];

    /// The value of unused memory.
    pub const UNUSED: Self = Self { lags: [0.0; LAGS], ..Self::known(0.0, 0.0, 0.0) };

    /// A strategy: the probability of silence after a correct action (`mu_plus`) and after an incorrect one (`mu_minus`), and of taking one
    /// for the other (`epsilon`), each in [0, 1]. It has no lag, and treats rests like moves.
    ///
    /// # Errors
    /// [`StrategyError`] names the parameter outside [0, 1].
    pub fn new(mu_plus: f32, mu_minus: f32, epsilon: f32) -> Result<Self, StrategyError> {
        let check = |value: f32, error| if (0.0..=1.0).contains(&value) { Ok(()) } else { Err(error) };
        check(mu_plus, StrategyError::MuPlus)?;
        check(mu_minus, StrategyError::MuMinus)?;
        check(epsilon, StrategyError::Epsilon)?;
        Ok(Self::known(mu_plus, mu_minus, epsilon))
    }

    /// A strategy without checks; the caller guarantees that the numbers are in range.
    const fn known(mu_plus: f32, mu_minus: f32, epsilon: f32) -> Self {
        Self { mu_plus, mu_minus, epsilon, lags: Self::NO_LAG, rests: [mu_plus, mu_minus, epsilon, 0.0] }
    }

    /// A strategy with its own parameters for rests.
    pub(crate) const fn of_people([mu_plus, mu_minus, epsilon]: [f32; 3], rests: [f32; RESTS], lags: [f32; LAGS]) -> Self {
        Self { mu_plus, mu_minus, epsilon, lags, rests }
    }

    /// The same strategy, whose words are about the last action with probability `lags[0]`, about the one before with `lags[1]`, and about
    /// the one before that with `lags[2]`.
    ///
    /// # Errors
    /// [`StrategyError::Lags`] if they are outside [0, 1] or do not sum to 1.
    pub fn with_lags(self, lags: [f32; LAGS]) -> Result<Self, StrategyError> {
        let sum: f32 = lags.iter().sum();
        let sound = lags.iter().all(|lag| (0.0..=1.0).contains(lag)) && (1.0 - LAG_TOLERANCE..=1.0 + LAG_TOLERANCE).contains(&sum);
        if sound { Ok(Self { lags, ..self }) } else { Err(StrategyError::Lags) }
    }

    /// The same strategy with its own parameters for rests: the probability of silence after a rest at the goal, and after one elsewhere;
    /// the probability of taking one for the other; and the degree to which a move from the goal to the goal counts as a rest there, from 0
    /// (a wrong move) to 1.
    ///
    /// ```
    /// use goodbot::feedback::{Feedback, Judged, Strategy};
    /// let patient = Strategy::BALANCED.with_rests([0.2, 0.9, 0.1, 1.0])?;
    /// assert_eq!(patient.probability(Feedback::Reward, true), Strategy::BALANCED.probability(Feedback::Reward, true));
    /// assert_eq!(patient.probability_after(Feedback::Reward, Judged::RestsAtGoal), Some(0.9 * 0.8));
    /// assert_eq!(patient.probability_after(Feedback::Reward, Judged::MovesInside), Some(0.9 * 0.8));
    /// assert_eq!(Strategy::BALANCED.with_rests([1.1, 0.9, 0.1, 1.0]).unwrap_err().to_string(), "the four numbers about rests must be from 0 to 1");
    /// # Ok::<(), goodbot::feedback::StrategyError>(())
    /// ```
    ///
    /// # Errors
    /// [`StrategyError::Rests`] if one is outside [0, 1].
    pub fn with_rests(self, rests: [f32; RESTS]) -> Result<Self, StrategyError> {
        let sound = rests.iter().all(|number| (0.0..=1.0).contains(number));
        if sound { Ok(Self { rests, ..self }) } else { Err(StrategyError::Rests) }
    }

    /// The parameters for rests: see [`with_rests`](Self::with_rests). By default they are mu+, mu-, epsilon and 0.
    pub fn rests(&self) -> [f32; RESTS] {
        self.rests
    }

    /// Whether rests are treated like moves, as in the paper.
    pub fn rests_as_it_moves(&self) -> bool {
        self.rests == [self.mu_plus, self.mu_minus, self.epsilon, 0.0]
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

    /// The probability of taking a correct action for an incorrect one, or the reverse.
    pub fn epsilon(&self) -> f32 {
        self.epsilon
    }

    /// The probability of a feedback after a move that is correct, or not, for the intended task.
    pub fn probability(&self, feedback: Feedback, correct: bool) -> f32 {
        said([self.mu_plus, self.mu_minus, self.epsilon], feedback, correct)
    }

    /// The probability of a feedback after an action of this kind for the intended task; `None` if the kind is unknown.
    pub fn probability_after(&self, feedback: Feedback, judged: Judged) -> Option<f32> {
        let [plus, minus, mistake, inside] = self.rests;
        let resting = |correct| said([plus, minus, mistake], feedback, correct);
        Some(match judged {
            Judged::Nearer => self.probability(feedback, true),
            Judged::NotNearer => self.probability(feedback, false),
            Judged::RestsAtGoal => resting(true),
            Judged::RestsElsewhere => resting(false),
            Judged::MovesInside => inside * resting(true) + (1.0 - inside) * self.probability(feedback, false),
            Judged::Unknown => return None,
        })
    }

    /// The probability of a feedback after these actions, the last one first, each judged for one task: the mean over the actions that the
    /// word may be about. The mean leaves out actions that are missing or have an unknown judgement; `None` if none is left.
    ///
    /// ```
    /// use goodbot::feedback::{Feedback, Judged::{Nearer, NotNearer, Unknown}, Strategy};
    /// let slow = Strategy::BALANCED.with_lags([0.5, 0.5, 0.0])?;
    /// let (right, wrong) = (slow.probability(Feedback::Reward, true), slow.probability(Feedback::Reward, false));
    /// assert_eq!(slow.likelihood(Feedback::Reward, [Nearer, NotNearer, Nearer]), Some((right + wrong) / 2.0));
    /// // The first action of a session: the word can only be about it.
    /// assert_eq!(slow.likelihood(Feedback::Reward, [Nearer, Unknown, Unknown]), Some(right));
    /// assert_eq!(slow.likelihood(Feedback::Reward, [Unknown; 3]), None);
    /// # Ok::<(), goodbot::feedback::StrategyError>(())
    /// ```
    pub fn likelihood(&self, feedback: Feedback, judged: [Judged; LAGS]) -> Option<f32> {
        let (mut sum, mut whole) = (0.0, 0.0);
        for (lag, judged) in self.lags.into_iter().zip(judged) {
            if lag <= 0.0 {
                continue;
            }
            if let Some(probability) = self.probability_after(feedback, judged) {
                sum += lag * probability;
                whole += lag;
            }
        }
        (whole > 0.0).then_some(sum / whole)
    }
}

/// The probability of a feedback, from the probabilities of silence after right and wrong actions, and of a mistake.
#[inline(never)]
fn said([mu_plus, mu_minus, epsilon]: [f32; 3], feedback: Feedback, correct: bool) -> f32 {
    let seen_correct = if correct { 1.0 - epsilon } else { epsilon };
    let seen_incorrect = 1.0 - seen_correct;
    match feedback {
        Feedback::Reward => seen_correct * (1.0 - mu_plus),
        Feedback::Punish => seen_incorrect * (1.0 - mu_minus),
        Feedback::Neutral => seen_correct * mu_plus + seen_incorrect * mu_minus,
    }
}
