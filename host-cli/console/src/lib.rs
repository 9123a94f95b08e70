//! Input, output and messages that all of goodbot's commands share.
//!
//! | module | contents |
//! |---|---|
//! | [`numbers`], [`learner`], [`believes`] | options that are typed |
//! | [`load`] | files to read: homes, session logs, kinds of tasks, synonyms |
//! | [`whole_file`] | files read and written as a whole |
//! | [`training_data`] | recorded sessions as training data, and models trained on them |
//! | [`starter`] | everyday sentences to begin with |
//! | [`migration`] | a model for the next version of a robot |
//! | [`restored`] | an agent or a language model from a model file |
//! | [`output`] | the files to write, and which of them are never replaced |
//! | [`claim`] | the right to write a file, which one program has at a time |
//! | [`csv`] | tables as comma-separated values |
//! | [`printed`] | the one way of text to the terminal |
//! | [`messages`] | remarks and progress on standard error |
//! | [`refusal`] | the core's errors in the user's words |
//! | [`outcome`] | the exit code of a command |

#![forbid(unsafe_code)]
#![deny(missing_docs)]
#![deny(clippy::print_stdout, clippy::print_stderr)]

pub mod believes;
pub mod claim;
pub mod csv;
pub mod learner;
pub mod load;
pub mod messages;
pub mod migration;
pub mod numbers;
pub mod outcome;
pub mod output;
pub mod printed;
pub mod refusal;
pub mod restored;
pub mod starter;
pub mod training_data;
pub mod whole_file;
