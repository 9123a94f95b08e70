//! The place of words in an utterance, and how they are read there.

use super::conversation::Before;
use crate::task::TaskSet;

/// The share of each kind of task that goes to tasks that are done already.
pub(super) const DONE: f32 = 0.08;

/// The tasks that fit words told apart.
pub(super) struct ToldTasks {
    pub tasks: TaskSet,
    /// Whether their place needs no other name.
    pub is_place: bool,
}

/// How some words are read.
#[derive(Clone, Copy)]
pub(super) struct View<'c> {
    /// The share of the tasks that are done already.
    pub done: f32,
    /// Whether another word is the sign of a task.
    pub has_act: bool,
    /// The kind of the previous command's task: a command without an act word is most probably of the same kind.
    pub kind: Option<u8>,
    /// What words can refer to.
    pub before: Before<'c>,
    /// The tasks that fit other words.
    pub told: Option<&'c ToldTasks>,
}

impl View<'_> {
    /// A plain command.
    pub const PLAIN: Self = Self { done: DONE, has_act: false, kind: None, before: Before::Nothing, told: None };
}

/// The place of words in an utterance.
#[derive(Clone, Copy)]
pub(super) struct Place<'c> {
    /// Whether they follow another command. Their act word may then be left out.
    pub is_rest: bool,
    /// The kind of that command's task.
    pub kind: Option<u8>,
    /// What words can refer to.
    pub before: Before<'c>,
    /// The tasks that fit other words.
    pub told: Option<&'c ToldTasks>,
}

impl<'c> Place<'c> {
    pub const WHOLE: Self = Self { is_rest: false, kind: None, before: Before::Nothing, told: None };

    /// Whether something was done before.
    pub const fn is_known(self) -> bool {
        matches!(self.before, Before::Known(_))
    }

    /// After another part of the same utterance.
    pub const fn after_first(self) -> Self {
        Self { is_rest: true, before: Before::Open, told: None, ..self }
    }

    /// Adapts a view to this place, without the kind of the previous command.
    pub const fn of_any_kind(self, view: View<'_>) -> View<'c> {
        Self { kind: None, ..self }.view(view)
    }

    /// Adapts a view to this place.
    pub const fn view(self, view: View<'_>) -> View<'c> {
        View { done: view.done, has_act: view.has_act || self.is_rest, kind: self.kind, before: self.before, told: self.told }
    }
}
