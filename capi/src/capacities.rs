//! The sizes of the tables.

use crate::status::GoodbotStatus;
use goodbot::Capacities;
use goodbot::capacity::Capacity;

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
/// The preset for the smallest controllers. Its robot expects one strategy only, a trainer who uses both words. For one button take
/// `goodbot_trainer(robot, 0.05f, 0.7f, 0.1f)` if it praises and `goodbot_trainer(robot, 0.7f, 0.05f, 0.1f)` if it blames, and tell silence;
/// or raise `STRATEGIES` to 3 and `BELIEFS` to 3 times `TASKS`, and the robot finds out which.
pub const GOODBOT_TINY: u32 = 1;
/// The preset for a robot of the caller's own on a controller: 16 tasks, 5,888 states, and 24 lessons of 44 different words. It has no room
/// for a home.
pub const GOODBOT_OWN: u32 = 2;
/// The preset for hosts, about seven megabytes: `goodbot_size` and `goodbot_table_size` say how many exactly. With it, `goodbot_usage` and
/// `goodbot_least_capacities` find the capacities that a controller needs.
pub const GOODBOT_STANDARD: u32 = 3;

impl From<&Capacities> for GoodbotCapacities {
    fn from(from: &Capacities) -> Self {
        Self { entries: Capacity::ALL.map(|capacity| u32::try_from(from.get(capacity)).unwrap_or(u32::MAX)) }
    }
}

impl From<&GoodbotCapacities> for Capacities {
    fn from(from: &GoodbotCapacities) -> Self {
        Self::of(|capacity| from.entries.get(capacity as usize).map_or(0, |&entries| entries as usize))
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
