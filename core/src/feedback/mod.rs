//! Trainer feedback (paper, section 3; SABL): reward, punishment and silence as evidence about the intended task.
//!
//! - `strategy`: the probabilities of a trainer's reward, punishment and silence, and of their lag;
//! - `judged`: the kind of an action for a task;
//! - `ending`: the end of a session as evidence;
//! - `belief`: the joint belief over tasks and trainer strategies, and its update by evidence;
//! - `information`: the expected information of a word, in bits;
//! - [`population`]: the strategies of real people.

pub(crate) mod belief;
pub(crate) mod ending;
pub(crate) mod information;
pub(crate) mod judged;
pub mod population;
pub(crate) mod strategy;

pub use crate::memory::{BeliefTables, BeliefTablesRef};
pub use belief::{Belief, BeliefCount, BeliefError, BeliefRef};
pub use ending::{Ending, Hazard, Moment};
pub use information::{Words, binary_entropy};
pub use judged::Judged;
pub use strategy::{Feedback, LAGS, RESTS, Strategy, StrategyError, UnknownFeedback};
