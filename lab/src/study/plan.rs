//! The plan of a study, courses, trainers, agents and seeds; and all its runs, in parallel on all cores.

use super::agent::Contestant;
use super::course::Course;
use super::trainer::Trainer;
use super::trainer::population::Population;
use super::trial::{CoursePlaces, Outcome, run};
use goodbot_console::{Failure, bar};
use rayon::prelude::*;

/// The plan of a study.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The courses.
    pub courses: Vec<Course>,
    /// The agents.
    pub agents: Vec<Contestant>,
    /// The trainers.
    pub trainers: Vec<Trainer>,
    /// The fitted people of the trainer `population`.
    pub population: Population,
    /// The first seed.
    pub seed: u64,
    /// The number of seeds.
    pub runs: u32,
    /// The number of seeds for the agents whose language is a program: the first ones.
    pub program_runs: u32,
}

impl Plan {
    /// The seed at a position.
    pub const fn seed_at(&self, position: u32) -> u64 {
        self.seed.wrapping_add(position as u64)
    }

    /// The agents that run with the seed at a position, with their own positions.
    pub fn agents_at(&self, position: u32) -> impl Iterator<Item = (usize, &Contestant)> + Clone {
        self.agents.iter().enumerate().filter(move |(_, agent)| position < self.runs_of(agent))
    }

    fn runs_of(&self, agent: &Contestant) -> u32 {
        if agent.program().is_some() { self.program_runs.min(self.runs) } else { self.runs }
    }

    /// The positions of courses and of the trainers that teach them.
    pub fn taught(&self) -> Vec<(usize, usize)> {
        let of_course = |course: usize| (0..self.trainers.len()).map(move |trainer| (course, trainer));
        let is_taught = |&(course, trainer): &(usize, usize)| self.courses[course].has(self.trainers[trainer].name);
        (0..self.courses.len()).flat_map(of_course).filter(is_taught).collect()
    }
}

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

/// All runs of the plan, sorted by seed, then course, then trainer, then agent.
///
/// # Errors
/// [`Failure::Result`] if a run failed.
pub fn run_all(plan: &Plan) -> Result<Vec<Run>, Failure> {
    let taught = plan.taught();
    let all = taught.len() * (0..plan.runs).map(|position| plan.agents_at(position).count()).sum::<usize>();
    let bar = bar(all, "training agents");
    let of_seed = |position: u32| -> Result<Vec<Run>, Failure> {
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
    let runs: Result<Vec<Vec<Run>>, Failure> = (0..plan.runs).into_par_iter().map(of_seed).collect();
    bar.finish_and_clear();
    Ok(runs?.into_iter().flatten().collect())
}
