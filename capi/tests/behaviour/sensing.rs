//! Sensed places overrule the described effect of an action.

use crate::robots;

use goodbot_capi::home::*;
use goodbot_capi::robot::Goodbot;
use goodbot_capi::status::GoodbotStatus;
use goodbot_capi::training::*;
use robots::{Lift, at_home, hear_and_plan, in_homes, of_table, small};
use std::ffi::CStr;
use std::ptr::{null, null_mut};

fn sensed(name: &'static CStr, x: i32, y: i32) -> GoodbotSensed {
    GoodbotSensed { name: name.as_ptr(), x, y }
}

fn sense(robot: *mut Goodbot, things: &[GoodbotSensed]) -> GoodbotStatus {
    unsafe { goodbot_home_sense(robot, things.as_ptr(), things.len() as u32) }
}

fn cell(robot: *mut Goodbot, name: &CStr) -> (i32, i32) {
    let (mut x, mut y) = (0, 0);
    assert_eq!(unsafe { goodbot_home_where(robot, name.as_ptr(), &raw mut x, &raw mut y) }, GoodbotStatus::Ok);
    (x, y)
}

#[test]
fn robot_and_block_change_places_in_one_call() {
    let owned = at_home();
    assert_eq!((cell(owned.robot, c"agent0"), cell(owned.robot, c"block0")), ((4, 2), (6, 2)));
    assert_eq!(sense(owned.robot, &[sensed(c"agent0", 6, 2), sensed(c"block0", 4, 2)]), GoodbotStatus::Ok);
    assert_eq!((cell(owned.robot, c"agent0"), cell(owned.robot, c"block0")), ((6, 2), (4, 2)));
    assert_eq!(sense(owned.robot, &[sensed(c"block0", 5, 3)]), GoodbotStatus::Ok);
    assert_eq!((cell(owned.robot, c"agent0"), cell(owned.robot, c"block0")), ((6, 2), (5, 3)));
}

#[test]
fn what_cannot_be_is_refused_and_changes_nothing() {
    let owned = at_home();
    for (things, status) in [
        (&[sensed(c"agent0", 5, 2), sensed(c"block0", 5, 2)][..], GoodbotStatus::Number),
        (&[sensed(c"agent0", 5, 2), sensed(c"block0", 0, 0)], GoodbotStatus::Number),
        (&[sensed(c"agent0", 5, 2), sensed(c"room0", 3, 3)], GoodbotStatus::Unknown),
        (&[sensed(c"agent0", 5, 2), sensed(c"block1", 3, 3)], GoodbotStatus::Unknown),
        (&[sensed(c"agent0", 5, 2), GoodbotSensed { name: null(), x: 3, y: 3 }], GoodbotStatus::Null),
        (&[sensed(c"agent0", 5, 2); 100], GoodbotStatus::Number),
    ] {
        assert_eq!(sense(owned.robot, things), status);
        assert_eq!((cell(owned.robot, c"agent0"), cell(owned.robot, c"block0")), ((4, 2), (6, 2)));
    }
    unsafe {
        assert_eq!(goodbot_home_sense(owned.robot, null(), 1), GoodbotStatus::Null);
        assert_eq!(goodbot_home_sense(null_mut(), null(), 0), GoodbotStatus::Null);
        let nowhere = in_homes(small());
        assert_eq!(goodbot_home_sense(nowhere.robot, &sensed(c"agent0", 5, 2), 1), GoodbotStatus::NoWorld);
    }
}

#[test]
fn a_lesson_goes_on_from_where_a_push_left_things() {
    let owned = at_home();
    let robot = owned.robot;
    hear_and_plan(robot, c"go to the green room");
    unsafe {
        let (mut action, mut evidence) = (0, 0);
        assert_eq!(goodbot_decide(robot, &raw mut action, null_mut()), GoodbotStatus::Ok);
        assert_eq!(goodbot_acted(robot, action), GoodbotStatus::Ok);
        // The wheels slipped, and somebody took the block away.
        assert_eq!(sense(robot, &[sensed(c"agent0", 4, 2), sensed(c"block0", 1, 1)]), GoodbotStatus::Ok);
        assert_eq!(goodbot_feedback(robot, GOODBOT_REWARD, &raw mut evidence), GoodbotStatus::Ok);
        while goodbot_plan(robot, 50) == GoodbotStatus::Working {}
        assert_eq!(goodbot_decide(robot, &raw mut action, null_mut()), GoodbotStatus::Ok);
        assert_eq!(goodbot_acted(robot, action), GoodbotStatus::Ok);
        assert_eq!(goodbot_finish(robot, null_mut()), GoodbotStatus::Ok);
    }
}

#[test]
fn a_robot_of_one_s_own_is_in_no_home() {
    let lift = Lift::new();
    let owned = of_table(&lift.table()).unwrap();
    unsafe {
        assert_eq!(goodbot_home_begin(owned.robot), GoodbotStatus::World);
        assert_eq!(goodbot_home_sense(owned.robot, &sensed(c"lift0", 1, 1), 1), GoodbotStatus::NoWorld);
    }
}
