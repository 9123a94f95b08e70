//! Lessons for all shells: the command line, the page, Python and the laboratory.
//!
//! - [`fault`]: the faults of a file, with their places;
//! - [`first_words`]: commands with more words than a robot reads;
//! - [`closed_words`]: the tables of closed words;
//! - [`home`]: a home from an environment;
//! - [`name`]: a task as a text, for files, for people, and for models with other symbols;
//! - [`walk`]: the command, steps and answers of a session;
//! - [`checked`]: recorded sessions, checked, with the place of each fault;
//! - [`listening`]: when a robot listens, how it hears a recorded utterance, and a conversation as a log records it;
//! - [`replay`]: the replay of a recorded session;
//! - [`kept_kinds`]: the kinds of task that a model was trained for, in a record after the model;
//! - [`asking`]: when the robot asks: seldom, and nothing twice;
//! - [`place`]: the home or world of a lesson, and the log of a live session;
//! - [`live`]: a session under way: its steps, utterances, conversation, questions, corrections, and words said along with the feedback buttons;
//! - [`starter`]: everyday sentences for a robot to begin with;
//! - [`world`]: a world from a file, and the tasks that commands may mean in it.

#![deny(missing_docs)]

pub mod asking;
pub mod checked;
pub mod closed_words;
pub mod fault;
pub mod first_words;
pub mod home;
pub mod kept_kinds;
pub mod listening;
pub mod live;
pub mod name;
pub mod place;
pub mod replay;
pub mod starter;
pub mod walk;
pub mod world;

pub use fault::Fault;
