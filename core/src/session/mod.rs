//! The training session (paper, Algorithm 1): from a command to tasks, actions, feedback, and a language model that has learned.
//!
//! - [`candidates`]: the machine commands that this session's tasks can be expressed by, and how well each explains the command;
//! - [`agent`]: the robot's mind: plans, decides, takes feedback;
//! - `hearing`: how it hears a command;
//! - [`learning`]: what it does when the session ends;
//! - [`least`]: the least capacities for a domain and a number of lessons;
//! - [`options`], [`error`]: how it learns, and why it may refuse.

pub mod agent;
pub mod candidates;
pub mod error;
mod hearing;
pub mod learning;
pub mod least;
pub mod options;

pub use agent::{Agent, Decision, Evidence};
pub use candidates::{Candidate, CandidateTables, CandidateTablesRef, CandidatesRef};
pub use error::AgentError;
pub use learning::{Finished, GaveWay};
pub use least::Lessons;
pub use options::{Options, SessionTables, SessionTablesRef, Weights};
