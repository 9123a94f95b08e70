//! Medians, and ratios of medians taken in turn.

use std::time::{Duration, Instant};

/// The number of runs of each side of a comparison.
pub const ROUNDS: usize = 9;

/// The time of one run.
pub fn time(work: &mut dyn FnMut()) -> Duration {
    let start = Instant::now();
    work();
    start.elapsed()
}

/// The median.
pub fn median(mut times: Vec<Duration>) -> Duration {
    times.sort_unstable();
    times.get(times.len() / 2).copied().unwrap_or_default()
}

/// The median times of two pieces of work that run in turn, so that other load of the machine slows both.
pub fn in_turn(a: &mut dyn FnMut(), b: &mut dyn FnMut()) -> (Duration, Duration) {
    let (mut times_a, mut times_b) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        times_a.push(time(a));
        times_b.push(time(b));
    }
    (median(times_a), median(times_b))
}

/// The first time divided by the second.
pub fn ratio((a, b): (Duration, Duration)) -> f64 {
    a.as_secs_f64() / b.as_secs_f64().max(1e-9)
}
