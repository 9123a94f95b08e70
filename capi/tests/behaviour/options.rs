//! How a robot takes evidence and acts, through C.

use crate::robots;

use goodbot_capi::beliefs::goodbot_task_count;
use goodbot_capi::memory::goodbot_session_count;
use goodbot_capi::options::*;
use goodbot_capi::robot::Goodbot;
use goodbot_capi::status::GoodbotStatus;
use goodbot_capi::training::*;
use robots::{at_home, hear_and_plan};
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

fn options(robot: *mut Goodbot) -> GoodbotOptions {
    let mut options = MaybeUninit::uninit();
    assert_eq!(unsafe { goodbot_current_options(robot, options.as_mut_ptr()) }, GoodbotStatus::Ok);
    unsafe { options.assume_init() }
}

const fn hazard(moved: f32) -> GoodbotHazard {
    GoodbotHazard { moved, rested: 0.2, resting: 0.3, praised: 2.0, scolded: 0.5 }
}

/// Does one action, lets the trainer end the session, and returns the evidence.
fn ended(robot: *mut Goodbot) -> u32 {
    hear_and_plan(robot, c"go to the green room");
    let (mut action, mut evidence) = (0, 0);
    unsafe {
        assert_eq!(goodbot_decide(robot, &raw mut action, null_mut()), GoodbotStatus::Ok);
        assert_eq!(goodbot_acted(robot, action), GoodbotStatus::Ok);
        assert_eq!(goodbot_trainer_ended(robot, &raw mut evidence), GoodbotStatus::NotPlanned);
        while goodbot_plan(robot, 50) == GoodbotStatus::Working {}
        assert_eq!(goodbot_trainer_ended(robot, &raw mut evidence), GoodbotStatus::Ok);
        assert_eq!(goodbot_finish(robot, null_mut()), GoodbotStatus::Ok);
        while goodbot_learn(robot, 1000) == GoodbotStatus::Working {}
    }
    evidence
}

#[test]
fn the_end_of_a_session_is_evidence_where_the_options_say_so() {
    let owned = at_home();
    let first = options(owned.robot);
    assert_eq!((first.telling, first.drift, first.weights), (true, 0.0, GOODBOT_WEIGHTS_PAPER));
    assert_eq!(ended(owned.robot), GOODBOT_EVIDENCE_UNINFORMATIVE);
    let (ends_at_goal, ends_elsewhere) = (hazard(0.1), hazard(0.02));
    let given = GoodbotOptions { ends_at_goal, ends_elsewhere, drift: 0.1, weights: GOODBOT_WEIGHTS_EVIDENCE, ..first };
    assert_eq!(unsafe { goodbot_set_options(owned.robot, &raw const given) }, GoodbotStatus::Ok);
    let now = options(owned.robot);
    assert_eq!(
        (now.ends_at_goal, now.ends_elsewhere, now.drift, now.weights),
        (ends_at_goal, ends_elsewhere, 0.1, GOODBOT_WEIGHTS_EVIDENCE)
    );
    assert_eq!(ended(owned.robot), GOODBOT_EVIDENCE_USED);
    let mut sessions = 0;
    assert_eq!(unsafe { goodbot_session_count(owned.robot, &raw mut sessions) }, GoodbotStatus::Ok);
    assert_eq!(sessions, 2, "what was learned stays");
}

#[test]
fn a_command_may_be_about_what_holds_already_unless_the_options_say_otherwise() {
    let owned = at_home();
    let first = options(owned.robot);
    let tasks = |done: f32| {
        let given = GoodbotOptions { done, ..first };
        let mut count = 0;
        unsafe {
            assert_eq!(goodbot_set_options(owned.robot, &raw const given), GoodbotStatus::Ok);
            hear_and_plan(owned.robot, c"go to the green room");
            assert_eq!(goodbot_task_count(owned.robot, &raw mut count), GoodbotStatus::Ok);
            assert_eq!(goodbot_forget(owned.robot), GoodbotStatus::Ok);
        }
        count
    };
    assert_eq!(first.done, 0.08);
    assert!(tasks(0.08) > tasks(0.0));
}

#[test]
fn options_out_of_range_are_refused_and_change_nothing() {
    let owned = at_home();
    let first = options(owned.robot);
    for wrong in [
        GoodbotOptions { drift: 1.5, ..first },
        GoodbotOptions { drift: f32::NAN, ..first },
        GoodbotOptions { ends_at_goal: hazard(1.0), ..first },
        GoodbotOptions { ends_at_goal: GoodbotHazard { praised: 10.0, ..hazard(0.1) }, ..first },
        GoodbotOptions { least_weight: -0.1, ..first },
        GoodbotOptions { done: 1.0, ..first },
        GoodbotOptions { weights: 3, ..first },
    ] {
        assert_eq!(unsafe { goodbot_set_options(owned.robot, &raw const wrong) }, GoodbotStatus::Number, "{wrong:?}");
        assert_eq!(options(owned.robot).drift, 0.0);
    }
    unsafe {
        assert_eq!(goodbot_set_options(owned.robot, null()), GoodbotStatus::Null);
        assert_eq!(goodbot_current_options(owned.robot, null_mut()), GoodbotStatus::Null);
        assert_eq!(goodbot_trainer_ended(owned.robot, null_mut()), GoodbotStatus::Null);
    }
}
