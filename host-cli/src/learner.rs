//! How words are understood and learned, by name.

use clap::ValueEnum;
use goodbot::Options;
use goodbot::language::{Model, Settings};

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

/// How many letters of a word a model keeps, 0 for all. The role model keeps a word as it heard it first, however many letters count.
pub fn letters_kept(settings: &Settings) -> usize {
    match settings.model {
        Model::Model2 => usize::from(settings.word_letters),
        Model::Roles => 0,
    }
}
