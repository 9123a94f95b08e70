//! The memory that a robot takes, and the capacities that its lessons need.

use crate::arena::{after, after_agent, after_home, after_values};
use crate::capacities::GoodbotCapacities;
use crate::robot::{Goodbot, Robot, give, look, with};
use crate::status::GoodbotStatus;
#[cfg(feature = "table")]
use crate::table;
use crate::world::{World, in_world, usage};
use goodbot::Capacities;
use goodbot::oomdp::ActionSet;
use goodbot::session::Lessons;
use goodbot::task::{GroundedTask, TaskSet};

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
/// The most bytes of the small preset's model: a buffer for it. A slot of a flash takes `GOODBOT_FLASH_UNIT` more.
pub const GOODBOT_SMALL_MODEL_BYTES: usize = 3_830;
/// The most bytes of the tiny preset's model.
pub const GOODBOT_TINY_MODEL_BYTES: usize = 2_752;
/// The most bytes of the model of the preset for a robot of one's own.
pub const GOODBOT_OWN_MODEL_BYTES: usize = 5_778;

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

#[cfg(feature = "learning")]
const _: () = {
    use goodbot::snapshot::most_bytes;
    assert!(most_bytes(&Capacities::SMALL) == GOODBOT_SMALL_MODEL_BYTES, "change GOODBOT_SMALL_MODEL_BYTES");
    assert!(most_bytes(&Capacities::TINY) == GOODBOT_TINY_MODEL_BYTES, "change GOODBOT_TINY_MODEL_BYTES");
    assert!(most_bytes(&Capacities::OWN) == GOODBOT_OWN_MODEL_BYTES, "change GOODBOT_OWN_MODEL_BYTES");
};

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

/// Bytes of the tables on a controller, where a task set is one word, and a set of actions is two bytes.
const fn of_tables(capacities: &Capacities) -> usize {
    let sets = capacities.goal_entries.saturating_add(capacities.ground_propositions);
    let wider = size_of::<TaskSet>().saturating_sub(size_of::<u64>()).saturating_mul(sets);
    let wider = wider.saturating_add(of_tasks(capacities, size_of::<ActionSet>()).saturating_sub(of_tasks(capacities, size_of::<u16>())));
    after_agent(after_home(0, capacities), capacities).saturating_sub(wider)
}

/// Bytes of the tables between the hashed states and the workspace: a set of actions for each task, its distance, and the task itself.
const fn of_tasks(capacities: &Capacities, set: usize) -> usize {
    let at = after_values(0, set, align_of::<u16>(), capacities.tasks);
    let at = after::<GroundedTask>(after::<u32>(at, capacities.tasks), capacities.tasks);
    after::<u64>(at, 0)
}

#[cfg(target_pointer_width = "32")]
const _: () = assert!(bytes(&Capacities::TINY, false) <= bytes_32(&Capacities::TINY, false));
#[cfg(target_pointer_width = "32")]
const _: () = assert!(bytes(&Capacities::STANDARD, true) <= bytes_32(&Capacities::STANDARD, true));

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
            let Robot { agent, world, .. } = robot;
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
pub unsafe extern "C" fn goodbot_session_count(robot: *const Goodbot, count: *mut u32) -> GoodbotStatus {
    // SAFETY: the caller's promise.
    unsafe { look(robot, |robot| give(count, robot.agent.language().bitext().sessions() as u32)) }
}
