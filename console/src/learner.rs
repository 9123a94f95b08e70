//! How words are understood and learned, by name.

use clap::ValueEnum;
use goodbot::Options;

/// What learns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Learner {
    /// What understands people best
    #[default]
    Default,
    /// The paper's settings
    #[value(alias = "ibm2")]
    Paper,
}

impl Learner {
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
