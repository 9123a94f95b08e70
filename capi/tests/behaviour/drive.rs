//! Wheels in C: the same as in Rust, and every misuse is answered.

use goodbot::home::Cell;
use goodbot_capi::drive::*;
use goodbot_capi::status::GoodbotStatus;
use goodbot_drive::{Drive, EAST, Grid, Limits, Motion};
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

static LIMITS: GoodbotLimits = GoodbotLimits {
    track: 0.12,
    speed: 0.3,
    turn: 3.0,
    acceleration: 1.0,
    slowest: 0.25,
    silence: 0.5,
    patience: 8.0,
    cell: 0.3,
    hysteresis: 0.1,
};
const TURN: f32 = 0.01;

fn made() -> GoodbotDrive {
    // Zeros, as a static of C is.
    let mut drive = unsafe { MaybeUninit::<GoodbotDrive>::zeroed().assume_init() };
    assert_eq!(unsafe { goodbot_drive_init(&raw mut drive, &raw const LIMITS) }, GoodbotStatus::Ok);
    drive
}

#[test]
fn a_drive_in_c_takes_the_same_steps_as_one_in_rust() {
    let GoodbotLimits { track, speed, turn, acceleration, slowest, silence, patience, cell, hysteresis } = LIMITS;
    let grid = Grid::new(cell, hysteresis).unwrap();
    let mut rust = Drive::new(Limits { track, speed, turn, acceleration, slowest, silence, patience }).unwrap();
    let mut c = made();
    let (mut there, mut x, mut y) = (grid.centre(Cell::new(2, 3)), 2, 3);
    let mut here = GoodbotPose { x: there.x, y: there.y, heading: there.heading };
    rust.go(Cell::new(2, 3), EAST, 0.9).unwrap();
    assert_eq!(unsafe { goodbot_drive_go(&raw mut c, 2, 3, 2, 0.9) }, GoodbotStatus::Ok);
    for _ in 0..1000 {
        rust.heard();
        let step = rust.step(&grid, there, TURN);
        there = there.rolled(step.wheels.left * TURN, step.wheels.right * TURN, track);
        let mut wheels = GoodbotWheels { left: 9.0, right: 9.0, motion: GoodbotMotion::Resting };
        unsafe {
            goodbot_drive_heard(&raw mut c);
            assert_eq!(goodbot_drive_step(&raw mut c, &raw const here, TURN, &raw mut wheels), GoodbotStatus::Ok);
            goodbot_pose_rolled(&raw mut here, wheels.left * TURN, wheels.right * TURN, track);
            goodbot_drive_cell(&raw mut c, &raw const here, &raw mut x, &raw mut y);
        }
        assert_eq!((here.x, here.y, here.heading), (there.x, there.y, there.heading));
        assert_eq!((wheels.left, wheels.motion as u8), (step.wheels.left, step.motion as u8));
        if step.motion == Motion::Arrived {
            assert_eq!((x, y), (3, 3));
            return;
        }
    }
    panic!("it never arrived");
}

#[test]
fn a_wheel_in_c_counts_over_its_overflow_holds_its_speed_and_is_calibrated() {
    let mut encoder = GoodbotEncoder { ticks_per_metre: 100.0, bits: 16, last: 65_530 };
    let (mut metres, mut duty, mut speed) = (0.0, 0.0, GoodbotSpeed { ahead: 2.0, proportional: 1.0, integral: 10.0, sum: 0.0 });
    let mut found = GoodbotCalibration { left: 0.0, right: 0.0, track: 0.0 };
    unsafe {
        assert_eq!(goodbot_encoder_rolled(&raw mut encoder, 4, &raw mut metres), GoodbotStatus::Ok);
        assert_eq!((metres, encoder.last), (0.1, 4));
        let duties = [(); 3].map(|()| {
            assert_eq!(goodbot_speed_duty(&raw mut speed, 0.2, 0.1, TURN, &raw mut duty), GoodbotStatus::Ok);
            duty
        });
        assert!(duties.is_sorted() && duties[2] > duties[0] && speed.sum > 0.0, "{duties:?}");
        let (straight, spun) = ([2_000.0, 2_000.0], [-942.478, 942.478]);
        assert_eq!(goodbot_calibrate(straight.as_ptr(), 2.0, spun.as_ptr(), 2.0, &raw mut found), GoodbotStatus::Ok);
    }
    assert!((found.left, found.right) == (1_000.0, 1_000.0) && (found.track - 0.15).abs() < 1e-6, "{found:?}");
}

#[test]
fn misuse_of_a_drive_is_answered() {
    let (mut drive, mut none) = (made(), unsafe { MaybeUninit::<GoodbotDrive>::zeroed().assume_init() });
    let mut wheels = GoodbotWheels { left: 0.0, right: 0.0, motion: GoodbotMotion::Resting };
    let (here, zero) = (GoodbotPose { x: 0.0, y: 0.0, heading: 0.0 }, [0.0; 2]);
    let mut encoder = GoodbotEncoder { ticks_per_metre: 100.0, bits: 33, last: 0 };
    let mut speed = GoodbotSpeed { ahead: -1.0, proportional: 1.0, integral: 10.0, sum: 0.0 };
    let (mut number, mut found) = (0.0, GoodbotCalibration { left: 0.0, right: 0.0, track: 0.0 });
    let slow = GoodbotLimits { speed: 0.0, ..LIMITS };
    unsafe {
        assert_eq!(goodbot_drive_init(null_mut(), &raw const LIMITS), GoodbotStatus::Null);
        assert_eq!(goodbot_drive_init(&raw mut none, null()), GoodbotStatus::Null);
        assert_eq!(goodbot_drive_init(&raw mut none, &raw const slow), GoodbotStatus::Number);
        assert_eq!(goodbot_drive_heard(&raw mut none), GoodbotStatus::BadHandle);
        assert_eq!(goodbot_drive_step(&raw mut none, &raw const here, TURN, &raw mut wheels), GoodbotStatus::BadHandle);
        assert_eq!(goodbot_drive_step(&raw mut drive, null(), TURN, &raw mut wheels), GoodbotStatus::Null);
        assert_eq!(goodbot_drive_go(&raw mut drive, 0, 0, 4, 1.0), GoodbotStatus::NotApplicable);
        assert_eq!(goodbot_drive_bumped(null_mut()), GoodbotStatus::Null);
        assert_eq!(goodbot_drive_halt(&raw mut drive), GoodbotStatus::Ok);
        assert_eq!(goodbot_encoder_rolled(&raw mut encoder, 1, &raw mut number), GoodbotStatus::Number);
        assert_eq!(goodbot_speed_duty(&raw mut speed, 0.1, 0.0, TURN, &raw mut number), GoodbotStatus::Number);
        assert_eq!(goodbot_calibrate(zero.as_ptr(), 1.0, zero.as_ptr(), 1.0, &raw mut found), GoodbotStatus::Number);
        assert_eq!(goodbot_calibrate(null(), 1.0, zero.as_ptr(), 1.0, &raw mut found), GoodbotStatus::Null);
        assert_eq!(goodbot_pose_corrected(null_mut(), &raw const here, 1.0), GoodbotStatus::Null);
    }
}
