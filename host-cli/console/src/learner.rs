//! The settings for understanding and learning words, by name.

use clap::ValueEnum;
use goodbot::language::Settings;
use goodbot::memory::AgentHeap;
use goodbot::{Capacities, Options};

/// The settings of the language model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Learner {
    /// The best for people's commands: the role model, and a layer above it that learns more from many sessions
    #[default]
    Default,
    /// The role model alone, as on boards, in C and on the page
    Roles,
    /// The paper's settings
    #[value(alias = "ibm2")]
    Paper,
}

impl Learner {
    /// The settings.
    pub const fn options(self) -> Options {
        match self {
            Self::Default => Options { language: Settings::LAYERED, ..Options::DEFAULT },
            Self::Roles => Options::DEFAULT,
            Self::Paper => Options::PAPER,
        }
    }
}

/// Memory for an agent with these settings. `tasks` is the number of possible tasks in all its sessions.
pub fn memory(capacities: &Capacities, settings: &Settings, tasks: usize) -> AgentHeap {
    let memory = AgentHeap::new(capacities);
    if settings.layer { goodbot_layer::above(memory, tasks) } else { memory }
}
