//! Lessons for all shells: the command line, the page, Python and the laboratory.
//!
//! - [`fault`]: the faults of a file, with their places;
//! - [`first_words`]: commands with more words than a robot reads;
//! - [`closed_words`]: the tables of closed words;
//! - [`home`]: a home from an environment;
//! - [`name`]: a grounded task as a text, for files and for people;
//! - [`conversing`]: a conversation as a log records it;
//! - [`walk`]: the command, steps and answers of a session;
//! - [`checked`]: recorded sessions, checked, with the place of each fault;
//! - [`listening`]: when a robot listens, and how it hears a recorded utterance;
//! - [`replay`]: the replay of a recorded session;
//! - [`machine_command`]: machine commands as texts;
//! - [`kept_kinds`]: the kinds of task that a model was trained for, in a record after the model;
//! - [`asking`]: when the robot asks: seldom, and nothing twice;
//! - [`voice`]: words said along with the feedback buttons;
//! - [`place`]: the home or world of a lesson;
//! - [`live`]: a session under way: its steps, utterances, conversation, questions and corrections;
//! - [`recording`]: the log of a live session;
//! - [`starter`]: everyday sentences for a robot to begin with;
//! - [`world`]: a world from a file, and the tasks that commands may mean in it.

#![deny(missing_docs)]

pub mod asking;
pub mod checked;
pub mod closed_words;
pub mod conversing;
pub mod fault;
pub mod first_words;
pub mod home;
pub mod kept_kinds;
pub mod listening;
pub mod live;
pub mod machine_command;
pub mod name;
pub mod place;
pub mod recording;
pub mod replay;
pub mod starter;
pub mod voice;
pub mod walk;
pub mod world;

pub use fault::Fault;
