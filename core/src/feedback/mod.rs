//! Trainer feedback (paper, section 3; SABL): reward, punishment and silence as evidence about the intended task.
//!
//! - `strategy`: how a trainer rewards, punishes and stays silent, and how late;
//! - `judged`: what an action is for a task;
//! - `ending`: when a trainer ends a session;
//! - `belief`: the joint belief over tasks and trainer strategies, and how evidence changes it;
//! - `information`: the expected information of a word, in bits;
//! - [`population`]: the strategies of real people;
//! - `simulated`: a trainer that draws its feedback from a strategy.

pub(crate) mod belief;
pub(crate) mod ending;
pub(crate) mod information;
pub(crate) mod judged;
pub mod population;
pub(crate) mod simulated;
pub(crate) mod strategy;

pub use crate::memory::{BeliefTables, BeliefTablesRef};
pub use belief::{Belief, BeliefCount, BeliefError, BeliefRef};
pub use ending::{Ending, Hazard, Moment};
pub use information::{Words, binary_entropy};
pub use judged::Judged;
pub use simulated::SimulatedTrainer;
pub use strategy::{Feedback, LAGS, RESTS, Strategy, StrategyError, UnknownFeedback};
