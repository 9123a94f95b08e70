//! The plan of a study: courses, trainers, agents and seeds.

use super::shard::Shard;
use crate::study::agent::Contestant;
use crate::study::course::Course;
use crate::study::trainer::Trainer;
use crate::study::trainer::population::Population;

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
    /// The part of the seeds that is run here.
    pub shard: Shard,
}

impl Plan {
    /// The seed at a position.
    pub const fn seed_at(&self, position: u32) -> u64 {
        self.seed.wrapping_add(position as u64)
    }

    /// The positions of the seeds that are run here, in order.
    pub fn own_positions(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.runs).filter(|&position| self.shard.has(position))
    }

    /// The agents that run with the seed at a position, with their own positions.
    pub fn agents_at(&self, position: u32) -> impl Iterator<Item = (usize, &Contestant)> + Clone {
        self.agents.iter().enumerate().filter(move |(_, agent)| position < self.runs_of(agent))
    }

    fn runs_of(&self, agent: &Contestant) -> u32 {
        if agent.program().is_some() { self.program_runs.min(self.runs) } else { self.runs }
    }

    /// The number of runs for all seeds.
    pub fn all_runs(&self) -> u64 {
        let of_agents: u64 = self.agents.iter().map(|agent| u64::from(self.runs_of(agent))).sum();
        of_agents * self.taught().len() as u64
    }

    /// The positions of courses and of the trainers that teach them.
    pub fn taught(&self) -> Vec<(usize, usize)> {
        let of_course = |course: usize| (0..self.trainers.len()).map(move |trainer| (course, trainer));
        let is_taught = |&(course, trainer): &(usize, usize)| self.courses[course].has(self.trainers[trainer].name);
        (0..self.courses.len()).flat_map(of_course).filter(is_taught).collect()
    }
}
