//! The last actions that were done, each judged for every task: a word about them may come while the next plan is being made, or one or
//! two actions later.

use crate::feedback::{LAGS, Strategy};
use crate::oomdp::Action;
use crate::planning::{Judgement, Plan};
use crate::task::TaskSet;

/// An action that was done, judged for each task.
#[derive(Clone, Copy, Debug)]
struct Done {
    correct: TaskSet,
    incorrect: TaskSet,
}

impl Done {
    /// An action of which nothing is known.
    const UNKNOWN: Self = Self { correct: TaskSet::EMPTY, incorrect: TaskSet::EMPTY };

    const fn judged(self, task: usize) -> Judgement {
        if self.correct.contains(task) {
            Judgement::Correct
        } else if self.incorrect.contains(task) {
            Judgement::Incorrect
        } else {
            Judgement::Unknown
        }
    }
}

/// The last actions of a session, the last one first.
#[derive(Clone, Copy, Debug)]
pub(super) struct LastDone {
    actions: [Done; LAGS],
    any: bool,
}

impl LastDone {
    /// Nothing was done yet.
    pub(super) const NOTHING: Self = Self { actions: [Done::UNKNOWN; LAGS], any: false };

    /// Whether there is an action that can be judged.
    pub(super) const fn is_something(self) -> bool {
        self.any
    }

    /// An action was done in the state that was planned for.
    pub(super) fn add(&mut self, plan: Plan<'_>, action: Action) {
        let done = Done { correct: plan.judged(action, Judgement::Correct), incorrect: plan.judged(action, Judgement::Incorrect) };
        let [last, before, _] = self.actions;
        *self = Self { actions: [done, last, before], any: true };
    }

    /// What the actions were for a task.
    pub(super) fn judged(&self, task: usize) -> [Judgement; LAGS] {
        self.actions.map(|done| done.judged(task))
    }

    /// Whether a word says anything to those who follow one of these strategies: an action that it may be about was right or wrong for some
    /// task.
    pub(super) fn says_something(&self, strategies: &[(Strategy, f32)]) -> bool {
        self.actions.iter().enumerate().any(|(position, done)| {
            let meant = |(strategy, _): &(Strategy, f32)| strategy.lags().get(position).is_some_and(|&lag| lag > 0.0);
            !done.correct.union(done.incorrect).is_empty() && strategies.iter().any(meant)
        })
    }
}
