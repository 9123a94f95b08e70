//! The sizes of the tables, and the memory that they need.

use crate::arena::{after, after_agent, after_home};
use crate::robot::{Goodbot, give, with};
use crate::status::GoodbotStatus;
#[cfg(feature = "table")]
use crate::table;
use crate::training::in_world;
use crate::world::{World, usage};
use goodbot::Capacities;
use goodbot::capacity::Capacity;
use goodbot::session::Lessons;
use goodbot::task::TaskSet;

/// The size of each table, one number for each `goodbot_capacity`. Begin with a preset and raise the sizes of full tables.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GoodbotCapacities {
    /// Entries of each table.
    pub entries: [u32; GOODBOT_CAPACITIES],
}

/// How many capacities there are.
pub const GOODBOT_CAPACITIES: usize = 25;

/// The tables, by their positions in `goodbot_capacities`.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GoodbotCapacity {
    /// Objects of one environment: agent, rooms, doors and blocks together. At most 255; a home takes 32.
    Objects,
    /// Distinct names and attribute values of one environment.
    Names,
    /// Bytes that the names and attribute values of one environment take together.
    NameBytes,
    /// Cells of a home that are not wall.
    Cells,
    /// Grounded tasks of one session. At most 64, one bit each in a task set.
    Tasks,
    /// Trainer strategies told apart at once.
    Strategies,
    /// Joint beliefs: tasks times strategies.
    Beliefs,
    /// Distinct machine commands that one session's tasks and constraints can express.
    Candidates,
    /// Machine tokens of all candidates together.
    CandidateTokens,
    /// Distinct ground propositions that one session's tasks are made of.
    GroundPropositions,
    /// Entries of the table that finds the tasks satisfied by a state: cells times movable pieces, the robot included.
    GoalEntries,
    /// States that one search can hold that expands them one by one, where actions cost 1 each and are at most 8.
    States,
    /// States that one search can hold if the state space is larger than `STATES`: visited states are then hashed. 0 turns it off.
    HashedStates,
    /// Distinct English words. At most 65,534.
    Words,
    /// Bytes that those words take together.
    WordBytes,
    /// Distinct machine tokens. At most 65,534.
    Tokens,
    /// Bytes that those tokens take together.
    TokenBytes,
    /// Distinct machine commands in the training data.
    Commands,
    /// Machine tokens of those commands together.
    CommandTokens,
    /// Sessions learned from.
    Sessions,
    /// English words of those sessions' commands together.
    SentenceWords,
    /// Weighted pairs of an English command and a machine command in the training data.
    Pairs,
    /// Cells of the translation table: (machine tokens + 1) times English words.
    Translations,
    /// Cells of all alignment tables together: (l + 1) times n for each pair of lengths.
    Alignments,
    /// Distinct pairs of a machine command's and an English command's length.
    LengthPairs,
}

// The enum exists for the C header. Its order is that of the core's list.
const _: () = assert!(GOODBOT_CAPACITIES == Capacity::ALL.len() && GoodbotCapacity::LengthPairs as usize + 1 == GOODBOT_CAPACITIES);

/// The preset for homes on controllers.
pub const GOODBOT_SMALL: u32 = 0;
/// The preset for the smallest controllers.
pub const GOODBOT_TINY: u32 = 1;
/// The preset for a robot of the caller's own on a controller: 16 tasks, 5,888 states, and 24 lessons of 44 different words. It has no room
/// for a home.
pub const GOODBOT_OWN: u32 = 2;
/// The preset for hosts, about seven megabytes: `goodbot_size` and `goodbot_table_size` say how many exactly. With it, `goodbot_usage` and
/// `goodbot_least_capacities` find the capacities that a controller needs.
pub const GOODBOT_STANDARD: u32 = 3;

/// Bytes that the small preset takes where a pointer has four bytes.
pub const GOODBOT_SMALL_BYTES_32: usize = 21_920;
/// Bytes that the small preset takes where a pointer has eight bytes.
pub const GOODBOT_SMALL_BYTES_64: usize = 22_528;
/// Bytes that the tiny preset takes where a pointer has four bytes.
pub const GOODBOT_TINY_BYTES_32: usize = 13_600;
/// Bytes that the tiny preset takes where a pointer has eight bytes.
pub const GOODBOT_TINY_BYTES_64: usize = 14_144;
/// Bytes that the preset for a robot of one's own takes where a pointer has four bytes.
pub const GOODBOT_OWN_BYTES_32: usize = 28_320;
/// Bytes that the preset for a robot of one's own takes where a pointer has eight bytes.
pub const GOODBOT_OWN_BYTES_64: usize = 28_896;
/// Bytes that a robot of the caller's own takes beyond the small or the tiny preset.
pub const GOODBOT_TABLE_BYTES: usize = 1_344;

#[cfg(target_pointer_width = "32")]
const PROMISED: (usize, usize, usize) = (GOODBOT_SMALL_BYTES_32, GOODBOT_TINY_BYTES_32, GOODBOT_OWN_BYTES_32);
#[cfg(target_pointer_width = "64")]
const PROMISED: (usize, usize, usize) = (GOODBOT_SMALL_BYTES_64, GOODBOT_TINY_BYTES_64, GOODBOT_OWN_BYTES_64);

/// Whether the library is built for C. In one build with programs for hosts, task sets are as wide as theirs, and nothing calls it from C.
const FOR_C: bool = TaskSet::MOST == TaskSet::MOST_OF_ONE_WORD;

const _: () = assert!(!FOR_C || bytes(&Capacities::SMALL, false) <= PROMISED.0, "raise GOODBOT_SMALL_BYTES");
const _: () = assert!(!FOR_C || bytes(&Capacities::TINY, false) <= PROMISED.1, "raise GOODBOT_TINY_BYTES");
const _: () = assert!(!FOR_C || bytes(&Capacities::SMALL, true) <= PROMISED.0 + GOODBOT_TABLE_BYTES, "raise GOODBOT_TABLE_BYTES");
#[cfg(feature = "table")]
const _: () = assert!(!FOR_C || bytes(&Capacities::OWN, true) <= PROMISED.2, "raise GOODBOT_OWN_BYTES");

/// Bytes that a robot takes, in memory that is aligned to 8.
pub const fn bytes(capacities: &Capacities, table: bool) -> usize {
    let at = after_agent(after_home(after::<Goodbot>(0, 1), capacities), capacities);
    #[cfg(feature = "table")]
    let at = if table { table::after_storage(at) } else { at };
    #[cfg(not(feature = "table"))]
    let _ = table;
    match at.checked_next_multiple_of(8) {
        Some(bytes) => bytes,
        None => usize::MAX,
    }
}

/// Bytes that are enough for a robot with pointers of four bytes, computed on a machine that may have wider ones.
pub const fn bytes_32(capacities: &Capacities, table: bool) -> usize {
    // The tables hold no pointers. The padding between them depends on their lengths.
    const BETWEEN: usize = 16;
    let own = GOODBOT_SMALL_BYTES_32.saturating_sub(of_tables(&Capacities::SMALL));
    let own = if table { own.saturating_add(GOODBOT_TABLE_BYTES) } else { own };
    (of_tables(capacities).saturating_add(own).saturating_add(BETWEEN) / 8).saturating_mul(8)
}

/// Bytes of the tables on a controller, where a task set is one word.
const fn of_tables(capacities: &Capacities) -> usize {
    let sets = capacities.goal_entries.saturating_add(capacities.ground_propositions);
    let wider = size_of::<TaskSet>().saturating_sub(size_of::<u64>()).saturating_mul(sets);
    after_agent(after_home(0, capacities), capacities).saturating_sub(wider)
}

#[cfg(target_pointer_width = "32")]
const _: () = assert!(bytes(&Capacities::TINY, false) <= bytes_32(&Capacities::TINY, false));
#[cfg(target_pointer_width = "32")]
const _: () = assert!(bytes(&Capacities::STANDARD, true) <= bytes_32(&Capacities::STANDARD, true));

impl From<&Capacities> for GoodbotCapacities {
    fn from(from: &Capacities) -> Self {
        Self { entries: Capacity::ALL.map(|capacity| u32::try_from(from.get(capacity)).unwrap_or(u32::MAX)) }
    }
}

impl From<&GoodbotCapacities> for Capacities {
    fn from(from: &GoodbotCapacities) -> Self {
        let mut capacities = Self::NONE;
        for (capacity, entries) in Capacity::ALL.into_iter().zip(from.entries) {
            capacities.set(capacity, entries as usize);
        }
        capacities
    }
}

/// Fills in a preset: `GOODBOT_SMALL`, `GOODBOT_TINY`, `GOODBOT_OWN` or `GOODBOT_STANDARD`.
///
/// # Safety
/// `capacities` is null or points to memory for it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_preset(preset: u32, capacities: *mut GoodbotCapacities) -> GoodbotStatus {
    let chosen = match preset {
        GOODBOT_SMALL => Capacities::SMALL,
        GOODBOT_TINY => Capacities::TINY,
        GOODBOT_OWN => Capacities::OWN,
        GOODBOT_STANDARD => Capacities::STANDARD,
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

/// The lessons that a robot shall keep without forgetting any.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GoodbotLessons {
    /// How many sessions.
    pub sessions: u32,
    /// The most words of one command, at most 64.
    pub words_per_command: u32,
    /// How many different words the commands have together.
    pub different_words: u32,
    /// Bytes that those words take together.
    pub word_bytes: u32,
}

/// The least capacities with which a robot like this one, in its present world, takes such lessons and forgets none. Ask a robot with ample
/// memory, on a host: `FULL` if its own is too small for one session. A session under way ends unlearned.
///
/// With these `STATES`, every plan is exact. A home can do with fewer; its plans to far goals are then approximate. `HASHED_STATES` and
/// `GOAL_ENTRIES` are 0: no robot needs them; goal entries save time.
///
/// # Safety
/// `robot` is null or a handle, `lessons` null or points to lessons, `capacities` is null or points to memory for it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_least_capacities(
    robot: *mut Goodbot,
    lessons: *const GoodbotLessons,
    capacities: *mut GoodbotCapacities,
) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let Some(&GoodbotLessons { sessions, words_per_command, different_words, word_bytes }) = lessons.as_ref() else {
                return Err(GoodbotStatus::Null.into());
            };
            let [sessions, words, different_words, word_bytes] =
                [sessions, words_per_command, different_words, word_bytes].map(|it| it as usize);
            let lessons = Lessons { sessions, words, different_words, word_bytes };
            let Goodbot { agent, world, .. } = robot;
            let least = in_world!(&*world, |domain, _state| agent.least_capacities(domain, &lessons)?);
            give(capacities, (&least).into())
        })
    }
}

/// The capacities that the robot needed so far: with them, another robot has room for the same sessions. Give a robot with
/// `GOODBOT_STANDARD` its lessons on a host; these are then the capacities for the controller. `GOAL_ENTRIES` is 0: goal entries only save
/// time, in homes.
///
/// # Safety
/// `robot` is null or a handle, `capacities` null or points to memory for it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_usage(robot: *mut Goodbot, capacities: *mut GoodbotCapacities) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe {
        with(robot, |robot| {
            let used = match &robot.world {
                World::Here(domain, _) => robot.agent.needed(domain).at_least(usage(domain)),
                #[cfg(feature = "home")]
                World::Nothing(_) | World::Plan(_) | World::Changing => robot.agent.most_used(),
            };
            give(capacities, (&used).into())
        })
    }
}

/// How many sessions it has learned from and still keeps.
///
/// # Safety
/// `robot` is null or a handle, `count` null or room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn goodbot_session_count(robot: *mut Goodbot, count: *mut u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { with(robot, |robot| give(count, robot.agent.language().bitext().sessions() as u32)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::format;

    #[test]
    fn the_numbers_of_the_tables_are_the_cores() {
        let c: &[GoodbotCapacity] = &[
            GoodbotCapacity::Objects,
            GoodbotCapacity::Names,
            GoodbotCapacity::NameBytes,
            GoodbotCapacity::Cells,
            GoodbotCapacity::Tasks,
            GoodbotCapacity::Strategies,
            GoodbotCapacity::Beliefs,
            GoodbotCapacity::Candidates,
            GoodbotCapacity::CandidateTokens,
            GoodbotCapacity::GroundPropositions,
            GoodbotCapacity::GoalEntries,
            GoodbotCapacity::States,
            GoodbotCapacity::HashedStates,
            GoodbotCapacity::Words,
            GoodbotCapacity::WordBytes,
            GoodbotCapacity::Tokens,
            GoodbotCapacity::TokenBytes,
            GoodbotCapacity::Commands,
            GoodbotCapacity::CommandTokens,
            GoodbotCapacity::Sessions,
            GoodbotCapacity::SentenceWords,
            GoodbotCapacity::Pairs,
            GoodbotCapacity::Translations,
            GoodbotCapacity::Alignments,
            GoodbotCapacity::LengthPairs,
        ];
        for (number, (&mine, capacity)) in c.iter().zip(Capacity::ALL).enumerate() {
            assert_eq!((mine as usize, capacity as usize), (number, number));
            let name = format!("{mine:?}");
            let words = name.chars().flat_map(|letter| letter.is_uppercase().then_some('_').into_iter().chain(letter.to_lowercase()));
            assert_eq!(words.skip(1).collect::<std::string::String>(), capacity.name());
        }
        assert_eq!(c.len(), GOODBOT_CAPACITIES);
    }
}
