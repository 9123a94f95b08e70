//! How large the tables are, and what memory that takes.

use crate::arena::{after, after_tables};
use crate::robot::Goodbot;
use crate::status::GoodbotStatus;
use crate::table;
use goodbot::Capacities;

/// How large each table is. Begin with a preset and raise what is full.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GoodbotCapacities {
    /// Objects of one environment: agent, rooms, doors and blocks together. At most 255.
    pub objects: u32,
    /// Distinct names and attribute values of one environment.
    pub names: u32,
    /// Bytes that the names and attribute values of one environment take together.
    pub name_bytes: u32,
    /// Cells of a home that are not wall.
    pub cells: u32,
    /// Grounded tasks of one session. At most 64, one bit each in a task set.
    pub tasks: u32,
    /// Trainer strategies told apart at once. At most 8.
    pub strategies: u32,
    /// Joint beliefs: tasks times strategies.
    pub beliefs: u32,
    /// Distinct machine commands that one session's tasks and constraints can express.
    pub candidates: u32,
    /// Machine tokens of all candidates together.
    pub candidate_tokens: u32,
    /// Distinct ground propositions that one session's tasks are made of.
    pub ground_propositions: u32,
    /// Entries of the table that finds the tasks satisfied by a state: the values of all state variables together.
    pub goal_entries: u32,
    /// States that one search can hold, where actions cost 1 each.
    pub states: u32,
    /// States that one search can hold where the state space is larger than `states` and visited states are hashed. 0 turns it off.
    pub hashed_states: u32,
    /// Distinct English words. At most 65,534.
    pub words: u32,
    /// Bytes that those words take together.
    pub word_bytes: u32,
    /// Distinct machine tokens. At most 65,534.
    pub tokens: u32,
    /// Bytes that those tokens take together.
    pub token_bytes: u32,
    /// Distinct machine commands in the training data.
    pub commands: u32,
    /// Machine tokens of those commands together.
    pub command_tokens: u32,
    /// Sessions learned from.
    pub sessions: u32,
    /// English words of those sessions' commands together.
    pub sentence_words: u32,
    /// Weighted pairs of an English command and a machine command in the training data.
    pub pairs: u32,
    /// Cells of the translation table: (machine tokens + 1) times English words.
    pub translations: u32,
    /// Cells of all alignment tables together: (l + 1) times n for each pair of lengths.
    pub alignments: u32,
    /// Distinct pairs of a machine command's and an English command's length.
    pub length_pairs: u32,
}

/// The preset for controllers.
pub const GOODBOT_SMALL: u32 = 0;
/// The preset for the smallest controllers.
pub const GOODBOT_TINY: u32 = 1;

/// Bytes that the small preset takes where a pointer has four bytes.
pub const GOODBOT_SMALL_BYTES_32: usize = 20_480;
/// Bytes that the small preset takes where a pointer has eight bytes.
pub const GOODBOT_SMALL_BYTES_64: usize = 20_992;
/// Bytes that the tiny preset takes where a pointer has four bytes.
pub const GOODBOT_TINY_BYTES_32: usize = 12_288;
/// Bytes that the tiny preset takes where a pointer has eight bytes.
pub const GOODBOT_TINY_BYTES_64: usize = 12_800;
/// Bytes that a robot of the caller's own takes beyond that.
pub const GOODBOT_TABLE_BYTES: usize = 1_344;

#[cfg(target_pointer_width = "32")]
const PROMISED: (usize, usize) = (GOODBOT_SMALL_BYTES_32, GOODBOT_TINY_BYTES_32);
#[cfg(target_pointer_width = "64")]
const PROMISED: (usize, usize) = (GOODBOT_SMALL_BYTES_64, GOODBOT_TINY_BYTES_64);

const _: () = assert!(bytes(&Capacities::SMALL, false) <= PROMISED.0, "raise GOODBOT_SMALL_BYTES");
const _: () = assert!(bytes(&Capacities::TINY, false) <= PROMISED.1, "raise GOODBOT_TINY_BYTES");
const _: () = assert!(bytes(&Capacities::SMALL, true) <= PROMISED.0 + GOODBOT_TABLE_BYTES, "raise GOODBOT_TABLE_BYTES");

/// Bytes that a robot takes, in memory that is aligned to 8.
pub const fn bytes(capacities: &Capacities, table: bool) -> usize {
    let at = after_tables(after::<Goodbot>(0, 1), capacities);
    let at = if table { table::after_storage(at) } else { at };
    match at.checked_next_multiple_of(8) {
        Some(bytes) => bytes,
        None => usize::MAX,
    }
}

/// The fields that both have, by name.
macro_rules! same_fields {
    ($($field:ident,)*) => {
        impl From<&Capacities> for GoodbotCapacities {
            fn from(from: &Capacities) -> Self {
                Self { $($field: from.$field as u32,)* }
            }
        }

        impl From<&GoodbotCapacities> for Capacities {
            fn from(from: &GoodbotCapacities) -> Self {
                Self { $($field: from.$field as usize,)* }
            }
        }
    };
}
same_fields! {
    objects, names, name_bytes, cells, tasks, strategies, beliefs, candidates, candidate_tokens, ground_propositions, goal_entries,
    states, hashed_states, words, word_bytes, tokens, token_bytes, commands, command_tokens, sessions, sentence_words, pairs,
    translations, alignments, length_pairs,
}

/// Fills in a preset, `GOODBOT_SMALL` or `GOODBOT_TINY`.
///
/// # Safety
/// `capacities` is null or points to memory for it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_preset(preset: u32, capacities: *mut GoodbotCapacities) -> GoodbotStatus {
    let chosen = match preset {
        GOODBOT_SMALL => Capacities::SMALL,
        GOODBOT_TINY => Capacities::TINY,
        _ => return GoodbotStatus::Number,
    };
    if capacities.is_null() {
        return GoodbotStatus::Null;
    }
    // SAFETY: the caller's promise.
    unsafe { capacities.write((&chosen).into()) };
    GoodbotStatus::Ok
}

/// Bytes that a robot in a home takes with these capacities; 0 for null.
///
/// # Safety
/// `capacities` is null or points to capacities.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_size(capacities: *const GoodbotCapacities) -> usize {
    // SAFETY: the caller's promise.
    unsafe { capacities.as_ref() }.map_or(0, |capacities| bytes(&capacities.into(), false))
}

/// Bytes that a robot of the caller's own takes with these capacities; 0 for null.
///
/// # Safety
/// `capacities` is null or points to capacities.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_table_size(capacities: *const GoodbotCapacities) -> usize {
    // SAFETY: the caller's promise.
    unsafe { capacities.as_ref() }.map_or(0, |capacities| bytes(&capacities.into(), true))
}
