//! The settings of the language model, and their ranges.

use crate::decimal::Decimal;
use crate::task::TokenOrder;
use core::fmt;

/// The most rounds of EM, so that no setting makes training endless.
pub const MOST_ROUNDS: u32 = 1_000;
/// The largest weight and pseudo-count, so that no sum of them overflows.
pub const MOST_WEIGHT: f32 = 1e6;

/// The model that explains words.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Model {
    /// IBM Model 2, the paper's: every word translates one token of a machine command, or none. With the feature `model2`, which is on
    /// by default.
    #[default]
    Model2,
    /// [`roles`](super::roles): every word is background, indicates the kind of task, or names a value of an object in a role.
    Roles,
}

impl Model {
    /// The model that is built in. Without the feature `model2` it is always the role model, and the compiler leaves out the code of Model
    /// 2.
    #[inline]
    pub(crate) const fn in_use(self) -> Self {
        if cfg!(feature = "model2") { self } else { Self::Roles }
    }

    /// Whether the model is built in.
    #[inline]
    pub(crate) const fn is_there(self) -> bool {
        cfg!(feature = "model2") || matches!(self, Self::Roles)
    }
}

/// The settings of the language model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// The model. `smoothing`, `alignment_prior`, `length` and `order` are for Model 2 alone.
    pub model: Model,
    /// The pseudo-count of every word for every machine token.
    pub smoothing: f32,
    /// The pseudo-count, for each word's position, of a uniform alignment.
    pub alignment_prior: f32,
    /// Rounds of EM. The role model takes up to half as many more, the more sessions there are; with ways, always a quarter more.
    pub rounds: u32,
    /// Whether the command's length counts too, as a factor Pr(n|l).
    pub length: bool,
    /// The number of letters of a word that count: words that begin with the same letters are one word. 0 for whole words. Model 2 cuts off
    /// the other letters; the role model keeps the word that it heard first.
    pub word_letters: u8,
    /// The position of a constraint's facts in a machine command.
    pub order: TokenOrder,
    /// Whether to train the [`layer`](super::layer) above the role model, in memory [with room for
    /// it](crate::memory::AgentHeap::with_layer).
    #[cfg(feature = "layer")]
    pub layer: bool,
}

impl Settings {
    /// The paper's settings: smoothing 0.1, no alignment prior, 10 rounds, no length factor, whole words, facts by attribute.
    pub const PAPER: Self = Self {
        model: Model::Model2,
        smoothing: 0.1,
        alignment_prior: 0.0,
        rounds: 10,
        length: false,
        word_letters: 0,
        order: TokenOrder::Attributes,
        #[cfg(feature = "layer")]
        layer: false,
    };

    /// Model 2 for short commands with few words: alignments drawn towards uniform by 4 pseudo-counts, 8 rounds, smoothing 0.01, four
    /// letters per word, and facts beside their proposition.
    pub const SMOOTHED: Self =
        Self { smoothing: 0.01, alignment_prior: 4.0, rounds: 8, word_letters: 4, order: TokenOrder::Propositions, ..Self::PAPER };

    /// The settings that understand people best without a heap: the role model, 8 to 12 rounds, words with the same first four letters are
    /// one.
    pub const DEFAULT: Self = Self { model: Model::Roles, ..Self::SMOOTHED };

    /// The default, with the [`layer`](super::layer) above it: the settings of hosts.
    #[cfg(feature = "layer")]
    pub const LAYERED: Self = Self { layer: true, ..Self::DEFAULT };
}

impl Settings {
    /// Whether there is a [`layer`](super::layer) above the role model.
    #[cfg(feature = "layer")]
    pub(crate) fn has_layer(&self) -> bool {
        self.layer && self.model.in_use() == Model::Roles
    }

    /// The number of letters of a word that a model keeps; 0 for all. The role model keeps a word as it heard it first, however many
    /// letters count.
    ///
    /// ```
    /// use goodbot::language::Settings;
    /// assert_eq!((Settings::SMOOTHED.letters_kept(), Settings::DEFAULT.letters_kept()), (4, 0));
    /// ```
    pub const fn letters_kept(&self) -> usize {
        match self.model.in_use() {
            Model::Model2 => self.word_letters as usize,
            Model::Roles => 0,
        }
    }

    /// Checks that every setting is in its range.
    ///
    /// # Errors
    /// A [`SettingError`] that names the first setting out of range.
    pub fn check(&self) -> Result<(), SettingError> {
        let sound = |sound: bool, error| if sound { Ok(()) } else { Err(error) };
        sound(self.model.is_there(), SettingError::Model(self.model))?;
        sound(is_weight(self.smoothing), SettingError::Smoothing(self.smoothing))?;
        sound(is_weight(self.alignment_prior), SettingError::AlignmentPrior(self.alignment_prior))?;
        sound(self.rounds <= MOST_ROUNDS, SettingError::Rounds(self.rounds))
    }
}

/// Whether a weight or pseudo-count can be used for training: neither infinite nor negative.
pub(crate) fn is_weight(value: f32) -> bool {
    (0.0..=MOST_WEIGHT).contains(&value)
}

/// A setting that is out of range, with its value.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SettingError {
    /// [`Settings::model`]: the model is not built in.
    Model(Model),
    /// [`Settings::smoothing`].
    Smoothing(f32),
    /// [`Settings::alignment_prior`].
    AlignmentPrior(f32),
    /// [`Settings::rounds`].
    Rounds(u32),
    /// [`Options::least_weight`](crate::Options::least_weight).
    LeastWeight(f32),
    /// [`Options::drift`](crate::Options::drift).
    Drift(f32),
    /// [`Options::done`](crate::Options::done).
    Done(f32),
    /// [`Options::ending`](crate::Options::ending).
    Ending,
    /// The cost of a question: `Asking::kappa`.
    Kappa(f32),
    /// The probability of a wrong answer: `Asking::eta`.
    Eta(f32),
    /// The probability from which the robot is sure: `Asking::sure`.
    Sure(f32),
    /// The trainer's patience in steps: `Asking::patience`.
    Patience(f32),
}

impl SettingError {
    /// The field to correct.
    pub const fn field(self) -> &'static str {
        match self {
            Self::Model(_) => "Settings::model",
            Self::Smoothing(_) => "Settings::smoothing",
            Self::AlignmentPrior(_) => "Settings::alignment_prior",
            Self::Rounds(_) => "Settings::rounds",
            Self::LeastWeight(_) => "Options::least_weight",
            Self::Drift(_) => "Options::drift",
            Self::Done(_) => "Options::done",
            Self::Ending => "Options::ending",
            Self::Kappa(_) => "Asking::kappa",
            Self::Eta(_) => "Asking::eta",
            Self::Sure(_) => "Asking::sure",
            Self::Patience(_) => "Asking::patience",
        }
    }
}

impl fmt::Display for SettingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let field = self.field();
        match self {
            Self::Model(_) => write!(f, "{field} is Model 2, which needs goodbot's feature model2; build with it, or take the role model"),
            Self::Smoothing(value) | Self::AlignmentPrior(value) => {
                write!(f, "{field} is {}; it must be a number from 0 to 1000000", Decimal(*value))
            }
            Self::Rounds(value) => write!(f, "{field} is {value}; it must be 1000 at most"),
            Self::LeastWeight(value) | Self::Done(value) => {
                write!(f, "{field} is {}; it must be a number from 0 to less than 1", Decimal(*value))
            }
            Self::Drift(value) | Self::Sure(value) => write!(f, "{field} is {}; it must be a number from 0 to 1", Decimal(*value)),
            Self::Kappa(value) => write!(f, "{field} is {}; it must be a number above 0, or infinite", Decimal(*value)),
            Self::Patience(value) => write!(f, "{field} is {}; it must be a number of 0 or more", Decimal(*value)),
            Self::Eta(value) => write!(f, "{field} is {}; it must be a number from 0 to less than 0.5", Decimal(*value)),
            Self::Ending => write!(f, "{field} has a probability that is not from 0 to less than 1 at every moment"),
        }
    }
}

impl core::error::Error for SettingError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_that_nothing_can_be_learned_with_are_refused_by_name() {
        for wrong in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -0.1, 1.1e6] {
            let error = Settings { smoothing: wrong, ..Settings::PAPER }.check().unwrap_err();
            assert!(matches!(error, SettingError::Smoothing(value) if value.to_bits() == wrong.to_bits()));
            let error = Settings { alignment_prior: wrong, ..Settings::DEFAULT }.check().unwrap_err();
            assert!(matches!(error, SettingError::AlignmentPrior(value) if value.to_bits() == wrong.to_bits()));
        }
        assert_eq!(Settings { rounds: 1_001, ..Settings::PAPER }.check(), Err(SettingError::Rounds(1_001)));
        assert_eq!((Settings::PAPER.check(), Settings::DEFAULT.check()), (Ok(()), Ok(())));
    }
}
