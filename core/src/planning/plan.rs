//! The result of planning for each task in one state, and how it judges an action.

use crate::oomdp::{Action, ActionSet, Domain, apply, own_actions};
use crate::planning::goals::Goals;
use crate::task::TaskSet;

/// How an action relates to a task's optimal set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Judgement {
    /// The action is in the optimal set.
    Correct,
    /// It is not.
    Incorrect,
    /// The optimal set is not known exactly.
    Unknown,
}

/// The result of planning for one task in one state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OptimalSet {
    /// The task holds: only doing nothing is right.
    Goal,
    /// Exactly these actions begin a shortest way to the goal.
    Toward(ActionSet),
    /// The goal is unreachable: every possible action, and doing nothing, are equally right.
    DeadEnd(ActionSet),
    /// These actions lead to the goal in a smaller state space, with some pieces frozen. The robot acts on them, but they are no evidence:
    /// a shorter path may exist.
    Approximate(ActionSet),
    /// The search reached its limit first, or the task was too improbable to plan for.
    Unknown,
}

impl OptimalSet {
    /// The optimal set, `None` if it is not known exactly.
    pub const fn exact(self) -> Option<ActionSet> {
        match self {
            Self::Goal => Some(ActionSet::NOOP),
            Self::Toward(actions) | Self::DeadEnd(actions) => Some(actions),
            Self::Approximate(_) | Self::Unknown => None,
        }
    }

    /// Its name in output.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Goal => "goal",
            Self::Toward(_) => "toward",
            Self::DeadEnd(_) => "dead end",
            Self::Approximate(_) => "approximate",
            Self::Unknown => "unknown",
        }
    }

    /// The actions that lead towards the goal, exact or not; `None` at the goal and if no plan is known.
    pub const fn onward(self) -> Option<ActionSet> {
        match self {
            Self::Toward(actions) | Self::Approximate(actions) => Some(actions),
            Self::Goal | Self::DeadEnd(_) | Self::Unknown => None,
        }
    }

    /// Judges an action: only an exact set is evidence.
    pub const fn judge(self, action: Action) -> Judgement {
        match self.exact() {
            Some(actions) if actions.contains(action) => Judgement::Correct,
            Some(_) => Judgement::Incorrect,
            None => Judgement::Unknown,
        }
    }
}

/// The progress of a plan, beside the tables.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Found {
    /// The current distance.
    pub(super) level: u32,
    /// The tasks planned for.
    pub(super) wanted: TaskSet,
    /// The tasks without a result yet.
    pub(super) unknown: TaskSet,
    /// The tasks that the current search looks for.
    pub(super) sought: TaskSet,
    /// The tasks with a goal met at this distance.
    pub(super) met: TaskSet,
    pub(super) goal_here: TaskSet,
    pub(super) dead: TaskSet,
    pub(super) approximate: TaskSet,
    pub(super) applicable: ActionSet,
    pub(super) expansions: u32,
}

impl Found {
    /// No results yet.
    pub(super) const NOTHING: Self = Self {
        level: 0,
        wanted: TaskSet::EMPTY,
        unknown: TaskSet::EMPTY,
        sought: TaskSet::EMPTY,
        met: TaskSet::EMPTY,
        goal_here: TaskSet::EMPTY,
        dead: TaskSet::EMPTY,
        approximate: TaskSet::EMPTY,
        applicable: ActionSet::EMPTY,
        expansions: 0,
    };

    /// The results for `state` that need no search. The tasks in `with_ways` have unfinished ways.
    pub(super) fn at<D: Domain>(
        domain: &D,
        goals: &Goals<'_>,
        state: &D::State,
        wanted: TaskSet,
        dead: TaskSet,
        with_ways: TaskSet,
    ) -> Self {
        let goal_here = goals.satisfied(domain, state, wanted.without(with_ways));
        let dead = dead.common(wanted).without(goal_here);
        let applicable = own_actions(domain).filter(|&action| apply(domain, state, action).is_some());
        Self {
            wanted,
            unknown: wanted.without(goal_here).without(dead),
            goal_here,
            dead,
            applicable: applicable.fold(ActionSet::NOOP, ActionSet::with),
            ..Self::NOTHING
        }
    }

    /// Marks these tasks as dead ends.
    pub(super) fn rule_out(&mut self, tasks: TaskSet) {
        self.dead = self.dead.union(tasks);
        self.unknown = self.unknown.without(tasks);
        self.sought = self.sought.without(tasks);
    }
}

/// The outputs of a running search: its progress, and the tables of optimal sets and distances.
pub(super) struct Results<'t> {
    pub(super) found: &'t mut Found,
    pub(super) optimal: &'t mut [ActionSet],
    pub(super) distances: &'t mut [u32],
}

impl Results<'_> {
    /// Records a goal of a task at the current distance, reached by these first actions.
    #[inline]
    pub(super) fn meet(&mut self, task: usize, first: ActionSet) {
        self.found.met = self.found.met.union(TaskSet::of(task));
        if let Some(set) = self.optimal.get_mut(task) {
            *set = set.union(first);
        }
        if let Some(distance) = self.distances.get_mut(task) {
            *distance = self.found.level;
        }
    }

    /// Ends the current distance, after all goals at it are met.
    pub(super) fn end_level(&mut self) {
        let found = &mut *self.found;
        found.sought = found.sought.without(found.met);
        found.unknown = found.unknown.without(found.met);
        found.met = TaskSet::EMPTY;
        found.level = found.level.saturating_add(1);
    }
}

/// The results for each task in the planned state. Complete once planning is done.
#[derive(Clone, Copy, Debug)]
pub struct Plan<'t> {
    pub(super) found: &'t Found,
    pub(super) optimal: &'t [ActionSet],
    pub(super) distances: &'t [u32],
}

impl Plan<'_> {
    /// The result for a task.
    pub fn optimal(&self, task: usize) -> OptimalSet {
        let found = self.found;
        if found.goal_here.contains(task) {
            OptimalSet::Goal
        } else if found.dead.contains(task) {
            OptimalSet::DeadEnd(found.applicable)
        } else if found.unknown.contains(task) || !found.wanted.contains(task) {
            OptimalSet::Unknown
        } else {
            let kind = if found.approximate.contains(task) { OptimalSet::Approximate } else { OptimalSet::Toward };
            self.optimal.get(task).map_or(OptimalSet::Unknown, |&set| kind(set))
        }
    }

    /// The cost of a shortest path to a task's goal; `None` if there is none or it is unknown. For an approximate plan this is the cost of
    /// the path found, or of its first part.
    pub fn distance(&self, task: usize) -> Option<u32> {
        match self.optimal(task) {
            OptimalSet::Goal => Some(0),
            OptimalSet::Toward(_) | OptimalSet::Approximate(_) => self.distances.get(task).copied(),
            OptimalSet::DeadEnd(_) | OptimalSet::Unknown => None,
        }
    }

    /// Judges an action for a task: the only rule by which actions become evidence.
    pub fn judge(&self, task: usize, action: Action) -> Judgement {
        self.optimal(task).judge(action)
    }

    /// The tasks for which an action has this judgement.
    pub fn judged(&self, action: Action, judgement: Judgement) -> TaskSet {
        self.found.wanted.iter().filter(|&task| self.judge(task, action) == judgement).fold(TaskSet::EMPTY, TaskSet::with)
    }

    /// The tasks whose goals hold here.
    pub fn at_goal(&self) -> TaskSet {
        self.found.goal_here
    }

    /// The tasks whose goals cannot be reached from here, nor from any later state.
    pub fn dead(&self) -> TaskSet {
        self.found.dead
    }

    /// The tasks with an unknown result, because the search reached its limit.
    pub fn unknown(&self) -> TaskSet {
        self.found.unknown
    }

    /// The tasks with approximate sets.
    pub fn approximate(&self) -> TaskSet {
        self.found.approximate
    }

    /// The actions that can be done here, doing nothing included.
    pub fn applicable(&self) -> ActionSet {
        self.found.applicable
    }

    /// The node expansions of planning: one for a state; for the states of a row at one distance, one for each word of the row; and one for
    /// each action that moves a piece.
    pub fn expansions(&self) -> u32 {
        self.found.expansions
    }
}
