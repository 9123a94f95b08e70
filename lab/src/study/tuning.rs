//! How the settings of the other methods were chosen: by one rule for all, on seeds that are not reported.
//!
//! Each setting of a grid goes through the paper's course with four trainers on [`SEEDS`]. The setting with the highest of the [`scores`]
//! is chosen: the share of right tests, minus the share of the allowed steps that a lesson takes.

use crate::study::agent::Learns;
use crate::study::course::Course;
use crate::study::fault::StudyError;
use crate::study::trainer::TRAINERS;
use crate::study::trainer::population::Population;
use crate::study::trial::{CoursePlaces, MOST_STEPS, run};
use rayon::prelude::*;
use std::ops::Range;

/// The seeds, far from those that are reported.
pub const SEEDS: Range<u64> = 9_000_000..9_000_016;
/// The trainers.
pub const TRAINED_BY: [&str; 4] = ["balanced", "punish-only", "reward-only", "population"];
/// The agents whose settings were chosen: an inference with the role model, and the language with SABL. The other agents use the same
/// settings.
pub const TUNED: [&str; 4] = ["tamer+roles", "coach+roles", "shaping+roles", "sabl+loglinear"];

/// The scores of settings, from -1 to 1.
///
/// # Errors
/// [`StudyError`].
pub fn scores(grid: &[Learns]) -> Result<Vec<f64>, StudyError> {
    let population = Population::fitted();
    let of_seed = |seed: u64| -> Result<Vec<f64>, StudyError> {
        let mut places = CoursePlaces::new(Course::Paper, seed)?;
        let mut scores = vec![0.0; grid.len()];
        for (learns, score) in grid.iter().zip(&mut scores) {
            for trainer in TRAINERS.iter().filter(|trainer| TRAINED_BY.contains(&trainer.name)) {
                let outcome = run(learns, trainer.habits(&population, seed), &mut places, seed)?;
                let steps = outcome.steps().map(f64::from).sum::<f64>() / outcome.lessons.len() as f64;
                *score += outcome.tests_right() as f64 / outcome.tests.len() as f64 - steps / f64::from(MOST_STEPS);
            }
        }
        Ok(scores)
    };
    let seeds = SEEDS.into_par_iter().map(of_seed).collect::<Result<Vec<_>, _>>()?;
    let count = (seeds.len() * TRAINED_BY.len()) as f64;
    Ok((0..grid.len()).map(|at| seeds.iter().map(|scores| scores[at]).sum::<f64>() / count).collect())
}
