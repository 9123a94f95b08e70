//! How the settings of the others were chosen: by one rule for all, on seeds that are not reported.
//!
//! Each setting of a grid goes through the course with four trainers on [`SEEDS`]. The one with the highest [`score`] is taken: the share of
//! tests that are right, less the share of the allowed steps that a lesson takes.

use crate::study::agent::Learns;
use crate::study::trainer::TRAINERS;
use crate::study::trainer::population::Population;
use crate::study::trial::{Ending, MOST_STEPS, homes, run};
use goodbot_course::CourseError;
use std::ops::Range;

/// The seeds: far from those that are reported.
pub const SEEDS: Range<u64> = 9_000_000..9_000_016;
/// The trainers.
pub const TRAINED_BY: [&str; 4] = ["balanced", "punish-only", "reward-only", "population"];

/// How well a setting does, from -1 to 1.
///
/// # Errors
/// [`CourseError`].
pub fn score(learns: &Learns) -> Result<f64, CourseError> {
    let population = Population::fitted();
    let trainers = || TRAINERS.iter().filter(|trainer| TRAINED_BY.contains(&trainer.name));
    let (mut sum, mut count) = (0.0, 0.0);
    for seed in SEEDS {
        let homes = homes(seed);
        for trainer in trainers() {
            let outcome = run(learns, trainer.habits(&population, seed), &homes, seed)?;
            let steps = outcome.lessons.iter().map(|lesson| if lesson.ending == Ending::Goal { lesson.steps } else { MOST_STEPS });
            let steps: f64 = steps.map(f64::from).sum::<f64>() / outcome.lessons.len() as f64;
            sum += outcome.tests_right() as f64 / outcome.tests.len() as f64 - steps / f64::from(MOST_STEPS);
            count += 1.0;
        }
    }
    Ok(sum / count)
}
