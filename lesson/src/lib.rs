//! What a lesson is, once for all shells: the command line, the page, Python and the laboratory.
//!
//! - [`fault`]: what is wrong with a file, and where;
//! - [`first_words`]: commands with more words than are read;
//! - [`home`]: a home from an environment;
//! - [`name`]: a grounded task as a text, for files and for people;
//! - [`checked`]: a recorded session, checked, with the place of each fault;
//! - [`walk`]: what happens in a session;
//! - [`replay`]: the replay of a recorded session;
//! - [`kept_kinds`]: the kinds of task that a model was learned for, in a record after the model;
//! - [`live`]: a session as it happens;
//! - [`listening`]: what a person says to the robot, and how a session begins with it;
//! - [`conversing`]: what "it", "there" and "back" refer to, from one session to the next;
//! - [`voice`]: praise, blame, answers and corrections in words;
//! - [`asking`]: when the robot asks in it;
//! - [`place`]: where a session takes place;
//! - [`recording`]: a live session as a log has it;
//! - [`world`]: a world from a file, and what commands may mean in it.

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
pub mod name;
pub mod place;
pub mod recording;
pub mod replay;
pub mod voice;
pub mod walk;
pub mod world;

pub use fault::Fault;
