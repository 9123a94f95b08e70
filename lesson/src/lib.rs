//! Lessons for all shells: the command line, the page, Python and the laboratory.
//!
//! - [`fault`]: the faults of a file, with their places;
//! - [`first_words`]: commands with more words than a robot reads;
//! - [`home`]: a home from an environment;
//! - [`name`]: a grounded task as a text, for files and for people;
//! - [`checked`]: recorded sessions, checked, with the place of each fault;
//! - [`walk`]: the command, steps and answers of a session;
//! - [`replay`]: the replay of a recorded session;
//! - [`machine_command`]: machine commands as texts;
//! - [`kept_kinds`]: the kinds of task that a model was trained for, in a record after the model;
//! - [`live`]: a session under way;
//! - [`listening`]: the utterances of a person, and how they begin sessions;
//! - [`conversing`]: what "it", "there" and "back" refer to, from one session to the next;
//! - [`voice`]: praise, blame, answers and corrections in words;
//! - [`asking`]: when the robot asks in a live session;
//! - [`place`]: the home or world of a lesson;
//! - [`recording`]: the log of a live session;
//! - [`starter`]: everyday sentences for a robot to begin with;
//! - [`world`]: a world from a file, and the tasks that commands may mean in it.

#![deny(missing_docs)]

pub mod asking;
pub mod checked;
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
