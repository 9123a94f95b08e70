//! The training session (paper, Algorithm 1): from a command to tasks, actions, feedback, and a language model that has learned.
//!
//! - `candidates`: the machine commands that can express this session's tasks, and how well each explains the command;
//! - `machine_commands`: how these machine commands are made for each language model;
//! - `agent`: the robot's mind: plans, decides, takes feedback;
//! - `phase`: the agent's phase, and the call that comes next;
//! - `done`: the last actions, which feedback may be about;
//! - `hearing`: how the agent hears a command;
//! - `hypotheses`: how it chooses among a speech recogniser's transcripts;
//! - `learning`: how it ends a session and learns; `gave_way`: the older sessions that gave way;
//! - `least`: the least capacities for a domain and a number of lessons;
//! - `ways`: the progress of each task's way;
//! - `options`, `error`: the options, and the reasons to refuse a call.

pub(crate) mod agent;
pub(crate) mod candidates;
mod done;
pub(crate) mod error;
mod gave_way;
mod hearing;
mod hypotheses;
pub(crate) mod learning;
pub(crate) mod least;
mod machine_commands;
pub(crate) mod options;
pub(crate) mod phase;
mod ways;

pub(crate) use agent::Agent;
pub use agent::{Decision, Evidence};
pub use candidates::{Candidate, CandidatesRef};
#[cfg(feature = "asking")]
pub(crate) use error::AgentError;
pub use gave_way::GaveWay;
pub use hypotheses::Hypothesis;
pub use learning::Finished;
pub use least::Lessons;
pub(crate) use options::Options;
pub use options::Weights;
pub use phase::Phase;
