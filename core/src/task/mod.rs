//! Tasks (paper, section 3, task model): the possible meanings of a command here.
//!
//! - `lifted`: a conjunction of propositional functions over typed variables;
//! - `grounded`: its variables bound to objects;
//! - `constraint`: the attributes of the bound objects that a command may mention;
//! - `machine_command`: a task and a constraint as the sentence that a command is translated from;
//! - `role`: the part of an object in a task;
//! - `way`: path constraints, which must hold, or must not, before the goal;
//! - `wording`: the order in which a task and its way are worded;
//! - [`description`]: a task and its scene by roles, which the role model reads.

pub(crate) mod constraint;
#[doc(hidden)]
pub mod description;
pub(crate) mod grounded;
pub(crate) mod lifted;
pub(crate) mod machine_command;
pub(crate) mod role;
pub(crate) mod way;
pub(crate) mod wording;

pub use constraint::{Fact, Facts, facts};
pub(crate) use grounded::ground_unless;
#[cfg(feature = "talk")]
pub use grounded::ground_with_done;
pub use grounded::{GroundedTask, ground};
pub use lifted::{LiftedProposition, LiftedTask, NO_VARIABLE, TaskTextError};
#[cfg(feature = "ways")]
pub(crate) use machine_command::attribute_token;
pub use machine_command::{Expression, TokenOrder, Tokens};
pub use role::{Marker, NoMarker, Role, RoleKind, VALUE_SORTS, is_marker};
pub use way::{Clause, Part, Way, WayState};
pub use wording::{Piece, TaskText, Wording};

/// Words of a set of tasks.
const WORDS: usize = if cfg!(feature = "alloc") { 4 } else { 1 };
const WORD: usize = u64::BITS as usize;

/// A set of a session's tasks, one bit each, by position.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct TaskSet([u64; WORDS]);

impl TaskSet {
    /// The most tasks of a session.
    pub const MOST: usize = WORDS * WORD;
    /// The most tasks of a session without the feature `alloc`, as on controllers.
    pub const MOST_OF_ONE_WORD: usize = WORD;
    /// No task.
    pub const EMPTY: Self = Self([0; WORDS]);

    /// The first `count` tasks.
    pub fn first(count: usize) -> Self {
        let mut set = Self::EMPTY;
        let mut left = count;
        for word in &mut set.0 {
            *word = if left >= WORD { u64::MAX } else { (1_u64 << left).wrapping_sub(1) };
            left = left.saturating_sub(WORD);
        }
        set
    }

    /// The set of one task; empty for a position that no task can have.
    #[inline]
    pub fn of(task: usize) -> Self {
        let mut set = Self::EMPTY;
        if let Some(word) = set.0.get_mut(task / WORD) {
            *word = 1 << (task % WORD);
        }
        set
    }

    /// Whether the set has this task.
    #[inline]
    pub fn contains(self, task: usize) -> bool {
        self.0.get(task / WORD).is_some_and(|word| word >> (task % WORD) & 1 == 1)
    }

    /// Whether the set is empty.
    #[inline]
    pub fn is_empty(self) -> bool {
        self == Self::EMPTY
    }

    /// The number of tasks.
    pub fn len(self) -> usize {
        self.0.iter().map(|word| word.count_ones() as usize).sum()
    }

    /// The tasks of either set.
    #[inline]
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        self.joined(other, |word, other| word | other)
    }

    /// The set with one task more.
    #[must_use]
    pub fn with(self, task: usize) -> Self {
        self.union(Self::of(task))
    }

    /// The tasks that are not in `other`.
    #[inline]
    #[must_use]
    pub fn without(self, other: Self) -> Self {
        self.joined(other, |word, other| word & !other)
    }

    /// The tasks that are also in `other`.
    #[inline]
    #[must_use]
    pub fn common(self, other: Self) -> Self {
        self.joined(other, |word, other| word & other)
    }

    #[inline]
    fn joined(mut self, other: Self, join: impl Fn(u64, u64) -> u64) -> Self {
        for (word, other) in self.0.iter_mut().zip(other.0) {
            *word = join(*word, other);
        }
        self
    }

    /// The positions, in order.
    pub fn iter(self) -> impl Iterator<Item = usize> {
        let mut rest = self;
        core::iter::from_fn(move || {
            let (at, word) = rest.0.iter_mut().enumerate().find(|(_, word)| **word != 0)?;
            let next = word.trailing_zeros() as usize;
            *word &= word.wrapping_sub(1);
            Some(at.wrapping_mul(WORD).wrapping_add(next))
        })
    }
}

impl FromIterator<usize> for TaskSet {
    fn from_iter<I: IntoIterator<Item = usize>>(tasks: I) -> Self {
        tasks.into_iter().fold(Self::EMPTY, Self::with)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    #[test]
    fn sets_hold_every_task_that_there_can_be_and_no_other() {
        for task in 0..TaskSet::MOST {
            let one = TaskSet::of(task);
            assert!(one.contains(task) && one.len() == 1 && one.iter().eq([task]));
            assert!(TaskSet::first(task).iter().eq(0..task));
            assert_eq!(TaskSet::first(task).with(task), TaskSet::first(task + 1));
            assert_eq!(TaskSet::first(TaskSet::MOST).without(one).common(one), TaskSet::EMPTY);
        }
        assert!(TaskSet::of(TaskSet::MOST).is_empty() && !TaskSet::EMPTY.contains(TaskSet::MOST));
        assert_eq!(TaskSet::first(usize::MAX), TaskSet::first(TaskSet::MOST));
        let scattered = [0, 5, 62, 63, TaskSet::MOST - 1];
        assert_eq!(scattered.into_iter().collect::<TaskSet>().iter().collect::<std::collections::BTreeSet<_>>(), scattered.into());
        assert_eq!(Vec::from_iter(TaskSet::EMPTY.iter()), []);
    }
}
