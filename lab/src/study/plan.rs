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
    /// The part of the seeds that is run here.
    pub shard: Shard,
}

impl Plan {
    /// The seed at a position.
    pub const fn seed_at(&self, position: u32) -> u64 {
        self.seed.wrapping_add(position as u64)
    }

    /// The seeds that are run here, in order.
    pub fn own_seeds(&self) -> impl Iterator<Item = u64> + '_ {
        (0..self.runs).filter(|&position| self.shard.has(position)).map(|position| self.seed_at(position))
    }

    /// The positions of courses and of the trainers that teach them.
    pub fn taught(&self) -> Vec<(usize, usize)> {
        let of_course = |course: usize| (0..self.trainers.len()).map(move |trainer| (course, trainer));
        let is_taught = |&(course, trainer): &(usize, usize)| self.courses[course].has(self.trainers[trainer].name);
        (0..self.courses.len()).flat_map(of_course).filter(is_taught).collect()
    }

    /// The number of runs for all seeds.
    pub fn all_runs(&self) -> usize {
        self.runs as usize * self.taught().len() * self.agents.len()
    }
}
