//! Tasks (paper, section 3, task model): the possible meanings of a command here.
//!
//! - `lifted`: a conjunction of propositional functions over typed variables;
//! - `grounded`: its variables bound to objects;
//! - `constraint`: which attributes of the bound objects a command may mention;
//! - `machine_command`: a task and a constraint as the sentence that a command is translated from;
//! - `role`: the part of an object in a task;
//! - [`way`]: path constraints, which must hold, or must not, before the goal;
//! - `wording`: the order in which a task is told, with its way;
//! - [`description`]: a task and its scene by roles, which the role model reads.

pub(crate) mod constraint;
pub mod description;
pub(crate) mod grounded;
pub(crate) mod lifted;
pub(crate) mod machine_command;
pub(crate) mod role;
pub mod way;
pub(crate) mod wording;

pub use constraint::{Fact, Facts, facts};
pub(crate) use grounded::ground_unless;
#[cfg(feature = "talk")]
pub use grounded::ground_with_done;
pub use grounded::{GroundedTask, ground};
pub use lifted::{LiftedProposition, LiftedTask, NO_VARIABLE, TaskTextError};
#[cfg(feature = "derived")]
pub(crate) use machine_command::attribute_token;
pub use machine_command::{Expression, TokenOrder, Tokens};
pub use role::{Marker, NoMarker, Role, RoleKind, VALUE_SORTS, is_marker};
pub use way::{Clause, Part, Way, WayState};
pub use wording::{Piece, TaskText, Wording};

/// A set of a session's tasks, one bit each, by position.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct TaskSet(pub(crate) u64);

impl TaskSet {
    /// The most tasks of a session.
    pub const MOST: usize = 64;
    /// No task.
    pub const EMPTY: Self = Self(0);

    /// The first `count` tasks.
    pub const fn first(count: usize) -> Self {
        if count >= Self::MOST { Self(u64::MAX) } else { Self((1 << count) - 1) }
    }

    /// The set of one task; empty for a position that no task can have.
    pub const fn of(task: usize) -> Self {
        if task < Self::MOST { Self(1 << task) } else { Self(0) }
    }

    /// Whether the set has this task.
    pub const fn contains(self, task: usize) -> bool {
        self.0 & Self::of(task).0 != 0
    }

    /// Whether there is none.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The tasks of both.
    #[must_use]
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// The set with one task more.
    #[must_use]
    pub const fn with(self, task: usize) -> Self {
        self.union(Self::of(task))
    }

    /// The tasks that `other` does not have.
    #[must_use]
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// The tasks that `other` has too.
    #[must_use]
    pub const fn common(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// The positions, in order.
    pub fn iter(self) -> impl Iterator<Item = usize> {
        let mut rest = self.0;
        core::iter::from_fn(move || {
            let next = rest.trailing_zeros();
            rest &= rest.wrapping_sub(1);
            (next < 64).then_some(next as usize)
        })
    }
}

impl FromIterator<usize> for TaskSet {
    fn from_iter<I: IntoIterator<Item = usize>>(tasks: I) -> Self {
        tasks.into_iter().fold(Self::EMPTY, Self::with)
    }
}
