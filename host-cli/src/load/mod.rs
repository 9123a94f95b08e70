//! From files to what the robot works with: homes, tasks and walks, checked.
//!
//! - [`fault`]: what is wrong with a file, and where;
//! - [`input`]: files and standard input;
//! - [`content`]: what a file is;
//! - [`home`]: a home from an environment;
//! - [`kinds`]: the kinds of tasks that commands may mean;
//! - [`session`]: a recorded session, walked through;
//! - [`synonyms`]: tables of words that mean the same;
//! - [`task_name`]: a grounded task as a text.

pub mod content;
pub mod fault;
pub mod home;
pub mod input;
pub mod kinds;
pub mod session;
pub mod synonyms;
pub mod task_name;

pub use fault::Fault;
