//! A model as bytes, the same for firmware, browser, command line and C.
//!
//! [`Agent::save`](crate::Agent::save) writes all that the robot has learned. [`Agent::restore`](crate::Agent::restore) reads it back and
//! begins training on it: the restored robot then has the same parameters, to the last bit, as one that was never switched off. The file
//! holds the training data instead of the parameters, so learning continues as if it had never stopped.
//!
//! - `checking`: checks a file record by record;
//! - `restoring`, `saving`: read or write a model in parts;
//! - `contents`: a checked model file, to inspect without restoring it;
//! - `record`: the records of a file; `section`: those of one kind, in order;
//! - `joining`: joins the sessions of two robots; `starter`: sentences to begin with;
//! - `parameters`: the parameters alone, for a robot that only obeys;
//! - `error`: why a model could not be saved or restored.
//!
//! # The format
//!
//! The rest is for programs that read or write a model themselves, as the test `tests/tests/behaviour/format.rs` does by this description
//! alone. Bytes that are numbered are little-endian. The default learner of the command line and Python writes format 3, which also has
//! the tasks that its layer learns from; every other learner writes format 2. Format 1, without roles, is read too. Boards, C and the
//! page check all of format 3, but keep the role model alone, and save format 2.
//!
//! ```text
//! 0 to 7             67 6f 6f 64 62 6f 74 00: "goodbot" and a zero byte
//! 8, 9               the format, a u16: 2 or 3
//! 10 to 13           the length of the whole file in bytes, a u32
//! 14 to length - 5   the payload
//! the last 4         CRC-32 of everything before it, a u32 (reflected polynomial edb88320, start and final xor ffffffff:
//!                    the CRC of zip and PNG)
//! ```
//!
//! The payload is in the [wire format of postcard](https://postcard.jamesmunns.com/wire-format): a u16, a u32 and a count are varints
//! (seven bits a byte, lowest first, the top bit set on all bytes but the last); a u8 is one byte, a bool a byte 0 or 1, an f32 four
//! bytes. A text is its byte count, then UTF-8; a list its record count, then its records; a record its fields in order. The fields of
//! the payload:
//!
//! ```text
//! vocabulary    u32: a digest of the names of the domain's propositional functions and attributes; 0 if the language model was
//!               saved alone
//! sizes         13 u32, the capacities of the saved robot: strategies, words, word bytes, tokens, token bytes, commands,
//!               command tokens, sessions, sentence words, pairs, translations, alignments, length pairs
//! options       a count of bytes, and a record in them (below)
//! strategies    a list of trainer strategies: mu+, mu-, epsilon and the probability of the strategy, 4 f32
//! words         a list of texts: the English words, each once
//! tokens        a list of texts: the machine tokens, each once
//! commands      a list of machine commands, each a list of u16: positions in tokens; from 32,768 on, in a model of roles, the
//!               marker of a role (below)
//! sessions      a list of sessions, oldest first: a list of u16, positions in words, and a u32, the number of the session's pairs
//! pairs         a list of pairs, session by session: a u16, the position of the machine command, and an f32, its weight
//! heard again   a list of bool, one a session: whether its command is known to have been heard more than once
//! trainers      a list, one a strategy: the probabilities that a word is about the last action, the one before and the one before
//!               that, and the strategy's prior before the trainer was met, 4 f32
//! rests         a list, one a strategy: the probabilities of silence after a rest at the goal, of silence after a rest elsewhere,
//!               and of mistaking one for the other; the degree to which a move inside the goal counts as a rest there; 4 f32
//! ```
//!
//! Older files end before `heard again` (it is false for all), before `trainers` (no word is late, and the trainer is met now) or before
//! `rests` (they are mu+, mu-, epsilon and 0). Format 3 goes on:
//!
//! ```text
//! possible commands   a list of machine commands, as commands: the descriptions of all tasks
//! possible counts     a list of u32: the number of tasks of each session; 0 after the list's end
//! possible            a list of pairs, session by session: a u16, the position among the possible commands, and an f32, the
//!                     task's prior
//! ```
//!
//! The record of the options: smoothing (f32), alignment prior (f32), rounds of EM (u32), length factor (bool), belief weights (bool),
//! least weight (f32), significant letters of a word (u8, 0 for all), facts beside their proposition (bool), the role model instead of
//! Model 2 (bool), weights by evidence alone (bool), drift of the strategies (f32), the probability that a session ends after a move at
//! the goal and elsewhere (two f32), actions that tell more (bool), the same probability after a first and after a later rest at the goal
//! with its factors after praise and after blame (four f32), and those four elsewhere. In older files, fields from the letters on may be
//! missing: they are 0.
//!
//! The marker of a role comes before the values of the role's objects. It is the sum of 32,768, 2,048 times the kind of role (0 goal, 1
//! subject, 2 start, 3 other place, 4 other), 32 times the position of the proposition or the class, 8 times the argument, and the sort
//! of values: twice the attribute, plus one for the values of objects that are in the place.
//!
//! ## The kinds of task
//!
//! If a model has other kinds of task than the paper's two, a host writes this record after it. The model's length and CRC-32 do not
//! cover it. Controllers skip it, because their kinds are compiled in, but refuse other bytes after a model.
//!
//! ```text
//! 0 to 7             67 62 6b 69 6e 64 73 00: "gbkinds" and a zero byte
//! 8 to 11            the length of the record in bytes, a u32
//! 12 to length - 5   the kinds of task, each a text in UTF-8 and a line feed: agentInRoom(?a,?b) avoiding agentInRoom(?a,?c)
//! the last 4         CRC-32 of the record before it, as above
//! ```
//!
//! ## The parameters alone
//!
//! What [`Agent::save_parameters`](crate::Agent::save_parameters) writes for a robot that only obeys. Without `ways` in the library, a
//! file with a role of a way is refused.
//!
//! ```text
//! 0 to 7       67 62 70 61 72 61 6d 31: "gbparam1"
//! 8 to 11      the vocabulary, a u32, as above
//! 12 to 15     the number of sessions, an f32
//! 16 to 18     the number of significant letters of a word, of lifted tasks and of roles, 3 u8
//! 19 to 22     the number of words and of machine tokens, 2 u16
//! then         the lifted tasks, each a u16, the position of its token; the roles, each a u16, its marker with the sort 0
//! then         the words and the machine tokens, each its length, a u8, and its bytes in UTF-8
//! then         the tables translations and alignments (core/src/language/roles/layout.rs) up to the trellis, f32; none if there
//!              is no word
//! the last 4   CRC-32 of everything before it, as above
//! ```
//!
//! # What is refused
//!
//! A damaged or foreign file must not change the robot, so all of it is checked first. It is refused if
//!
//! - its first bytes, format, length or CRC-32 is wrong;
//! - a text is longer than 48 bytes or occurs twice, a machine command is longer than 60 tokens or a sentence longer than 64 words;
//! - a position is beyond its list, bytes are left over, or numbers of records disagree;
//! - a number is unusable for learning: a weight or a pseudo-count outside 0 to 1,000,000, the least weight outside 0 to less than 1, a
//!   probability or a number about rests outside 0 to 1, lags that do not sum to 1, all strategies' probabilities 0, more than 1,000
//!   rounds;
//! - its digest is not that of the robot's domain. [`Agent::restore_earlier`](crate::Agent::restore_earlier), and C, also take that of
//!   the domain's first propositions and attributes, because positions then mean the same, and derived facts move behind the attributes;
//! - it does not fit into the robot's memory: the error names the field of [`Capacities`](crate::Capacities) to raise, its size and the
//!   needed size.

#[cfg(feature = "learning")]
mod agent;
#[cfg(feature = "learning")]
mod checking;
#[cfg(feature = "learning")]
pub(crate) mod contents;
pub(crate) mod error;
#[cfg(feature = "learning")]
mod joining;
#[cfg(feature = "learning")]
mod language;
mod parameters;
#[cfg(feature = "layer")]
mod possible;
pub(crate) mod record;
#[cfg(feature = "learning")]
mod restoring;
#[cfg(feature = "learning")]
mod saving;
#[cfg(feature = "learning")]
mod section;
#[cfg(feature = "learning")]
mod starter;

#[cfg(feature = "learning")]
pub use contents::Contents;
pub use error::{Part, RestoreError, SaveError};
pub use parameters::PARAMETERS_MAGIC;
pub use record::{
    CommandRecord, KINDS_MAGIC, LAYERED_VERSION, PairRecord, RestsRecord, SAVED, SessionRecord, StrategyRecord, TrainerRecord, VERSION,
    most_bytes,
};
#[cfg(feature = "learning")]
pub use restoring::Restoring;
#[cfg(feature = "learning")]
pub use saving::Saving;
#[cfg(feature = "learning")]
pub use section::Section;
#[cfg(feature = "learning")]
pub use starter::{Places, is_beside};

/// Checks that the bytes are a model, or the parameters of one.
pub(crate) fn check(bytes: &[u8]) -> Result<(), RestoreError> {
    if cfg!(not(feature = "learning")) || bytes.starts_with(&PARAMETERS_MAGIC) {
        return parameters::check(bytes);
    }
    #[cfg(feature = "learning")]
    Contents::read(bytes)?;
    Ok(())
}
