//! Settings of the model by name.

use clap::ValueEnum;
use goodbot::Options;

/// A model of language and learning.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Model {
    /// What understands people best
    #[default]
    Default,
    /// The paper's settings
    #[value(alias = "ibm2")]
    Paper,
}

impl Model {
    /// Its name in output.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Default => "default",
            Self::Paper => "paper",
        }
    }

    /// The settings.
    pub const fn options(self) -> Options {
        match self {
            Self::Default => Options::DEFAULT,
            Self::Paper => Options::PAPER,
        }
    }
}
