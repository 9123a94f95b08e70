//! One wheel: its encoder, its calibration and its speed.

use goodbot_drive::{Calibration, DriveError, Encoder, Gains, SpeedControl};
use std::f32::consts::PI;

#[test]
fn a_counter_that_wraps_around_loses_no_distance() {
    for (bits, steps) in [(8, 100_u32), (16, 30_000), (24, 5_000_000), (32, 2_000_000_000)] {
        for ahead in [steps, steps.wrapping_neg()] {
            let (mut count, mask) = (7_u32, u32::MAX >> (32 - bits));
            let mut encoder = Encoder::new(100.0, bits, count).unwrap();
            let sum: f32 = (0..10)
                .map(|_| {
                    count = count.wrapping_add(ahead) & mask;
                    encoder.rolled(count)
                })
                .sum();
            let expected = ahead as i32 as f32 / 10.0;
            assert!((sum / expected - 1.0).abs() < 1e-5, "{bits} bits: {sum} m, not {expected} m");
        }
    }
    let mut mirrored = Encoder::new(-100.0, 16, 0).unwrap();
    assert_eq!(mirrored.rolled(0xFFFF), 0.01);
}

#[test]
fn two_runs_tell_the_ticks_of_each_wheel_and_the_distance_between_them() {
    // The right wheel's counter counts down.
    let rolled = PI * 0.15 * 10.0;
    let found = Calibration::measured([2_040.0, -1_960.0], 2.0, [-rolled * 1_020.0, -rolled * 980.0], 10.0).unwrap();
    assert_eq!((found.left, found.right), (1_020.0, -980.0));
    assert!((found.track - 0.15).abs() < 1e-6, "{}", found.track);
}

#[test]
fn a_run_that_tells_nothing_is_named() {
    let said = |straight, metres, spun, turns| Calibration::measured(straight, metres, spun, turns).unwrap_err().to_string();
    assert!(said([2_000.0, 0.0], 2.0, [-300.0, 300.0], 1.0).starts_with("the straight run has 2000 and 0 ticks"));
    assert!(said([2_000.0, 2_000.0], 0.0, [-300.0, 300.0], 1.0).starts_with("the straight run"));
    assert!(said([2_000.0, 2_000.0], 2.0, [300.0, -300.0], 1.0).starts_with("the run spun has 300 and -300 ticks"));
    assert!(said([2_000.0, 2_000.0], 2.0, [-300.0, 300.0], 0.0).starts_with("the run spun"));
    assert_eq!(Encoder::new(0.0, 16, 0), Err(DriveError::Encoder { ticks_per_metre: 0.0, bits: 16 }));
    assert!(Encoder::new(1.0, 33, 0).is_err() && Encoder::new(1.0, 1, 0).is_err());
    let wrong = SpeedControl::new(Gains { integral: f32::NAN, ..GAINS });
    assert_eq!(wrong.unwrap_err().to_string(), "the gain integral is NaN: it must be at least 0");
}

/// A new motor would reach 0.5 m/s at full duty.
const GAINS: Gains = Gains { ahead: 2.0, proportional: 2.0, integral: 20.0 };
const TURN: f32 = 0.01;

/// A motor that follows its duty after 50 ms. Returns each turn's speed and duty.
fn run(wanted: f32, turns: usize, top_speed: impl Fn(usize) -> f32) -> Vec<(f32, f32)> {
    let (mut control, mut speed) = (SpeedControl::new(GAINS).unwrap(), 0.0);
    let turn = |turn| {
        let duty = control.duty(wanted, speed, TURN);
        speed += (duty * top_speed(turn) - speed) * TURN / 0.05;
        (speed, duty)
    };
    (0..turns).map(turn).collect()
}

#[test]
fn a_wheel_keeps_its_speed_where_the_battery_is_low() {
    for wanted in [0.1, -0.1, 0.25] {
        let speeds = run(wanted, 100, |_| 0.35);
        let (last, _) = speeds[99];
        assert!((last - wanted).abs() < 0.01 * wanted.abs(), "{last} m/s, not {wanted} m/s");
        assert!(speeds.iter().all(|(speed, _)| speed.abs() < 1.2 * wanted.abs()), "{speeds:?}");
    }
}

#[test]
fn a_wheel_that_was_held_for_long_does_not_race_when_it_is_free() {
    // Held for 5 seconds.
    let speeds = run(0.2, 600, |turn| if turn < 500 { 0.0 } else { 0.5 });
    assert!(speeds.iter().all(|(_, duty)| duty.abs() <= 1.0));
    assert_eq!(speeds[499].1, 1.0, "it pushes while it is held");
    let fastest = speeds.iter().fold(0.0_f32, |most, (speed, _)| most.max(*speed));
    assert!(fastest < 0.3, "{fastest} m/s, where 0.2 m/s were wanted");
    assert!((speeds[599].0 - 0.2).abs() < 0.004, "{:?}", speeds[599]);
}

#[test]
fn a_wheel_that_shall_stand_or_of_which_nothing_is_known_gets_no_power() {
    let mut control = SpeedControl::new(GAINS).unwrap();
    assert!(control.duty(0.2, 0.0, TURN) > 0.0);
    assert_eq!(control.duty(0.2, f32::NAN, TURN), 0.0);
    assert_eq!(control.duty(0.0, 0.1, TURN), 0.0);
    assert_eq!(control.duty(0.1, 0.1, TURN), 0.2, "what was summed up is forgotten");
}
