//! What a lesson is, once for all shells: the command line, the page, Python and the laboratory.
//!
//! - [`fault`]: what is wrong with a file, and where;
//! - `first_words`, with the feature `talk`: commands with more words than are read;
//! - [`home`]: a home from an environment;
//! - [`name`]: a grounded task as a text, for files and for people;
//! - [`checked`]: a recorded session, checked, with the place of each fault;
//! - [`walk`]: what happens in a session;
//! - [`replay`]: the replay of a recorded session;
//! - [`kept_kinds`]: the kinds of task that a model was learned for, in a record after the model;
//! - [`live`]: a session as it happens;
//! - `listening`, with the feature `talk`: what a person says to the robot, and how a session begins with it;
//! - `conversing`, with the feature `talk`: what "it", "there" and "back" refer to, from one session to the next;
//! - `voice`, with the feature `talk`: praise, blame, answers and corrections in words;
//! - `asking`, with the feature `talk`: when the robot asks in it;
//! - [`place`]: where a session takes place;
//! - [`recording`]: a live session as a log has it;
//! - [`world`]: a world from a file, and what commands may mean in it.

#![deny(missing_docs)]

#[cfg(feature = "talk")]
pub mod asking;
pub mod checked;
#[cfg(feature = "talk")]
pub mod conversing;
pub mod fault;
#[cfg(feature = "talk")]
pub mod first_words;
pub mod home;
pub mod kept_kinds;
#[cfg(feature = "talk")]
pub mod listening;
pub mod live;
pub mod name;
pub mod place;
pub mod recording;
pub mod replay;
#[cfg(feature = "talk")]
pub mod voice;
pub mod walk;
pub mod world;

pub use fault::Fault;
