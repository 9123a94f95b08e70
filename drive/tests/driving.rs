//! The wheel speeds, case by case.

use goodbot::home::Cell;
use goodbot::oomdp::Action;
use goodbot_drive::{Drive, DriveError, EAST, Grid, Limits, Motion, NORTH, Pose, Wheels};

const LIMITS: Limits = Limits { track: 0.12, speed: 0.3, turn: 3.0, acceleration: 1.0, slowest: 0.25, silence: 0.5, patience: 8.0 };
const TURN: f32 = 0.01;
const HERE: Cell = Cell::new(2, 3);

fn grid() -> Grid {
    Grid::new(0.3, 0.1).unwrap()
}

/// Drives until the robot stands; returns the seconds it took, the highest speed and the pose.
fn ride(certainty: f32) -> (f32, f32, Pose) {
    let mut drive = Drive::new(LIMITS).unwrap();
    drive.go(HERE, EAST, certainty).unwrap();
    let (mut pose, mut highest) = (grid().centre(HERE), 0.0f32);
    for turn in 1..2000 {
        drive.heard();
        let step = drive.step(&grid(), pose, TURN);
        if step.motion == Motion::Arrived {
            return (turn as f32 * TURN, highest, pose);
        }
        highest = highest.max(step.wheels.left);
        pose = pose.rolled(step.wheels.left * TURN, step.wheels.right * TURN, LIMITS.track);
    }
    panic!("it never arrived");
}

#[test]
fn a_robot_comes_to_stand_in_the_middle_of_the_next_cell() {
    let (_, _, pose) = ride(1.0);
    let there = grid().centre(Cell::new(3, 3));
    assert!((pose.x - there.x).abs() < 0.01 && (pose.y - there.y).abs() < 0.005, "{pose:?}");
}

#[test]
fn an_unsure_robot_drives_slowly_so_that_a_person_can_object() {
    let ((sure_time, sure_speed, _), (unsure_time, unsure_speed, _)) = (ride(1.0), ride(0.0));
    assert!(unsure_time > 2.0 * sure_time, "{unsure_time} s and {sure_time} s");
    assert!(unsure_speed <= LIMITS.speed * LIMITS.slowest + 0.01, "{unsure_speed}");
    assert!(sure_speed > LIMITS.speed * 0.8, "{sure_speed}");
    // A certainty that is not a number counts as none.
    assert_eq!(ride(f32::NAN), ride(0.0));
}

#[test]
fn no_wheel_changes_its_speed_faster_than_allowed() {
    let mut drive = Drive::new(LIMITS).unwrap();
    drive.go(HERE, NORTH, 1.0).unwrap();
    let (mut pose, mut before) = (grid().centre(HERE), Wheels::default());
    for turn in 0..1000 {
        drive.heard();
        if turn == 150 {
            drive.halt();
        }
        let Wheels { left, right } = drive.step(&grid(), pose, TURN).wheels;
        let most = LIMITS.acceleration * TURN + 1e-6;
        assert!((left - before.left).abs() <= most && (right - before.right).abs() <= most, "turn {turn}");
        pose = pose.rolled(left * TURN, right * TURN, LIMITS.track);
        before = Wheels { left, right };
    }
    assert_eq!(before, Wheels::default());
}

#[test]
fn a_robot_that_hears_nothing_stops_and_goes_on_once_it_does() {
    let mut drive = Drive::new(LIMITS).unwrap();
    drive.go(HERE, EAST, 1.0).unwrap();
    let pose = grid().centre(HERE);
    let steps: Vec<_> = (0..200).map(|_| drive.step(&grid(), pose, TURN)).collect();
    assert_eq!(steps.last().map(|step| (step.motion, step.wheels)), Some((Motion::Waiting, Wheels::default())));
    drive.heard();
    assert_eq!(drive.step(&grid(), pose, TURN).motion, Motion::Driving);
}

#[test]
fn a_robot_that_does_not_come_forward_says_that_it_is_stuck() {
    let mut drive = Drive::new(LIMITS).unwrap();
    drive.go(HERE, EAST, 1.0).unwrap();
    let motions = (0..1000).map(|_| {
        drive.heard();
        drive.step(&grid(), grid().centre(HERE), TURN).motion
    });
    let motions: Vec<_> = motions.collect();
    assert!(motions.contains(&Motion::Stuck));
    assert_eq!(motions.last(), Some(&Motion::Resting));
}

#[test]
fn a_robot_that_does_not_know_where_it_is_stops() {
    let mut drive = Drive::new(LIMITS).unwrap();
    drive.go(HERE, EAST, 1.0).unwrap();
    let nowhere = Pose { x: f32::NAN, y: 0.0, heading: 0.0 };
    assert_eq!(drive.step(&grid(), nowhere, TURN).motion, Motion::Waiting);
    let here = grid().centre(HERE);
    assert_eq!(here.corrected(nowhere, 0.5), here);
    assert_eq!(grid().cell(nowhere, HERE), HERE);
}

#[test]
fn a_cell_changes_only_where_the_robot_is_clearly_beyond_the_border() {
    let at = |x: f32, before: Cell| grid().cell(Pose { x: x * 0.3, y: 0.9, heading: 0.0 }, before).x;
    assert_eq!(at(2.55, HERE), 2);
    assert_eq!(at(2.65, HERE), 3);
    // Back on the border it stays in the new cell.
    assert_eq!(at(2.45, Cell::new(3, 3)), 3);
    assert_eq!(at(2.35, Cell::new(3, 3)), 2);
}

#[test]
fn a_robot_off_the_line_goes_back_to_the_middle_before_it_turns() {
    let mut drive = Drive::new(LIMITS).unwrap();
    drive.go(HERE, NORTH, 1.0).unwrap();
    // It was stopped on its way to the east.
    let middle = grid().centre(HERE);
    let mut pose = Pose { x: middle.x + 0.12, ..middle };
    let mut motions = Vec::new();
    for _ in 0..2000 {
        drive.heard();
        let step = drive.step(&grid(), pose, TURN);
        motions.push(step.motion);
        if step.motion == Motion::Arrived {
            break;
        }
        // The robot is on the line before it comes near the next cell.
        assert!(pose.y < middle.y + 0.02 || (pose.x - middle.x).abs() < 0.03, "{pose:?}");
        pose = pose.rolled(step.wheels.left * TURN, step.wheels.right * TURN, LIMITS.track);
    }
    motions.dedup();
    assert_eq!(motions, [Motion::Centring, Motion::Turning, Motion::Driving, Motion::Arrived]);
}

#[test]
fn a_quarter_turn_of_the_wheels_faces_north() {
    let quarter = core::f32::consts::FRAC_PI_4 * LIMITS.track;
    let turned = Pose { x: 0.0, y: 0.0, heading: 0.0 }.rolled(-quarter, quarter, LIMITS.track);
    assert!((turned.heading - core::f32::consts::FRAC_PI_2).abs() < 1e-5 && turned.x.abs() < 1e-6);
}

#[test]
fn what_is_wrong_with_a_setting_is_said() {
    let with = |limits: Limits| Drive::new(limits).unwrap_err().to_string();
    assert_eq!(with(Limits { track: 0.0, ..LIMITS }), "track is 0: it must be above 0");
    assert_eq!(with(Limits { slowest: 1.5, ..LIMITS }), "slowest is 1.5: it must be above 0 and at most 1");
    assert_eq!(with(Limits { patience: f32::NAN, ..LIMITS }), "patience is NaN: it must be above 0");
    assert_eq!(Grid::new(-1.0, 0.1), Err(DriveError::CellSize(-1.0)));
    assert_eq!(Grid::new(0.3, 0.5), Err(DriveError::Hysteresis(0.5)));
    let mut drive = Drive::new(LIMITS).unwrap();
    assert_eq!(drive.go(HERE, Action::new(4), 1.0), Err(DriveError::NoNeighbour(Action::new(4))));
    assert_eq!(drive.go(HERE, Action::NOOP, 1.0), Err(DriveError::NoNeighbour(Action::NOOP)));
}

#[test]
fn a_robot_that_runs_into_something_stops_at_once_and_gives_the_action_up() {
    let mut drive = Drive::new(LIMITS).unwrap();
    drive.go(HERE, EAST, 1.0).unwrap();
    let pose = grid().centre(HERE);
    for _ in 0..20 {
        assert_eq!(drive.step(&grid(), pose, TURN).motion, Motion::Driving);
    }
    drive.bumped();
    let step = drive.step(&grid(), pose, TURN);
    assert_eq!((step.motion, step.wheels), (Motion::Stuck, Wheels::default()));
    assert_eq!(drive.step(&grid(), pose, TURN).motion, Motion::Resting);
}

#[test]
fn a_robot_at_a_wall_turns_away_and_backs_off_although_its_bumper_is_pressed() {
    let mut drive = Drive::new(LIMITS).unwrap();
    drive.go(HERE, NORTH, 1.0).unwrap();
    // It faces the wall east of its cell.
    let (middle, mut motions) = (grid().centre(HERE), Vec::new());
    let mut pose = Pose { x: middle.x + 0.06, ..middle };
    for _ in 0..2000 {
        drive.heard();
        if pose.x > middle.x + 0.05 {
            drive.bumped();
        }
        let step = drive.step(&grid(), pose, TURN);
        motions.push(step.motion);
        if step.motion == Motion::Arrived {
            break;
        }
        pose = pose.rolled(step.wheels.left * TURN, step.wheels.right * TURN, LIMITS.track);
    }
    motions.dedup();
    assert_eq!(motions, [Motion::Centring, Motion::Turning, Motion::Driving, Motion::Arrived]);
}
