//! Several transcripts of one command, through C.

use crate::robots;

use goodbot_capi::robot::Goodbot;
use goodbot_capi::status::GoodbotStatus;
use goodbot_capi::training::*;
use robots::{at_home, in_homes, small};
use std::ffi::CStr;
use std::ptr::{null, null_mut};

type HearOneOf = unsafe extern "C" fn(*mut Goodbot, *const GoodbotHypothesis, u32, *mut u32) -> GoodbotStatus;

fn hear(robot: *mut Goodbot, given: &[(&'static CStr, f32)]) -> Result<u32, GoodbotStatus> {
    hear_by(goodbot_hear_one_of, robot, given)
}

fn hear_by(function: HearOneOf, robot: *mut Goodbot, given: &[(&'static CStr, f32)]) -> Result<u32, GoodbotStatus> {
    let list: Vec<_> = given.iter().map(|&(command, weight)| GoodbotHypothesis { command: command.as_ptr(), weight }).collect();
    let mut chosen = u32::MAX;
    match unsafe { function(robot, list.as_ptr(), list.len() as u32, &raw mut chosen) } {
        GoodbotStatus::Ok => Ok(chosen),
        status => Err(status),
    }
}

#[test]
fn what_was_learned_chooses_the_transcript() {
    let owned = at_home();
    for _ in 0..3 {
        unsafe {
            assert_eq!(goodbot_hear(owned.robot, c"go to the green room".as_ptr()), GoodbotStatus::Ok);
            assert_eq!(goodbot_finish(owned.robot, null_mut()), GoodbotStatus::Ok);
            while goodbot_learn(owned.robot, 1_000) == GoodbotStatus::Working {}
        }
    }
    assert_eq!(hear(owned.robot, &[(c"goat tooth a grin broom", 0.5), (c"go to the green room", 0.4)]), Ok(1));
    let logs = [(c"goat tooth a grin broom", -90.7), (c"go to the green room", -90.9), (c"go", f32::NEG_INFINITY)];
    assert_eq!(hear_by(goodbot_hear_one_of_logs, owned.robot, &logs), Ok(1));
    assert_eq!(hear(owned.robot, &logs), Err(GoodbotStatus::Number));
}

#[test]
fn lists_that_say_nothing_are_refused() {
    let owned = at_home();
    assert_eq!(hear(owned.robot, &[]), Err(GoodbotStatus::EmptyCommand));
    assert_eq!(hear(owned.robot, &[(c"?!", 1.0)]), Err(GoodbotStatus::EmptyCommand));
    assert_eq!(hear(owned.robot, &[(c"go", f32::NAN)]), Err(GoodbotStatus::Number));
    assert_eq!(hear(owned.robot, &[(c"go", 1.0); GOODBOT_MOST_HYPOTHESES + 1]), Err(GoodbotStatus::Number));
    assert_eq!(hear_by(goodbot_hear_one_of_logs, owned.robot, &[(c"go", f32::NAN)]), Err(GoodbotStatus::Number));
    assert_eq!(hear_by(goodbot_hear_one_of_logs, owned.robot, &[(c"go", f32::NEG_INFINITY)]), Err(GoodbotStatus::EmptyCommand));
    assert_eq!(hear_by(goodbot_hear_one_of_logs, null_mut(), &[(c"go", -1.0)]), Err(GoodbotStatus::Null));
    assert_eq!(hear(null_mut(), &[(c"go", 1.0)]), Err(GoodbotStatus::Null));
    assert_eq!(hear(in_homes(small()).robot, &[(c"go", 1.0)]), Err(GoodbotStatus::NoWorld));
    let mut chosen = 0;
    unsafe {
        assert_eq!(goodbot_hear_one_of(owned.robot, null(), 1, &raw mut chosen), GoodbotStatus::Null);
        let nothing = GoodbotHypothesis { command: null(), weight: 1.0 };
        assert_eq!(goodbot_hear_one_of(owned.robot, &nothing, 1, &raw mut chosen), GoodbotStatus::Null);
        assert_eq!(goodbot_hear_one_of(owned.robot, &nothing, 1, null_mut()), GoodbotStatus::Null);
    }
}
