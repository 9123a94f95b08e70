//! A robot that begins with everyday sentences, and leaves more of them the more it is taught.

use crate::robots;

use goodbot_capi::capacities::GoodbotCapacity;
use goodbot_capi::memory::goodbot_session_count;
use goodbot_capi::model::*;
use goodbot_capi::robot::Goodbot;
use goodbot_capi::starter::goodbot_join_starter;
use goodbot_capi::status::GoodbotStatus;
use goodbot_capi::training::*;
use robots::{Owned, at_home, describe, hear_and_plan, in_homes, small};
use std::ffi::CStr;
use std::ptr::{null, null_mut};

/// A session of one rest.
fn lesson(robot: *mut Goodbot, command: &CStr) -> GoodbotStatus {
    hear_and_plan(robot, command);
    unsafe {
        assert_eq!(goodbot_acted(robot, GOODBOT_NOOP), GoodbotStatus::Ok);
        assert_eq!(goodbot_feedback(robot, GOODBOT_PUNISH, &mut 0), GoodbotStatus::Ok);
        let finished = goodbot_finish(robot, null_mut());
        learn(robot);
        finished
    }
}

fn learn(robot: *mut Goodbot) {
    while unsafe { goodbot_learn(robot, u32::MAX) } == GoodbotStatus::Working {}
}

fn saved(robot: *mut Goodbot) -> Vec<u8> {
    let (mut model, mut length) = (vec![0; 4_096], 0);
    assert_eq!(unsafe { goodbot_save(robot, model.as_mut_ptr(), model.len(), &raw mut length) }, GoodbotStatus::Ok);
    model.truncate(length);
    model
}

fn sessions(robot: *mut Goodbot) -> u32 {
    let mut count = 0;
    assert_eq!(unsafe { goodbot_session_count(robot, &raw mut count) }, GoodbotStatus::Ok);
    count
}

/// Joins a starter. Returns the status and the number of its sentences.
fn join(robot: *mut Goodbot, starter: &[u8]) -> (GoodbotStatus, u32) {
    let mut added = u32::MAX;
    let status = unsafe { goodbot_join_starter(robot, starter.as_ptr(), starter.len(), &raw mut added) };
    learn(robot);
    (status, added)
}

fn leave(robot: *mut Goodbot) {
    assert_eq!(unsafe { goodbot_join_starter(robot, null(), 0, null_mut()) }, GoodbotStatus::Ok);
}

/// A robot that keeps this many sessions.
fn with_room_for(sessions: u32) -> Owned {
    let mut capacities = small();
    capacities.entries[GoodbotCapacity::Sessions as usize] = sessions;
    let robot = in_homes(capacities);
    assert_eq!(describe(robot.robot), GoodbotStatus::Ok);
    robot
}

/// The sentences of a starter, eight.
fn starter() -> (Owned, Vec<u8>) {
    let robot = at_home();
    for command in [c"one a", c"two a", c"three a", c"four a", c"five a", c"six a", c"seven a", c"eight a"] {
        assert_eq!(lesson(robot.robot, command), GoodbotStatus::Ok);
    }
    let model = saved(robot.robot);
    (robot, model)
}

#[test]
fn a_robot_begins_with_a_starter_and_leaves_more_of_it_with_each_lesson() {
    let (_first, model) = starter();
    let robot = with_room_for(20);
    assert_eq!(join(robot.robot, &model), (GoodbotStatus::Ok, 8));
    for own in 1..=11 {
        assert_eq!(lesson(robot.robot, c"go to the green room"), GoodbotStatus::Ok);
        let left = (8 * 32_u32).div_ceil(32 + own);
        assert_eq!((join(robot.robot, &model), sessions(robot.robot)), ((GoodbotStatus::Ok, left), own + left));
    }
    assert_eq!(join(robot.robot, &model), (GoodbotStatus::Ok, 6));
    leave(robot.robot);
    let alone = with_room_for(20);
    for _ in 0..11 {
        assert_eq!(lesson(alone.robot, c"go to the green room"), GoodbotStatus::Ok);
    }
    assert_eq!(sessions(robot.robot), sessions(alone.robot));
}

#[test]
fn a_starter_does_not_take_the_robots_own_sessions_with_it() {
    let (_first, model) = starter();
    let robot = at_home();
    // The robot's own session is in the starter too.
    assert_eq!(lesson(robot.robot, c"one a"), GoodbotStatus::Ok);
    let own = saved(robot.robot);
    assert_eq!(join(robot.robot, &model), (GoodbotStatus::Ok, 7));
    leave(robot.robot);
    assert_eq!(saved(robot.robot), own);
    // Restored sessions are the robot's own.
    assert_eq!(join(robot.robot, &model), (GoodbotStatus::Ok, 7));
    let both = saved(robot.robot);
    assert_eq!(unsafe { goodbot_restore(robot.robot, both.as_ptr(), both.len()) }, GoodbotStatus::Ok);
    leave(robot.robot);
    assert_eq!(sessions(robot.robot), 8);
}

#[test]
fn sentences_that_gave_way_are_not_taken_for_the_robots_own() {
    let (_first, model) = starter();
    let robot = with_room_for(9);
    assert_eq!(join(robot.robot, &model), (GoodbotStatus::Ok, 8));
    for _ in 0..3 {
        assert_eq!(lesson(robot.robot, c"go to the green room"), GoodbotStatus::Ok);
    }
    assert_eq!(sessions(robot.robot), 9);
    leave(robot.robot);
    assert_eq!(sessions(robot.robot), 3);
}

#[test]
fn the_sentences_become_the_robots_own_if_the_end_of_a_lesson_is_broken_off() {
    let (_first, model) = starter();
    for parts in 0..1_000 {
        let robot = with_room_for(9);
        assert_eq!(join(robot.robot, &model), (GoodbotStatus::Ok, 8));
        assert_eq!(lesson(robot.robot, c"go to the green room"), GoodbotStatus::Ok);
        hear_and_plan(robot.robot, c"nine b");
        unsafe {
            assert_eq!(goodbot_acted(robot.robot, GOODBOT_NOOP), GoodbotStatus::Ok);
            assert_eq!(goodbot_feedback(robot.robot, GOODBOT_PUNISH, &mut 0), GoodbotStatus::Ok);
            assert_eq!(goodbot_begin_finishing(robot.robot), GoodbotStatus::Ok);
            if (0..parts).any(|_| goodbot_finish_on(robot.robot, 1, null_mut()) == GoodbotStatus::Ok) {
                assert!(parts > 2, "the end has parts");
                return;
            }
            match goodbot_forget(robot.robot) {
                // Too late to break it off.
                GoodbotStatus::StillFinishing => continue,
                status => assert_eq!(status, GoodbotStatus::Ok),
            }
        }
        let before = sessions(robot.robot);
        leave(robot.robot);
        assert_eq!(sessions(robot.robot), before, "after {parts} parts");
    }
    panic!("the session does not end");
}

#[test]
fn a_starter_without_room_is_refused_and_the_robot_goes_on_without() {
    let (_first, model) = starter();
    let robot = with_room_for(4);
    assert_eq!((join(robot.robot, &model).0, sessions(robot.robot)), (GoodbotStatus::Full, 0));
    assert_eq!(join(robot.robot, &model[1..]).0, GoodbotStatus::BadModel);
    assert_eq!(unsafe { goodbot_join_starter(null_mut(), null(), 0, null_mut()) }, GoodbotStatus::Null);
}
