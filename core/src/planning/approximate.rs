//! Approximate plans, for the tasks that the exact search left open.
//!
//! Pieces that a task does not depend on are frozen. Tasks that depend on the same pieces share a search in the small space of the robot and
//! those pieces. If that finds no path, a frozen piece may block it: each other piece in turn may then move too. If the memory is too small
//! for the robot and one piece, the task stays unknown.
//!
//! Such a plan can miss a shorter path, or a dead end. The robot acts on it, but it is no evidence.

use super::goals::Goals;
use super::rows::{RowSearch, View};
use crate::oomdp::{Piece, PushGrid};
use crate::task::TaskSet;

/// The remaining searches.
#[derive(Clone, Copy, Debug)]
pub(super) struct Approximation {
    /// The tasks not tried yet in this pass.
    waiting: TaskSet,
    /// 0: each task's own pieces; then each piece in turn may move too.
    pass: usize,
}

/// The outcome of a call: no search is left, the next one is not ready yet, or this search, for these tasks.
pub(super) type Next = Option<Option<(TaskSet, RowSearch)>>;

impl Approximation {
    /// Begins for the open tasks.
    pub(super) const fn new(unknown: TaskSet) -> Self {
        Self { waiting: unknown, pass: 0 }
    }

    /// Continues to the next search, for the open tasks `unknown`, in this many words of zeros, with about `left` expansions at most.
    #[inline(never)]
    pub(super) fn next<G: PushGrid>(&mut self, grid: &G, goals: &Goals<'_>, unknown: TaskSet, words: usize, left: &mut u32) -> Next {
        let Some(first) = self.waiting.iter().next() else {
            self.pass = self.pass.saturating_add(1);
            if unknown.is_empty() || self.pass >= grid.pieces() {
                return None;
            }
            self.waiting = unknown;
            return Some(None);
        };
        *left = left.saturating_sub(grid.floor().cells.len() as u32);
        let own = goals.pieces_of(first);
        let group = self.waiting.common(goals.decided_by(own));
        self.waiting = self.waiting.without(group);
        let extra = if self.pass == 0 { 0 } else { Piece(self.pass as u8).bit() };
        let Some(own) = own.filter(|own| own & extra == 0) else { return Some(None) };
        let view = View { moving: own | extra | Piece::ROBOT.bit() };
        Some(RowSearch::layout(grid, goals, group, view, None, words).map(|search| (group, search)))
    }
}
