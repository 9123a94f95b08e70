//! How the settings of the other methods were chosen: by one rule for all, on seeds that are not reported.
//!
//! Each setting of a grid goes through the paper's course with four trainers on [`SEEDS`]. The setting with the highest of the [`scores`]
//! is chosen: the share of right tests, minus the share of the allowed steps that a lesson takes.

use super::agent::{AGENTS, Learns};
use super::course::Course;
use super::trainer::TRAINERS;
use super::trainer::population::Population;
use super::trial::{CoursePlaces, MOST_STEPS, StudyError, run};
use goodbot_console::Failure;
use rayon::prelude::*;
use std::io::Write;
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

/// How many settings are printed for each agent.
const TOLD: usize = 3;

/// Tries the settings and prints the best.
///
/// # Errors
/// [`Failure::Result`] if a run failed.
pub fn show(out: &mut impl Write) -> Result<(), Failure> {
    let (last, trainers) = (SEEDS.end - 1, TRAINED_BY.join(", "));
    writeln!(
        out,
        "Score: share of tests right, less steps a lesson / {MOST_STEPS}; seeds {} to {last}, trainers {trainers}.",
        SEEDS.start
    )?;
    for agent in AGENTS.iter().filter(|agent| TUNED.contains(&agent.name)) {
        let grid = agent.learns.grid();
        let scores = scores(&grid).map_err(|error| Failure::Result(format!("{}: {error}", agent.name)))?;
        let mut scored: Vec<_> = grid.into_iter().zip(scores).collect();
        // The first of equals in the grid comes first.
        scored.sort_by(|a, b| b.1.total_cmp(&a.1));
        writeln!(out, "\n{}: the best of {}", agent.name, scored.len())?;
        for (learns, score) in scored.iter().take(TOLD) {
            writeln!(out, "  {score:>7.4}  {learns}{}", if *learns == agent.learns { "  (taken)" } else { "" })?;
        }
    }
    Ok(())
}
