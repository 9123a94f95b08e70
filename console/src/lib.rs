//! What goodbot's commands read, write and say, everyday commands and laboratory alike.
//!
//! | module | what it holds |
//! |---|---|
//! | [`numbers`], [`learner`], [`believes`] | what is typed |
//! | [`load`] | files that a command reads: homes, session logs, kinds of tasks, synonyms |
//! | [`whole_file`] | files read and written as a whole |
//! | [`training_data`] | recorded sessions as training data, and models trained on them |
//! | [`output`] | where results go, and which files are never replaced |
//! | [`messages`] | remarks and progress on standard error |
//! | [`refusal`] | the core's errors in the words of who uses the program |
//! | [`outcome`] | how a command ends: its exit code |

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod believes;
pub mod learner;
pub mod load;
pub mod messages;
pub mod numbers;
pub mod outcome;
pub mod output;
pub mod refusal;
pub mod starter;
pub mod training_data;
pub mod whole_file;
