//! One run for each seed, as many at a time as the machine has cores.

use super::lexicon::Lexicon;
use crate::cli::{Layouts, PaperOptions, WeightsChoice};
use crate::outcome::Failure;
use goodbot::{Agent, Capacities, HeapMemory, Options, home, session::Weights};
use goodbot_course::{CourseError, Homes, Observer, Results, generator, run_course};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;

/// What came of one seed.
#[derive(Debug)]
pub struct Run {
    /// The seed.
    pub seed: u64,
    /// Lessons and tests.
    pub results: Results,
    /// What was learned.
    pub lexicon: Lexicon,
}

/// The whole course fits a controller's memory.
const CAPACITIES: Capacities = Capacities::SMALL;

/// One run.
///
/// # Errors
/// [`Failure::Result`].
pub fn run_seed(options: &PaperOptions, seed: u64, observer: &mut impl Observer) -> Result<Run, Failure> {
    attempt(options, seed, observer).map_err(|error| Failure::Result(format!("seed {seed}: {error}")))
}

fn attempt(options: &PaperOptions, seed: u64, observer: &mut impl Observer) -> Result<Run, CourseError> {
    let weights = match options.weights {
        WeightsChoice::Paper => Weights::Paper,
        WeightsChoice::Belief => Weights::Belief,
    };
    let mut memory = HeapMemory::new(&CAPACITIES);
    let lifted = home::paper_tasks().map_err(|_| CourseError::NotPosed)?;
    let mut agent = Agent::new(&mut memory.agent, &lifted, Options { weights, ..options.model.options() }).map_err(CourseError::Agent)?;
    let mut random = generator(seed);
    let homes = match options.homes() {
        Layouts::Fixed => Homes::FIXED,
        Layouts::Random => Homes::random(&mut random, &mut memory.home),
    };
    let results = run_course(&mut agent, &mut memory.home, &homes, options.trainer.strategy, &mut random, observer)?;
    Ok(Run { seed, results, lexicon: Lexicon::of(agent.language()) })
}

/// All runs, in the order of their seeds.
///
/// # Errors
/// [`Failure::Result`] where a run failed.
pub fn run_all(options: &PaperOptions) -> Result<Vec<Run>, Failure> {
    let count = options.runs;
    let bar = if count > 1 { ProgressBar::new(u64::from(count)) } else { ProgressBar::hidden() };
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos} of {len} agents trained, {eta} left") {
        bar.set_style(style);
    }
    let runs = (0..count)
        .into_par_iter()
        .map(|number| {
            let run = run_seed(options, options.seed.wrapping_add(u64::from(number)), &mut ());
            bar.inc(1);
            run
        })
        .collect();
    bar.finish_and_clear();
    runs
}
