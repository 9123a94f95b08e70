//! Why a model could not be saved or restored.

use crate::capacity::CapacityError;

/// Why a model could not be saved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SaveError {
    /// The buffer is too small.
    #[error("the model takes {needed} bytes and the buffer has {given}; give it a larger one")]
    Buffer {
        /// Bytes that the model takes.
        needed: usize,
        /// Bytes of the buffer.
        given: usize,
    },
    /// A setting or a weight could not be restored: it is not a number, negative, or too large.
    #[error("a setting or a weight is not a number, negative or too large; correct it before saving")]
    Unsound,
    /// The last session is still being learned from: it has not fully joined the training data, or training needs the memory that the model
    /// would be written to. Or a model is being restored and is not complete.
    #[error("the last session is still being learned from; go on until it is done, then save")]
    StillLearning,
    /// The model was saved in parts, and the training data have changed since the first part.
    #[error("what was learned has changed since saving began; begin to save anew")]
    Changed,
    /// Model 2 has no role model's parameters to save.
    #[error("this is Model 2, without parameters of roles; save the whole model")]
    NoRoles,
}

/// Why a model could not be restored. The robot is unchanged, except for [`Interrupted`](Self::Interrupted).
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RestoreError {
    /// The bytes do not begin as a model file does.
    #[error("this is not a goodbot model")]
    NotAModel,
    /// A format that this version cannot read.
    #[error(
        "the model has format {found}, and this version reads formats {} to {}",
        super::record::OLDEST_VERSION,
        super::record::LAYERED_VERSION
    )]
    Version {
        /// The format's number.
        found: u16,
    },
    /// There are fewer or more bytes than the model states.
    #[error("the model has {stated} bytes, and {given} are here; take another copy")]
    Length {
        /// The stated number of bytes.
        stated: u32,
        /// The given number of bytes.
        given: usize,
    },
    /// The check at the end does not match: the bytes were damaged.
    #[error("the model is damaged: its check does not match; take another copy")]
    Damaged,
    /// The check matches, but a part has impossible values.
    #[error("the model's {} cannot be; it was not written by goodbot", .0.name())]
    Inconsistent(Part),
    /// It was learned in a domain with another vocabulary. One with fewer propositional functions or attributes is taken by
    /// [`Agent::restore_earlier`](crate::Agent::restore_earlier).
    #[error("the model was learned in a domain of another vocabulary")]
    OtherDomain,
    /// Its words or machine commands are formed differently from those here, so the two models cannot be joined.
    #[error(
        "the models form words or machine commands differently (letters of a word that count, order of facts); \
         learn both with the same settings"
    )]
    OtherForms,
    /// It does not fit into this memory.
    #[error(transparent)]
    Capacity(#[from] CapacityError),
    /// The bytes do not begin as a file of parameters does.
    #[error("this is no file of parameters; `goodbot parameters` writes one")]
    NoParameters,
    /// The parameters are for tasks with a way, and this library was built without ways.
    #[error("it knows ways; build goodbot with the feature `ways`")]
    Ways,
    /// Something else began before the model was complete. The earlier training data are forgotten by then.
    #[error("something else began before the whole model was there; restore it anew")]
    Interrupted,
}

/// A part of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Part {
    /// The digest of the domain's vocabulary, or the sizes.
    Head,
    /// The options.
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
    /// The lags of the trainer strategies, and their probabilities before the trainer was met.
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
