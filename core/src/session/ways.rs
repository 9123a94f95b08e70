//! The progress of each task's way.

use super::agent::Agent;
use crate::memory::AgentMemory;
use crate::oomdp::Domain;
use crate::task::{LiftedTask, Way};

impl<M: AgentMemory> Agent<M> {
    /// Advances every task's way: the robot has reached this state.
    pub(super) fn follow_ways<D: Domain>(&mut self, domain: &D, state: &D::State) {
        if !self.lifted.iter().any(LiftedTask::has_way) {
            return;
        }
        let session = self.memory.lend().session;
        for task in session.tasks.iter_mut().take(self.task_count) {
            let Some(lifted) = self.lifted.get(usize::from(task.lifted)) else { continue };
            task.way = Way::of(task, lifted).advance(task.way, |part| domain.holds(part, state));
        }
    }

    /// Resets every task's way: the session begins again from its first state.
    pub(super) fn begin_ways(&mut self) {
        for task in self.memory.lend().session.tasks.iter_mut().take(self.task_count) {
            task.way = task.way.at_start();
        }
    }
}
