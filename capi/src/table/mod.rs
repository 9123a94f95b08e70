//! Robots of the caller's own: classes, objects and propositions as data, and the effects of actions as a table of steps or a function.
//!
//! - [`description`]: the caller's description;
//! - [`domain`]: the robot as a domain of the core;
//! - [`init`]: from a description to a robot.

pub mod description;
pub mod domain;
pub mod init;

pub use domain::TableDomain;
pub(crate) use init::after_storage;
