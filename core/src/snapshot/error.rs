//! Why a model could not be saved or restored.

use crate::capacity::CapacityError;
use core::fmt;

/// Why a model could not be saved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum SaveError {
    /// The buffer is too small.
    Buffer {
        /// Bytes that the model takes.
        needed: usize,
        /// Bytes of the buffer.
        given: usize,
    },
    /// A setting or a weight is one that could not be restored: not a number, negative, or beyond any use.
    Unsound,
    /// The last session is still being learned from: it has not wholly joined the training data, or training needs the memory that the model
    /// would be written to. Or a model is coming back and is not all there.
    StillLearning,
    /// The model was saved in parts, and what was learned has changed since the first.
    Changed,
    /// Model 2 has no parameters of the role model to be saved alone.
    NoRoles,
}

impl fmt::Display for SaveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Buffer { needed, given } => write!(f, "the model takes {needed} bytes and the buffer has {given}; give it a larger one"),
            Self::Unsound => f.write_str("a setting or a weight is not a number, negative or too large; correct it before saving"),
            Self::StillLearning => f.write_str("the last session is still being learned from; go on until it is done, then save"),
            Self::Changed => f.write_str("what was learned has changed since saving began; begin to save anew"),
            Self::NoRoles => f.write_str("this is Model 2, without parameters of roles; save the whole model"),
        }
    }
}

impl core::error::Error for SaveError {}

/// Why a model could not be restored. The robot is unchanged, but for [`Interrupted`](Self::Interrupted).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum RestoreError {
    /// The bytes do not begin as a model does.
    NotAModel,
    /// A format that this version does not know.
    Version {
        /// The format's number.
        found: u16,
    },
    /// The bytes are fewer or more than the model says.
    Length {
        /// Bytes that the model says.
        stated: u32,
        /// Bytes that were given.
        given: usize,
    },
    /// The check at the end is wrong: the bytes were damaged.
    Damaged,
    /// The check is right, but a part says what cannot be.
    Inconsistent(Part),
    /// It was learned in a domain of another vocabulary.
    OtherDomain,
    /// Its words or machine commands are formed in another way than here, so the two cannot be joined.
    OtherForms,
    /// It does not fit into this memory.
    Capacity(CapacityError),
    /// The bytes do not begin as a file of parameters does.
    NoParameters,
    /// The parameters are of tasks with a way, which this library was built without.
    Ways,
    /// Something else began before the whole model was there. What was learned before is forgotten by then.
    Interrupted,
}

/// A part of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Part {
    /// The digest of the domain's vocabulary, or the sizes.
    Head,
    /// How it learns.
    Options,
    /// The trainer strategies.
    Strategies,
    /// The English words.
    Words,
    /// The machine tokens.
    Tokens,
    /// The machine commands.
    Commands,
    /// The sessions.
    Sessions,
    /// The weighted pairs.
    Pairs,
    /// Which commands were heard more than once.
    HeardAgain,
    /// The tasks that sessions could have meant.
    Possible,
    /// How late the trainer strategies' words come, and how probable the strategies were before the trainer was met.
    Trainers,
    /// How each trainer strategy judges rests.
    Rests,
    /// The role model's parameters.
    Parameters,
}

impl Part {
    /// Its name in messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Head => "head",
            Self::Options => "options",
            Self::Strategies => "strategies",
            Self::Words => "words",
            Self::Tokens => "tokens",
            Self::Commands => "machine commands",
            Self::Sessions => "sessions",
            Self::Pairs => "pairs",
            Self::HeardAgain => "marks of commands heard again",
            Self::Possible => "possible tasks",
            Self::Trainers => "trainers' lags",
            Self::Rests => "what trainers say to rests",
            Self::Parameters => "parameters",
        }
    }
}

impl From<CapacityError> for RestoreError {
    fn from(error: CapacityError) -> Self {
        Self::Capacity(error)
    }
}

impl fmt::Display for RestoreError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotAModel => f.write_str("this is not a goodbot model"),
            Self::Version { found } => write!(
                f,
                "the model has format {found}, and this version reads formats {} to {}",
                super::record::OLDEST_VERSION,
                super::record::LAYERED_VERSION
            ),
            Self::Length { stated, given } => write!(f, "the model says that it has {stated} bytes, and {given} are here"),
            Self::Damaged => f.write_str("the model is damaged: its check does not match; take another copy"),
            Self::Inconsistent(part) => write!(f, "the model's {} cannot be; it was not written by goodbot", part.name()),
            Self::OtherDomain => f.write_str("the model was learned in a domain of another vocabulary"),
            Self::OtherForms => f.write_str(
                "the models form words or machine commands differently (letters of a word that count, order of facts); \
                 learn both with the same settings",
            ),
            Self::Capacity(error) => error.fmt(f),
            Self::NoParameters => f.write_str("this is no file of parameters; `goodbot parameters` writes one"),
            Self::Ways => f.write_str("it knows ways; build goodbot with the feature `ways`"),
            Self::Interrupted => f.write_str("something else began before the whole model was there; restore it anew"),
        }
    }
}

impl core::error::Error for RestoreError {}
