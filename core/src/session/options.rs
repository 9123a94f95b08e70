//! How an agent understands and learns, and the memory it needs.

use super::candidates::CandidateMemory;
use crate::feedback::BeliefMemory;
use crate::language::{LanguageMemory, SettingError, Settings};
use crate::planning::{GoalMemory, PlanMemory};
use crate::task::GroundedTask;

/// How machine commands are weighted when a session ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Weights {
    /// By their own explanation of the command too (paper, Algorithm 1).
    #[default]
    Paper,
    /// By the tasks' posterior alone, evenly over each task's constraints (the authors' later program).
    Belief,
}

/// How an agent understands and learns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The language model's training.
    pub language: Settings,
    /// How machine commands are weighted.
    pub weights: Weights,
    /// Weights up to this are dropped; less than 1.
    pub least_weight: f32,
}

impl Options {
    /// The paper's.
    pub const PAPER: Self = Self { language: Settings::PAPER, weights: Weights::Paper, least_weight: 5e-5 };

    /// The paper's, with the language model that understands people best: [`Settings::DEFAULT`].
    pub const DEFAULT: Self = Self { language: Settings::DEFAULT, ..Self::PAPER };

    /// Whether an agent can learn with them.
    ///
    /// # Errors
    /// A [`SettingError`] that names the first that is none.
    pub fn check(&self) -> Result<(), SettingError> {
        self.language.check()?;
        if (0.0..1.0).contains(&self.least_weight) { Ok(()) } else { Err(SettingError::LeastWeight) }
    }
}

impl Default for Options {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// Memory for what one session needs.
#[derive(Debug)]
pub struct SessionMemory<'m> {
    /// One entry a grounded task.
    pub tasks: &'m mut [GroundedTask],
    /// The machine commands.
    pub candidates: CandidateMemory<'m>,
    /// The belief.
    pub belief: BeliefMemory<'m>,
    /// The goals.
    pub goals: GoalMemory<'m>,
    /// The search.
    pub plan: PlanMemory<'m>,
}

/// Memory for an [`Agent`](super::Agent).
#[derive(Debug)]
pub struct AgentMemory<'m> {
    /// What it learns.
    pub language: LanguageMemory<'m>,
    /// What one session needs.
    pub session: SessionMemory<'m>,
}
