//! What a search found.

use super::{OptimalSet, Search};
use crate::oomdp::ActionSet;
use crate::task::TaskSet;

impl Search<'_> {
    /// Whether it has come to its end.
    pub fn is_done(&self) -> bool {
        !self.running
    }

    /// What it found for a task. Meaningful when it is done.
    pub fn optimal(&self, task: usize) -> OptimalSet {
        if self.found.goal_here.contains(task) {
            OptimalSet::Goal
        } else if self.found.dead.contains(task) {
            OptimalSet::DeadEnd(self.found.applicable)
        } else if self.found.unresolved.contains(task) || !self.found.wanted.contains(task) {
            OptimalSet::Unknown
        } else {
            self.found.optimal.get(task).map_or(OptimalSet::Unknown, |&set| OptimalSet::Toward(set))
        }
    }

    /// The cost of a shortest way to a task's goal; `None` where there is none or it is unknown.
    pub fn distance(&self, task: usize) -> Option<u32> {
        match self.optimal(task) {
            OptimalSet::Goal => Some(0),
            OptimalSet::Toward(_) => self.found.distances.get(task).copied(),
            OptimalSet::DeadEnd(_) | OptimalSet::Unknown => None,
        }
    }

    /// The tasks whose goals cannot be reached from here, nor from anywhere later.
    pub fn dead(&self) -> TaskSet {
        self.found.dead
    }

    /// The tasks of which nothing is known, because the search was bounded.
    pub fn unknown(&self) -> TaskSet {
        self.found.unresolved
    }

    /// The tasks that were planned with the blocks that do not matter to them taken to stand still, because the joint state space is out
    /// of reach: their optimal sets and distances are approximate. Where a task was planned for region by region, the distance is that to
    /// where this part of the way ends.
    pub fn relaxed(&self) -> TaskSet {
        self.found.relaxed
    }

    /// The actions that can be done here, doing nothing included.
    pub fn applicable(&self) -> ActionSet {
        self.found.applicable
    }

    /// How often it looked: at one state, or at a word of the states of a row at one distance, or at one action that leaves a row.
    pub fn looks(&self) -> u32 {
        self.found.looks
    }
}
