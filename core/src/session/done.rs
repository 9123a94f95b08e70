//! The last actions, each judged for every task: a word about an action may come while the next plan is being made, or one or two actions
//! later.

use crate::feedback::{Feedback, Judged, LAGS, Moment, Strategy};
use crate::oomdp::Action;
use crate::planning::{Judgement, Plan};
use crate::task::TaskSet;

/// An action that was done, judged for each task.
#[derive(Clone, Copy, Debug)]
struct Done {
    correct: TaskSet,
    incorrect: TaskSet,
    /// The tasks that were done before it and after it.
    inside: TaskSet,
}

impl Done {
    /// An action that no task judges.
    const UNKNOWN: Self = Self { correct: TaskSet::EMPTY, incorrect: TaskSet::EMPTY, inside: TaskSet::EMPTY };

    fn judged(self, task: usize, rests: bool) -> Judged {
        let judgement = if self.correct.contains(task) {
            Judgement::Correct
        } else if self.incorrect.contains(task) {
            Judgement::Incorrect
        } else {
            Judgement::Unknown
        };
        if self.inside.contains(task) { Judged::MovesInside } else { Judged::of(judgement, rests) }
    }
}

/// The last actions of a session, the last one first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LastDone {
    actions: [Done; LAGS],
    /// Whether each was a rest.
    rests: [bool; LAGS],
    any: bool,
    /// The moment before the last action's own word.
    moment: Moment,
    /// The last action's word, silence too; `None` while nobody has judged it.
    word: Option<Feedback>,
    /// The last action.
    #[cfg(feature = "asking")]
    last: Option<Action>,
}

impl LastDone {
    /// No action yet.
    pub(super) const NOTHING: Self = Self {
        actions: [Done::UNKNOWN; LAGS],
        rests: [false; LAGS],
        any: false,
        moment: Moment { rests: 0, said: Feedback::Neutral },
        word: None,
        #[cfg(feature = "asking")]
        last: None,
    };

    /// Whether there is an action that can be judged.
    pub(crate) const fn is_something(self) -> bool {
        self.any
    }

    /// Whether the last action was judged, if only by silence.
    pub(super) const fn is_judged(self) -> bool {
        self.word.is_some()
    }

    /// Adds an action, done in the planned state. The tasks in `inside` were done before it, and still are.
    pub(super) fn add(&mut self, plan: Plan<'_>, action: Action, inside: TaskSet) {
        let rest = action == Action::NOOP;
        let (correct, incorrect) = (plan.judged(action, Judgement::Correct), plan.judged(action, Judgement::Incorrect));
        let ([last, before, _], [rested, earlier, _]) = (self.actions, self.rests);
        *self = Self {
            actions: [Done { correct, incorrect, inside }, last, before],
            rests: [rest, rested, earlier],
            any: true,
            moment: self.moment().acted(rest),
            word: None,
            #[cfg(feature = "asking")]
            last: Some(action),
        };
    }

    /// The last action, if it was done in this session.
    #[cfg(feature = "asking")]
    pub(super) const fn last(self) -> Option<Action> {
        self.last
    }

    /// Records the word on the last action; of several words the last counts.
    pub(super) const fn hear(&mut self, word: Feedback) {
        self.word = Some(word);
    }

    /// The last moment, with its word.
    pub(super) fn moment(&self) -> Moment {
        self.moment.heard(self.word.unwrap_or(Feedback::Neutral))
    }

    /// How a task judges each of the last actions.
    pub(super) fn judged(&self, task: usize) -> [Judged; LAGS] {
        let mut judged = [Judged::Unknown; LAGS];
        for ((slot, done), rests) in judged.iter_mut().zip(self.actions).zip(self.rests) {
            *slot = done.judged(task, rests);
        }
        judged
    }

    /// Whether a word is informative under one of these strategies: an action that it may be about was right or wrong for some task.
    pub(super) fn says_something(&self, strategies: &[(Strategy, f32)]) -> bool {
        self.actions.iter().enumerate().any(|(position, done)| {
            let meant = |(strategy, _): &(Strategy, f32)| strategy.lags().get(position).is_some_and(|&lag| lag > 0.0);
            !done.correct.union(done.incorrect).is_empty() && strategies.iter().any(meant)
        })
    }
}
