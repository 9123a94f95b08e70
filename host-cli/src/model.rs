//! Settings of the model by name.

use clap::ValueEnum;
use goodbot::Options;

/// A model of language and learning.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Model {
    /// What understands people best: Model 2 with drawn alignments, four letters a word, facts beside their proposition
    #[default]
    Default,
    /// The paper's settings
    Paper,
}

impl Model {
    /// The settings.
    pub const fn options(self) -> Options {
        match self {
            Self::Default => Options::DEFAULT,
            Self::Paper => Options::PAPER,
        }
    }
}
