//! Every capacity, in one place.
//!
//! The core allocates nothing: each table is in memory that the caller owns, and a [`Capacities`] defines the size of each one. There are
//! four presets: [`Capacities::TINY`] and [`Capacities::SMALL`] for homes on controllers, [`Capacities::OWN`] for other robots there, and
//! [`Capacities::STANDARD`] for hosts and browsers. Change single fields of a preset for other needs:
//!
//! ```
//! use goodbot::Capacities;
//! goodbot::memory! {
//!     /// Room for a robot that hears many different words.
//!     struct WordyMemory = Capacities { words: 96, word_bytes: 640, translations: 4_000, ..Capacities::SMALL };
//! }
//! assert_eq!(WordyMemory::CAPACITIES.words, 96);
//! ```
//!
//! A full table is reported by a [`CapacityError`], which names the field to raise.

mod error;
pub(crate) mod list;

pub use error::CapacityError;
pub(crate) use list::Capacities;
pub use list::{Capacity, UnknownCapacity};

/// Words of one English command; more are refused with [`Capacity::WordsPerCommand`].
pub const WORDS_PER_COMMAND: usize = 64;
/// Machine tokens of one machine command.
pub const TOKENS_PER_COMMAND: usize = 60;
/// Bytes of one word, name or machine token.
pub const NAME_BYTES: usize = 48;
/// Arguments of one propositional function.
pub const ARGUMENTS: usize = 3;
/// Attributes that a domain's objects can carry.
pub const ATTRIBUTES: usize = 4;
/// Propositions of one task's conjunction.
pub const PROPOSITIONS_PER_TASK: usize = 4;
/// Variables of one lifted task.
pub const VARIABLES_PER_TASK: usize = 6;
/// Attribute propositions of the objects bound by one task, together.
pub const FACTS_PER_TASK: usize = 8;
/// Lifted tasks of one session.
pub const LIFTED_TASKS: usize = 8;
/// Movable blocks of one home: 8, and 24 with the feature `alloc`.
pub const BLOCKS: usize = if cfg!(feature = "alloc") { 24 } else { 8 };
/// Questions of one session; after these the robot acts, and asks no more.
pub const QUESTIONS_PER_SESSION: usize = 8;
