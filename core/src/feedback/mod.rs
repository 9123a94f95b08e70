//! Trainer feedback (paper, section 3; SABL): reward, punishment and silence as evidence about the intended task.
//!
//! - `strategy`: how a trainer rewards, punishes and stays silent;
//! - `belief`: the joint belief over tasks and trainer strategies, and how evidence changes it;
//! - `simulated`: a trainer that draws its feedback from a strategy.

pub(crate) mod belief;
pub(crate) mod simulated;
pub(crate) mod strategy;

pub use belief::{Belief, BeliefCount, BeliefError, BeliefRef, BeliefTables, BeliefTablesRef};
pub use simulated::SimulatedTrainer;
pub use strategy::{Feedback, Strategy, StrategyError, UnknownFeedback};
