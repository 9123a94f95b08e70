//! Several trainer strategies, through C.

use crate::robots;

use goodbot_capi::status::GoodbotStatus;
use goodbot_capi::training::*;
use robots::{at_home, hear_and_plan};
use std::ptr::{null, null_mut};

const BALANCED: GoodbotStrategy =
    GoodbotStrategy { mu_plus: 0.7, mu_minus: 0.7, epsilon: 0.1, lags: [1.0, 0.0, 0.0], rests: [0.7, 0.7, 0.1, 0.0], prior: 0.5 };
const LATE: GoodbotStrategy = GoodbotStrategy { mu_minus: 0.05, lags: [0.0, 1.0, 0.0], rests: [0.7, 0.05, 0.1, 0.0], ..BALANCED };

#[test]
fn a_trainer_can_be_one_of_several() {
    let owned = at_home();
    let given = [BALANCED, LATE];
    unsafe {
        assert_eq!(goodbot_trainers(owned.robot, given.as_ptr(), 2), GoodbotStatus::Ok);
        hear_and_plan(owned.robot, c"go to the green room");
        let (mut action, mut evidence) = (0, 0);
        assert_eq!(goodbot_decide(owned.robot, &raw mut action, null_mut()), GoodbotStatus::Ok);
        assert_eq!(goodbot_done(owned.robot, action), GoodbotStatus::Ok);
        assert_eq!(goodbot_feedback(owned.robot, GOODBOT_REWARD, &raw mut evidence), GoodbotStatus::Ok);
        assert_eq!(goodbot_finish(owned.robot, null_mut()), GoodbotStatus::Ok);
    }
}

#[test]
fn strategies_that_are_none_are_refused() {
    let owned = at_home();
    let refused = |given: &[GoodbotStrategy]| unsafe { goodbot_trainers(owned.robot, given.as_ptr(), given.len() as u32) };
    assert_eq!(refused(&[]), GoodbotStatus::Number);
    for wrong in [
        GoodbotStrategy { mu_plus: 1.5, ..BALANCED },
        GoodbotStrategy { epsilon: f32::NAN, ..BALANCED },
        GoodbotStrategy { lags: [0.5, 0.0, 0.0], ..BALANCED },
        GoodbotStrategy { prior: -1.0, ..BALANCED },
        GoodbotStrategy { prior: 0.0, ..BALANCED },
    ] {
        assert_eq!(refused(&[wrong]), GoodbotStatus::Number, "{wrong:?}");
    }
    // The small preset has room for three.
    assert_eq!(refused(&[BALANCED; 4]), GoodbotStatus::Full);
    assert_eq!(refused(&[BALANCED; GOODBOT_MOST_STRATEGIES + 1]), GoodbotStatus::Number);
    unsafe {
        assert_eq!(goodbot_trainers(owned.robot, null(), 1), GoodbotStatus::Null);
        assert_eq!(goodbot_trainers(null_mut(), &BALANCED, 1), GoodbotStatus::Null);
    }
}
