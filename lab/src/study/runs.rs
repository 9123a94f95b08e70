//! All runs: each agent with each trainer on each seed, in parallel on all cores.

use super::plan::Plan;
use crate::study::course::Course;
use crate::study::trial::{CoursePlaces, Outcome, run};
use goodbot_console::messages::bar;
use goodbot_console::outcome::Failure;
use rayon::prelude::*;

/// The result of one agent with one trainer on one seed.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The seed.
    pub seed: u64,
    /// The course, by its position in the plan.
    pub course: usize,
    /// The trainer, by its position in the plan.
    pub trainer: usize,
    /// The agent, by its position in the plan.
    pub agent: usize,
    /// The outcome.
    pub outcome: Outcome,
}

/// All runs of the plan's part, sorted by seed, then course, then trainer, then agent.
///
/// # Errors
/// [`Failure::Result`] if a run failed.
pub fn run_all(plan: &Plan) -> Result<Vec<Run>, Failure> {
    let positions: Vec<u32> = plan.own_positions().collect();
    let taught = plan.taught();
    let all = taught.len() * positions.iter().map(|&position| plan.agents_at(position).count()).sum::<usize>();
    let bar = bar(all, "training agents");
    let of_seed = |&position: &u32| -> Result<Vec<Run>, Failure> {
        let seed = plan.seed_at(position);
        let failed = |who: &str, error| Failure::Result(format!("seed {seed}, {who}: {error}"));
        let places = |course: &Course| CoursePlaces::new(*course, seed).map_err(|error| failed(course.name(), error));
        let mut places = plan.courses.iter().map(places).collect::<Result<Vec<_>, _>>()?;
        let mut runs = Vec::new();
        for &(course, trainer) in &taught {
            let teaches = plan.trainers[trainer];
            let habits = teaches.habits(&plan.population, seed);
            for (agent, contestant) in plan.agents_at(position) {
                let outcome = run(&contestant.learns, habits, &mut places[course], seed);
                let outcome = outcome.map_err(|error| failed(&format!("{} with {}", contestant.name, teaches.name), error))?;
                runs.push(Run { seed, course, trainer, agent, outcome });
                bar.inc(1);
            }
        }
        Ok(runs)
    };
    let runs: Result<Vec<Vec<Run>>, Failure> = positions.par_iter().map(of_seed).collect();
    bar.finish_and_clear();
    Ok(runs?.into_iter().flatten().collect())
}
