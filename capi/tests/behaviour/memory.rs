//! The caller's memory: its size, its alignment, and null.

use crate::robots;

use goodbot::task::TaskSet;
use goodbot_capi::capacities::*;
use goodbot_capi::home::{goodbot_home_begin, goodbot_init_home};
use goodbot_capi::memory::*;
use goodbot_capi::robot::Goodbot;
use goodbot_capi::status::GoodbotStatus;
use goodbot_capi::table::description::GoodbotTable;
use goodbot_capi::training::{goodbot_acted, goodbot_decide, goodbot_forget, goodbot_hear};
use robots::{Lift, at_home, describe, hear_and_plan, in_homes, of_table, small};
use std::ffi::c_void;
use std::ptr::{null, null_mut};

fn make(memory: *mut u8, bytes: usize, capacities: *const GoodbotCapacities) -> GoodbotStatus {
    let mut robot: *mut Goodbot = null_mut();
    unsafe { goodbot_init_home(memory.cast(), bytes, capacities, &raw mut robot) }
}

#[test]
fn the_size_that_is_asked_for_is_enough_and_a_word_less_is_not() {
    let mut owned = in_homes(small());
    let (memory, bytes) = (owned.memory.as_mut_ptr().cast::<u8>(), owned.bytes);
    // The size is rounded up to a multiple of 8: up to seven bytes of it are spare.
    assert_eq!(make(memory, bytes - 8, &raw const owned.capacities), GoodbotStatus::Memory);
    assert_eq!(make(memory, 0, &raw const owned.capacities), GoodbotStatus::Memory);
    assert_eq!(make(memory, bytes, &raw const owned.capacities), GoodbotStatus::Ok);
}

#[test]
fn memory_that_is_not_aligned_to_eight_is_refused() {
    let mut owned = in_homes(small());
    let memory = owned.memory.as_mut_ptr().cast::<u8>();
    for shift in [1, 2, 4] {
        assert_eq!(make(memory.wrapping_add(shift), owned.bytes - shift, &raw const owned.capacities), GoodbotStatus::Alignment);
    }
}

#[test]
fn null_is_answered_and_never_followed() {
    let mut owned = in_homes(small());
    let memory = owned.memory.as_mut_ptr().cast::<u8>();
    assert_eq!(make(null_mut(), owned.bytes, &raw const owned.capacities), GoodbotStatus::Null);
    assert_eq!(make(memory, owned.bytes, null()), GoodbotStatus::Null);
    let nowhere = unsafe { goodbot_init_home(memory.cast(), owned.bytes, &raw const owned.capacities, null_mut()) };
    assert_eq!(nowhere, GoodbotStatus::Null);
    assert_eq!(unsafe { goodbot_size(null()) }, 0);
    assert_eq!(unsafe { goodbot_table_size(null()) }, 0);
    assert_eq!(unsafe { goodbot_preset(GOODBOT_TINY, null_mut()) }, GoodbotStatus::Null);
    let mut capacities = small();
    assert_eq!(unsafe { goodbot_preset(4, &raw mut capacities) }, GoodbotStatus::Number);
}

#[test]
fn capacities_without_end_ask_for_more_memory_than_there_is() {
    let mut capacities = small();
    capacities.entries[GoodbotCapacity::Translations as usize] = u32::MAX;
    capacities.entries[GoodbotCapacity::HashedStates as usize] = u32::MAX;
    let wanted = unsafe { goodbot_size(&raw const capacities) };
    assert!(wanted > 40_000_000_000);
    let mut memory = vec![0_u64; 4_096];
    assert_eq!(make(memory.as_mut_ptr().cast(), 32_768, &raw const capacities), GoodbotStatus::Memory);
}

#[test]
fn the_sizes_known_when_a_program_is_compiled_are_enough() {
    let mut capacities = small();
    for (preset, in_home) in [(GOODBOT_SMALL, GOODBOT_SMALL_BYTES_64), (GOODBOT_TINY, GOODBOT_TINY_BYTES_64)] {
        assert_eq!(unsafe { goodbot_preset(preset, &raw mut capacities) }, GoodbotStatus::Ok);
        // In one build with programs for hosts, task sets are as wide as theirs.
        if cfg!(target_pointer_width = "64") && TaskSet::MOST == TaskSet::MOST_OF_ONE_WORD {
            assert!(unsafe { goodbot_size(&raw const capacities) } <= in_home);
            assert!(unsafe { goodbot_table_size(&raw const capacities) } <= in_home + GOODBOT_TABLE_BYTES);
        }
    }
}

#[test]
fn capacities_of_nothing_make_a_robot_that_says_what_to_raise() {
    let mut capacities = small();
    capacities.entries[GoodbotCapacity::Objects as usize] = 0;
    let owned = in_homes(capacities);
    unsafe {
        assert_eq!(goodbot_home_begin(owned.robot), GoodbotStatus::Ok);
        let room = goodbot_capi::home::goodbot_home_room(owned.robot, c"room0".as_ptr(), 0, 0, 8, 4, c"red".as_ptr());
        assert_eq!(room, GoodbotStatus::Full);
        let (mut name, mut limit, mut given) = ([0; 16], 9, 9);
        let full = goodbot_capi::robot::goodbot_full(owned.robot, name.as_mut_ptr(), 16, &raw mut limit, &raw mut given);
        assert_eq!((full, limit, given), (GoodbotStatus::Ok, 0, 1));
        assert_eq!(std::ffi::CStr::from_ptr(name.as_ptr()), c"objects");
    }
}

#[test]
fn a_handle_whose_memory_was_written_over_is_refused() {
    let mut owned = at_home();
    hear_and_plan(owned.robot, c"go to the green room");
    owned.memory.fill(u64::MAX);
    assert_eq!(unsafe { goodbot_home_begin(owned.robot) }, GoodbotStatus::BadHandle);
    let crooked = owned.robot.cast::<u8>().wrapping_add(1).cast::<Goodbot>();
    assert_eq!(unsafe { goodbot_home_begin(crooked) }, GoodbotStatus::BadHandle);
}

#[test]
fn a_handle_whose_memory_was_copied_elsewhere_is_refused_there() {
    let owned = at_home();
    let mut copy = owned.memory.clone();
    let moved: *mut Goodbot = copy.as_mut_ptr().cast();
    assert_eq!(unsafe { goodbot_hear(moved, c"go to the green room".as_ptr()) }, GoodbotStatus::BadHandle);
    let mut count = 7;
    assert_eq!(unsafe { goodbot_session_count(moved, &raw mut count) }, GoodbotStatus::BadHandle);
    assert_eq!(count, 7);
    // The robot itself goes on.
    hear_and_plan(owned.robot, c"go to the green room");
}

#[test]
fn a_call_from_the_callers_own_function_is_told_that_the_robot_is_busy() {
    struct Caller {
        robot: *mut Goodbot,
        answers: Vec<GoodbotStatus>,
    }
    unsafe extern "C" fn step(context: *mut c_void, state: u32, action: u8, next: *mut u32) -> bool {
        let caller = unsafe { &mut *context.cast::<Caller>() };
        let mut count = 0;
        // While the robot is made there is no handle yet.
        if !caller.robot.is_null() {
            caller.answers.push(unsafe { goodbot_forget(caller.robot) });
            caller.answers.push(unsafe { goodbot_session_count(caller.robot, &raw mut count) });
        }
        unsafe { next.write(if action == 0 { (state + 1) % 3 } else { (state + 2) % 3 }) };
        true
    }
    let lift = Lift::new();
    let mut caller = Caller { robot: null_mut(), answers: vec![] };
    let context = (&raw mut caller).cast();
    let owned = of_table(&GoodbotTable { next: std::ptr::null(), step: Some(step), context, ..lift.table() }).unwrap();
    unsafe { (*context.cast::<Caller>()).robot = owned.robot };
    hear_and_plan(owned.robot, c"go to the roof");
    let (mut action, mut count) = (9, 0);
    assert_eq!(unsafe { goodbot_decide(owned.robot, &raw mut action, null_mut()) }, GoodbotStatus::Ok);
    // The session was not forgotten.
    assert_eq!(unsafe { goodbot_acted(owned.robot, action) }, GoodbotStatus::Ok);
    assert!(!caller.answers.is_empty());
    assert!(caller.answers.iter().all(|&answer| answer == GoodbotStatus::Busy), "{:?}", caller.answers);
    assert_eq!(unsafe { goodbot_session_count(owned.robot, &raw mut count) }, GoodbotStatus::Ok);
}

#[test]
fn a_table_robot_needs_what_its_size_says() {
    let lift = Lift::new();
    let mut owned = of_table(&lift.table()).unwrap();
    let mut robot: *mut Goodbot = null_mut();
    let table = lift.table();
    let (memory, capacities) = (owned.memory.as_mut_ptr(), &raw const owned.capacities);
    let made = unsafe {
        goodbot_capi::table::init::goodbot_init_table(memory.cast(), owned.bytes - 8, capacities, &raw const table, &raw mut robot)
    };
    assert_eq!(made, GoodbotStatus::Memory);
}

#[test]
fn a_robot_in_roomy_memory_tells_the_least_capacities_and_another_lives_in_them() {
    let lessons = GoodbotLessons { sessions: 4, words_per_command: 6, different_words: 12, word_bytes: 60 };
    let roomy = at_home();
    let mut least = small();
    unsafe {
        assert_eq!(goodbot_least_capacities(roomy.robot, &raw const lessons, &raw mut least), GoodbotStatus::Ok);
        assert_eq!(goodbot_least_capacities(roomy.robot, null(), &raw mut least), GoodbotStatus::Null);
        assert_eq!(goodbot_least_capacities(roomy.robot, &raw const lessons, null_mut()), GoodbotStatus::Null);
        assert_eq!(goodbot_least_capacities(null_mut(), &raw const lessons, &raw mut least), GoodbotStatus::Null);
    }
    assert!(unsafe { goodbot_size(&raw const least) } < roomy.bytes);
    assert_eq!(least.entries[GoodbotCapacity::Sessions as usize], 4);
    let robot = in_homes(least);
    assert_eq!(describe(robot.robot), GoodbotStatus::Ok);
    hear_and_plan(robot.robot, c"go to the green room");
    least.entries[GoodbotCapacity::Cells as usize] -= 1;
    assert_eq!(describe(in_homes(least).robot), GoodbotStatus::Full);
    let nowhere = in_homes(small());
    assert_eq!(unsafe { goodbot_least_capacities(nowhere.robot, &raw const lessons, &raw mut least) }, GoodbotStatus::NoWorld);
}
