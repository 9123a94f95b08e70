//! The context of words: how the lessons are worded, the commands before them, and the tasks that other words tell.

use super::conversation::Before;
use super::wording::Wording;
use crate::session::Options;
use crate::task::TaskSet;

/// The share of each kind of task that goes to tasks that are done already.
pub(super) const DONE: f32 = Options::SELDOM_DONE;
/// The same share if a word such as "stay" is said. It is not all, because "wait in the red room" may ask the robot to go there.
pub(super) const STAYS: f32 = 0.999;

/// How some words are read.
#[derive(Clone, Copy)]
pub(super) struct View {
    /// The share of the tasks that are done already.
    pub done: f32,
    /// Whether another word is the sign of a task.
    pub has_act: bool,
}

impl View {
    /// A plain command.
    pub const PLAIN: Self = Self { done: DONE, has_act: false };
}

/// The tasks that fit words told apart.
pub(super) struct ToldTasks {
    pub tasks: TaskSet,
    /// Whether their place needs no other name.
    pub is_place: bool,
}

/// What was said earlier.
#[derive(Clone, Copy)]
pub(super) struct Earlier<'c> {
    /// Whether the words follow another command. Their act word may then be left out.
    pub is_rest: bool,
    /// The kind of that command's task: a command without an act word is most probably of the same kind.
    pub kind: Option<u8>,
    /// What words can refer to.
    pub before: Before<'c>,
}

/// The context of words.
#[derive(Clone, Copy)]
pub(super) struct Context<'c> {
    pub wording: &'c Wording<'c>,
    pub earlier: Earlier<'c>,
    /// The tasks that fit other words.
    pub told: Option<&'c ToldTasks>,
}

impl<'c> Context<'c> {
    /// The context of an utterance without an earlier one.
    pub const fn of(wording: &'c Wording<'c>) -> Self {
        Self { wording, earlier: Earlier { is_rest: false, kind: None, before: Before::Nothing }, told: None }
    }

    /// Whether something was done before.
    pub const fn is_known(self) -> bool {
        matches!(self.earlier.before, Before::Known(_))
    }

    /// The same after another part of the same utterance.
    pub const fn after_first(self) -> Self {
        Self { earlier: Earlier { is_rest: true, before: Before::Open, ..self.earlier }, told: None, ..self }
    }

    /// The same without the kind of the previous command, or with another one.
    pub const fn of_kind(self, kind: Option<u8>) -> Self {
        Self { earlier: Earlier { kind, ..self.earlier }, ..self }
    }
}
