//! Runs the course once for each seed, in parallel on all cores; and what the paper reports of its one agent.

use super::options::{Layouts, PaperOptions};
use crate::words::Lexicon;
use goodbot::memory::HomeHeap;
use goodbot::{Agent, Capacities, HeapMemory, Options, home};
use goodbot_console::{Failure, bar, typed};
use goodbot_course::{CourseError, CourseTrainer, Homes, LESSONS, Observer, Results, generator, run_course};
use indicatif::ProgressBar;
use rayon::prelude::*;

/// The result of one seed.
#[derive(Debug)]
pub struct Run {
    /// The seed.
    pub seed: u64,
    /// The results of lessons and tests.
    pub results: Results,
    /// The translations that the paper reports.
    pub reported: [f32; REPORTED.len()],
}

/// The whole course fits into a controller's memory.
const CAPACITIES: Capacities = Capacities::SMALL;

/// One run.
///
/// # Errors
/// [`Failure::Result`].
pub fn run_seed(options: &PaperOptions, seed: u64, observer: &mut impl Observer) -> Result<(Run, Lexicon), Failure> {
    attempt(options, seed, observer).map_err(|error| Failure::Result(format!("seed {seed}: {error}")))
}

fn attempt(options: &PaperOptions, seed: u64, observer: &mut impl Observer) -> Result<(Run, Lexicon), CourseError> {
    let lifted = home::paper_tasks().map_err(|_| CourseError::NotPosed)?;
    let options_of_agent = Options { weights: options.weights.into(), telling: false, ..options.learner.options() };
    let agent = typed::memory(&CAPACITIES, &options_of_agent.language, CAPACITIES.pairs);
    let mut memory = HeapMemory { home: HomeHeap::new(&CAPACITIES), agent };
    let mut agent = Agent::new(&mut memory.agent, &lifted, options_of_agent).map_err(CourseError::Agent)?;
    let mut random = generator(seed);
    let homes = match options.homes() {
        Layouts::Fixed => Homes::FIXED,
        Layouts::Random => Homes::random(&mut random, &mut memory.home),
    };
    let (trainer, believed) = (options.trainer.trainer, options.believed().trainer.strategy);
    let results = run_course(&mut agent, &mut memory.home, &homes, &trainer, believed, &mut random, observer)?;
    let lexicon = Lexicon::of(agent.language());
    Ok((
        Run {
            seed,
            results,
            reported: REPORTED.map(|(token, value, word)| lexicon.translation(token, word).max(lexicon.translation(value, word))),
        },
        lexicon,
    ))
}

/// All runs, in the order of their seeds.
///
/// # Errors
/// [`Failure::Result`] if a run failed.
pub fn run_all(options: &PaperOptions) -> Result<Vec<Run>, Failure> {
    let count = options.runs;
    let bar = if count > 1 { bar(count as usize, "training agents") } else { ProgressBar::hidden() };
    let runs = (0..count)
        .into_par_iter()
        .map(|number| {
            let run = run_seed(options, options.seed.wrapping_add(u64::from(number)), &mut ());
            bar.inc(1);
            run.map(|(run, _)| run)
        })
        .collect();
    bar.finish_and_clear();
    runs
}

/// The translations that the paper reports, and one that separates go from take: the machine token of Model 2, the value of the role model,
/// the word.
pub const REPORTED: [(&str, &str, &str); 4] = [
    ("agentInRoom", "agentInRoom", "go"),
    ("shapeBag", "shapeBag", "bag"),
    ("roomIsRed", "colorRed", "red"),
    ("blockInRoom", "blockInRoom", "take"),
];

/// The paper's results for its agent, which one trainer taught (section 5).
#[derive(Clone, Copy, Debug)]
pub struct Reported {
    /// How many of the five tests were right.
    pub tests: usize,
    /// Which lessons needed no correction.
    pub lessons: Option<[bool; LESSONS.len()]>,
    /// The translations of [`REPORTED`].
    pub translations: Option<[f64; REPORTED.len()]>,
}

/// The results with the first trainer.
pub const PAPER_BALANCED: Reported =
    Reported { tests: 5, lessons: Some([false, true, false, false, true, true, true]), translations: Some([0.51, 0.32, 0.33, 0.33]) };
/// The results with the second trainer, who was only allowed to punish.
pub const PAPER_PUNISH_ONLY: Reported = Reported { tests: 4, lessons: None, translations: None };

impl PaperOptions {
    /// The paper's results for this trainer, if the agent expects the same strategy, as in the paper.
    pub fn reported_by_paper(&self) -> Option<Reported> {
        let as_in_paper = self.believed().trainer.strategy == self.trainer.trainer.strategy;
        let known = [(CourseTrainer::BALANCED, PAPER_BALANCED), (CourseTrainer::PUNISH_ONLY, PAPER_PUNISH_ONLY)];
        known.into_iter().find(|(trainer, _)| as_in_paper && *trainer == self.trainer.trainer).map(|(_, reported)| reported)
    }
}
