//! The training session (paper, Algorithm 1): from a command to tasks, actions, feedback, and a language model that has learned.
//!
//! - `candidates`: the machine commands that this session's tasks can be expressed by, and how well each explains the command;
//! - `machine_commands`: those machine commands, by language model;
//! - `agent`: the robot's mind: plans, decides, takes feedback;
//! - `phase`: its phase, and the call that leads on;
//! - `done`: the last actions, which feedback may be about;
//! - `hearing`: how it hears a command;
//! - `hypotheses`: how it hears one from a speech recogniser's transcripts;
//! - `learning`: how it ends a session and learns;
//! - `least`: the least capacities for a domain and a number of lessons;
//! - `ways`: how far the ways of its tasks have come;
//! - `options`, `error`: how it learns, and why it may refuse.

pub(crate) mod agent;
pub(crate) mod candidates;
mod done;
pub(crate) mod error;
mod hearing;
mod hypotheses;
pub(crate) mod learning;
pub(crate) mod least;
mod machine_commands;
pub(crate) mod options;
pub(crate) mod phase;
mod ways;

pub use agent::{Agent, Decision, Evidence, NEGLIGIBLE};
pub use candidates::{Candidate, CandidatesRef};
pub use error::AgentError;
pub use hypotheses::Hypothesis;
pub use learning::{Finished, GaveWay};
pub use least::Lessons;
pub use options::{Options, Weights};
pub use phase::Phase;
