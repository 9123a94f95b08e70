//! What a study compares: which agents, which trainers, which seeds.

use super::shard::Shard;
use crate::study::agent::Contestant;
use crate::study::trainer::Trainer;
use crate::study::trainer::population::Population;

/// What a study compares.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The agents.
    pub agents: Vec<Contestant>,
    /// The trainers.
    pub trainers: Vec<Trainer>,
    /// The people that the trainer `population` is drawn from.
    pub population: Population,
    /// The first seed.
    pub seed: u64,
    /// How many seeds.
    pub runs: u32,
    /// Which of them are run here.
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

    /// How many runs there are, of all seeds.
    pub fn all_runs(&self) -> usize {
        self.runs as usize * self.trainers.len() * self.agents.len()
    }
}
