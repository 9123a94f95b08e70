//! Robots of the caller's own: classes, objects and propositions as data, and what actions do as a table of steps or a function.
//!
//! - [`description`]: what the caller hands in;
//! - [`domain`]: the same as the core sees it;
//! - [`init`]: the one from the other.

pub mod description;
pub mod domain;
pub mod init;

pub use domain::TableDomain;
pub(crate) use init::after_storage;
