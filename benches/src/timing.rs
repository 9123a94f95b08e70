//! Medians, and ratios of medians taken in turn.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// The number of runs of each side of a comparison.
pub const ROUNDS: usize = 9;

/// The time of one run.
pub fn time<R>(mut work: impl FnMut() -> R) -> Duration {
    let start = Instant::now();
    drop(black_box(work()));
    start.elapsed()
}

/// The median.
pub fn median(mut times: Vec<Duration>) -> Duration {
    times.sort_unstable();
    times.get(times.len() / 2).copied().unwrap_or_default()
}

/// The median times of two pieces of work that run in turn, so that other load of the machine slows both.
pub fn in_turn<A, B>(mut a: impl FnMut() -> A, mut b: impl FnMut() -> B) -> (Duration, Duration) {
    let (mut times_a, mut times_b) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        times_a.push(time(&mut a));
        times_b.push(time(&mut b));
    }
    (median(times_a), median(times_b))
}

/// The first time divided by the second.
pub fn ratio((a, b): (Duration, Duration)) -> f64 {
    a.as_secs_f64() / b.as_secs_f64().max(1e-9)
}
