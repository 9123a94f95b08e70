//! Input, output and messages that all of goodbot's commands share.
//!
//! | module | contents |
//! |---|---|
//! | [`typed`] | options that are typed: numbers, learners, trainers |
//! | [`load`] | files to read: homes, session logs, kinds of tasks, tables of words |
//! | [`whole_file`] | files read and written as a whole, and the right to write one, which one program has at a time |
//! | [`training_data`] | recorded sessions as training data, and models trained on them |
//! | [`starter`] | everyday sentences to begin with |
//! | [`migration`] | a model for the next version of a robot |
//! | [`restored`] | an agent or a language model from a model file |
//! | [`output`] | the files to write, and which of them are never replaced |
//! | [`printed`] | the one way of text to the terminal, and tables as comma-separated values |
//! | [`messages`] | remarks and progress on standard error |
//! | [`outcome`] | the exit code of a command, and the core's errors in the user's words |

#![forbid(unsafe_code)]
#![deny(missing_docs)]
#![deny(clippy::print_stdout, clippy::print_stderr)]

pub mod load;
pub mod messages;
pub mod migration;
pub mod outcome;
pub mod output;
pub mod printed;
pub mod restored;
pub mod starter;
pub mod training_data;
pub mod typed;
pub mod whole_file;

pub use load::input::{self, InputFile};
pub use load::kinds::TaskKinds;
pub use load::words::{ClosedWordOptions, SynonymOptions};
pub use messages::{bar, counted, counting, working};
pub use outcome::Failure;
pub use output::{Kind, Output};
pub use printed::Printed;
pub use starter::{Starter, StarterOptions};
pub use training_data::{Lesson, evidence, training};
pub use typed::{Believes, Learner, Limit, between, name_of};
pub use whole_file::read_model;
