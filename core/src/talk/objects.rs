//! The things and places of tasks: which tasks bring a thing to the same place, and which things the words fit.

use super::conversation::place_of;
use super::explained::Explained;
use crate::memory::AgentMemory;
use crate::oomdp::{Domain, GroundProposition, ObjectId};
use crate::probability::{Scaled, total};
use crate::session::Agent;
use crate::task::TaskSet;
use crate::task::grounded::is_thing;

impl<M: AgentMemory> Agent<M> {
    /// The first proposition of a task.
    fn proposition(&self, task: usize) -> Option<GroundProposition> {
        let task = self.task(task);
        task.propositions(self.lifted().get(usize::from(task.lifted))?).next()
    }

    /// The first object of a task of one proposition.
    pub(super) fn thing(&self, task: usize) -> Option<ObjectId> {
        self.proposition(task)?.arguments.first().copied()
    }

    /// The place of a task of one proposition.
    pub(super) fn goal<D: Domain>(&self, domain: &D, task: usize) -> Option<ObjectId> {
        place_of(domain, &self.proposition(task)?)
    }

    /// The kind of a task about one thing and its place, and this place.
    pub(super) fn place_of_thing<D: Domain>(&self, domain: &D, task: usize) -> Option<(u8, ObjectId)> {
        let kind = self.task(task).lifted;
        let lifted = self.lifted.get(usize::from(kind))?;
        let is_about_thing = !lifted.has_way() && lifted.propositions().len() == 1 && is_thing(&domain.world(), self.thing(task)?);
        Some((kind, self.goal(domain, task).filter(|_| is_about_thing)?))
    }

    /// The tasks that bring all fitting things to one place, and the probability of that place.
    pub(super) fn all_that_fit<D: Domain>(&self, domain: &D, explained: &Explained) -> (TaskSet, f32) {
        let place = |task: usize| self.place_of_thing(domain, task);
        let weigh = |tasks: TaskSet| total(tasks.iter().map(|task| explained.weights.get(task).copied().unwrap_or(Scaled::ZERO)));
        let of_things: TaskSet = (0..self.task_count).filter(|&task| place(task).is_some()).collect();
        let Some(likeliest) = explained.likeliest(of_things.common(explained.fitting)) else { return (TaskSet::EMPTY, 0.0) };
        let there: TaskSet = of_things.iter().filter(|&task| place(task) == place(likeliest)).collect();
        (there.common(explained.fitting), weigh(there).over(weigh(of_things)))
    }
}
