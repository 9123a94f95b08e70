//! Where words stand in an utterance, and how they are then read.

use super::recalled::Before;

/// The share of each kind of task that is for tasks that are done already.
pub(super) const DONE: f32 = 0.08;

/// How some words are read.
#[derive(Clone, Copy)]
pub(super) struct View<'c> {
    /// The share of the tasks that hold already.
    pub done: f32,
    /// Whether another word is the sign of a task.
    pub has_act: bool,
    /// The kind of task that the command before was of: a command without a word of its own for that is most probably of the same.
    pub kind: Option<u8>,
    /// What words can point back at.
    pub before: Before<'c>,
}

impl View<'_> {
    /// As a command.
    pub const PLAIN: Self = Self { done: DONE, has_act: false, kind: None, before: Before::Nothing };
}

/// Where words stand in an utterance.
#[derive(Clone, Copy)]
pub(super) struct Place<'c> {
    /// Whether a command is before them. The task's own word may then be left out.
    pub is_rest: bool,
    /// The kind of task that it was of.
    pub kind: Option<u8>,
    /// What words can point back at.
    pub before: Before<'c>,
}

impl<'c> Place<'c> {
    pub const WHOLE: Self = Self { is_rest: false, kind: None, before: Before::Nothing };

    /// Whether something was done before.
    pub const fn is_known(self) -> bool {
        matches!(self.before, Before::Known(_))
    }

    /// Behind another part of the same utterance.
    pub const fn behind(self) -> Self {
        Self { is_rest: true, before: Before::Open, ..self }
    }

    /// How what is read so is read here, whatever kind of task the command before was of.
    pub const fn of_any_kind(self, view: View<'_>) -> View<'c> {
        Self { kind: None, ..self }.view(view)
    }

    /// How what is read so is read here.
    pub const fn view(self, view: View<'_>) -> View<'c> {
        View { done: view.done, has_act: view.has_act || self.is_rest, kind: self.kind, before: self.before }
    }
}
