//! All runs: each agent with each trainer on each seed, as many at a time as the machine has cores.

use super::plan::Plan;
use crate::study::trial::{Outcome, homes, run};
use goodbot_console::messages::bar;
use goodbot_console::outcome::Failure;
use rayon::prelude::*;

/// What one agent came to with one trainer on one seed.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The seed.
    pub seed: u64,
    /// The trainer, by its position in the plan.
    pub trainer: usize,
    /// The agent, by its position in the plan.
    pub agent: usize,
    /// What it came to.
    pub outcome: Outcome,
}

/// All runs of the plan's part, by seed, then trainer, then agent.
///
/// # Errors
/// [`Failure::Result`] where a run failed.
pub fn run_all(plan: &Plan) -> Result<Vec<Run>, Failure> {
    let seeds: Vec<u64> = plan.own_seeds().collect();
    let each = plan.trainers.len() * plan.agents.len();
    let bar = bar(seeds.len() * each, "training agents");
    let of_seed = |&seed: &u64| -> Result<Vec<Run>, Failure> {
        let homes = homes(seed);
        let mut runs = Vec::with_capacity(each);
        for (trainer, teaches) in plan.trainers.iter().enumerate() {
            let habits = teaches.habits(&plan.population, seed);
            for (agent, contestant) in plan.agents.iter().enumerate() {
                let failed = |error| Failure::Result(format!("seed {seed}, {} with {}: {error}", contestant.name, teaches.name));
                let outcome = run(&contestant.learns, habits, &homes, seed).map_err(failed)?;
                runs.push(Run { seed, trainer, agent, outcome });
                bar.inc(1);
            }
        }
        Ok(runs)
    };
    let runs: Result<Vec<Vec<Run>>, Failure> = seeds.par_iter().map(of_seed).collect();
    bar.finish_and_clear();
    Ok(runs?.into_iter().flatten().collect())
}
