//! What planning tells about each task in one state, and how an action is judged by it.

use crate::oomdp::{Action, ActionSet, Domain, apply, own_actions};
use crate::planning::goals::Goals;
use crate::task::TaskSet;

/// How an action relates to a task's optimal set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Judgement {
    /// The action is in the optimal set.
    Correct,
    /// It is not.
    Incorrect,
    /// The optimal set is not known exactly.
    Unknown,
}

/// What planning tells about one task in one state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum OptimalSet {
    /// The task holds: only doing nothing is right.
    Goal,
    /// Exactly these actions begin a shortest way to the goal.
    Toward(ActionSet),
    /// No goal can be reached any more: every action that can be done, and doing nothing, are equally right.
    DeadEnd(ActionSet),
    /// These actions lead to the goal in a smaller state space, in which some pieces stay where they are. They serve to act, but not as
    /// evidence: a shorter way may exist.
    Approximate(ActionSet),
    /// The search was bounded before it found out, or the task is so improbable that it was not planned for.
    Unknown,
}

impl OptimalSet {
    /// The optimal set, `None` where it is not known exactly.
    pub const fn exact(self) -> Option<ActionSet> {
        match self {
            Self::Goal => Some(ActionSet::NOOP),
            Self::Toward(actions) | Self::DeadEnd(actions) => Some(actions),
            Self::Approximate(_) | Self::Unknown => None,
        }
    }

    /// The actions that lead on to the goal, exact or not; `None` at the goal and where no way is known.
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

/// What a planner has found out so far, beside the tables.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Found {
    /// The distance under way.
    pub(super) level: u32,
    /// The tasks planned for.
    pub(super) wanted: TaskSet,
    /// The tasks of which nothing is known yet.
    pub(super) unknown: TaskSet,
    /// The tasks that the search under way looks for.
    pub(super) sought: TaskSet,
    /// The tasks of which a goal was met at this distance.
    pub(super) met: TaskSet,
    pub(super) goal_here: TaskSet,
    pub(super) dead: TaskSet,
    pub(super) approximate: TaskSet,
    pub(super) applicable: ActionSet,
    pub(super) expansions: u32,
}

impl Found {
    /// Nothing is known.
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

    /// What can be said of `state` without a search. The tasks in `with_ways` have still a way to go.
    pub(super) fn at<D: Domain + ?Sized>(
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

    /// These tasks are dead ends.
    pub(super) fn rule_out(&mut self, tasks: TaskSet) {
        self.dead = self.dead.union(tasks);
        self.unknown = self.unknown.without(tasks);
        self.sought = self.sought.without(tasks);
    }
}

/// What a running search writes: what was found, and the tables of optimal sets and distances.
pub(super) struct Results<'t> {
    pub(super) found: &'t mut Found,
    pub(super) optimal: &'t mut [ActionSet],
    pub(super) distances: &'t mut [u32],
}

impl Results<'_> {
    /// Takes note of a goal of a task at the distance under way, reached by these first actions.
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

    /// All goals at the distance under way are met.
    pub(super) fn end_level(&mut self) {
        let found = &mut *self.found;
        found.sought = found.sought.without(found.met);
        found.unknown = found.unknown.without(found.met);
        found.met = TaskSet::EMPTY;
        found.level = found.level.saturating_add(1);
    }
}

/// What is known of each task in the state that was planned for. Complete once planning is done.
#[derive(Clone, Copy, Debug)]
pub struct Plan<'t> {
    pub(super) found: &'t Found,
    pub(super) optimal: &'t [ActionSet],
    pub(super) distances: &'t [u32],
}

impl Plan<'_> {
    /// What is known of a task.
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

    /// The cost of a shortest way to a task's goal; `None` where there is none or it is unknown. For an approximate plan this is the cost
    /// of the way found, or of its first part.
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

    /// The tasks for which an action is judged so.
    pub fn judged(&self, action: Action, judgement: Judgement) -> TaskSet {
        self.found.wanted.iter().filter(|&task| self.judge(task, action) == judgement).fold(TaskSet::EMPTY, TaskSet::with)
    }

    /// The tasks whose goals cannot be reached from here, nor from any later state.
    pub fn dead(&self) -> TaskSet {
        self.found.dead
    }

    /// The tasks of which nothing is known, because the search was bounded.
    pub fn unknown(&self) -> TaskSet {
        self.found.unknown
    }

    /// The tasks whose sets are approximate.
    pub fn approximate(&self) -> TaskSet {
        self.found.approximate
    }

    /// The actions that can be done here, doing nothing included.
    pub fn applicable(&self) -> ActionSet {
        self.found.applicable
    }

    /// The node expansions that planning took: one for a state; for the states of a row at one distance, one for each word of the row; and
    /// one for each action that moves a piece.
    pub fn expansions(&self) -> u32 {
        self.found.expansions
    }
}
