//! What a search knows of each task.

use crate::oomdp::{Action, ActionSet, Domain};
use crate::planning::GoalTable;
use crate::task::TaskSet;

/// What is known of each task, and of which tasks nothing is known yet.
#[derive(Debug)]
pub(in crate::planning) struct Findings<'m> {
    pub(super) optimal: &'m mut [ActionSet],
    pub(super) distances: &'m mut [u32],
    /// The distance under way.
    pub(super) level: u32,
    pub(super) wanted: TaskSet,
    pub(super) unresolved: TaskSet,
    /// The tasks of which a goal was met at this distance.
    pub(super) found_now: TaskSet,
    pub(super) goal_here: TaskSet,
    pub(super) dead: TaskSet,
    pub(super) applicable: ActionSet,
    /// Tasks planned with blocks taken to stand still.
    pub(super) relaxed: TaskSet,
    pub(super) looks: u32,
}

impl<'m> Findings<'m> {
    pub(super) fn new(optimal: &'m mut [ActionSet], distances: &'m mut [u32]) -> Self {
        Self {
            optimal,
            distances,
            level: 0,
            wanted: TaskSet::EMPTY,
            unresolved: TaskSet::EMPTY,
            found_now: TaskSet::EMPTY,
            goal_here: TaskSet::EMPTY,
            dead: TaskSet::EMPTY,
            applicable: ActionSet::EMPTY,
            relaxed: TaskSet::EMPTY,
            looks: 0,
        }
    }

    /// What can be said of `state` without any search; the rest of `wanted` is unresolved.
    pub(super) fn stand<D: Domain + ?Sized>(
        &mut self,
        domain: &D,
        goals: &GoalTable<'_>,
        state: &D::State,
        wanted: TaskSet,
        dead: TaskSet,
    ) {
        self.optimal.fill(ActionSet::EMPTY);
        self.distances.fill(u32::MAX);
        (self.level, self.looks) = (0, 0);
        (self.found_now, self.relaxed) = (TaskSet::EMPTY, TaskSet::EMPTY);
        self.goal_here = goals.satisfied(domain, state).common(wanted);
        self.dead = dead.common(wanted).without(self.goal_here);
        self.wanted = wanted;
        self.unresolved = wanted.without(self.goal_here).without(self.dead);
        self.applicable = ActionSet::NOOP;
        for action in (0..domain.actions().len().min(Action::MOST)).map(|position| Action(position as u8)) {
            if domain.step(state, action).is_some() {
                self.applicable = self.applicable.with(action);
            }
        }
    }

    /// A goal of a task is at the distance under way, reached by these first actions.
    #[inline]
    pub(super) fn meet(&mut self, task: usize, first: ActionSet) {
        self.found_now = self.found_now.union(TaskSet::of(task));
        if let Some(set) = self.optimal.get_mut(task) {
            *set = set.union(first);
        }
        if let Some(distance) = self.distances.get_mut(task) {
            *distance = self.level;
        }
    }

    /// All goals at the distance under way are met.
    pub(super) fn finish_level(&mut self) {
        self.unresolved = self.unresolved.without(self.found_now);
        self.found_now = TaskSet::EMPTY;
        self.level = self.level.saturating_add(1);
    }
}
