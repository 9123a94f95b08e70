//! The training session (paper, Algorithm 1): from a command to tasks, actions, feedback, and a language model that has learned.
//!
//! - [`candidates`]: the machine commands that this session's tasks can be expressed by, and how well each explains the command;
//! - [`agent`]: the robot's mind: hears, plans, decides, takes feedback, learns.

pub mod agent;
pub mod candidates;

pub use agent::{Agent, AgentError, AgentMemory, Decision, Hearing, Options, SessionMemory, Weights};
pub use candidates::{Candidate, CandidateMemory, Candidates};
