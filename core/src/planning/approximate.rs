//! Approximate plans, for the tasks that the exact search left open.
//!
//! 1. *Frozen pieces.* Pieces that a task does not depend on are frozen. Tasks that depend on the same pieces share a search in the small
//!    space of the robot and those pieces. If that finds no path, a frozen piece may block it: each other piece in turn may then move too.
//! 2. *Windows of regions.* If the memory is too small for the robot and one piece on the whole floor, a search moves the two within a
//!    window of regions (see `window`).
//!
//! Such a plan can miss a shorter path, or a dead end. The robot acts on it, but it is no evidence.

mod trail;
mod window;

use self::window::{Errand, Scene};
use super::bitboard::{RowSearch, Subgoal, View};
use super::goals::Goals;
use crate::oomdp::{Piece, PushGrid};
use crate::task::TaskSet;

/// The remaining searches.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Approximation {
    /// The tasks not tried yet in this pass.
    waiting: TaskSet,
    /// The tasks whose own pieces do not fit the memory on the whole floor.
    too_large: TaskSet,
    /// 0: each task's own pieces; then each piece in turn may move too; then windows of regions.
    pass: usize,
    /// The search in a window that is being prepared.
    errand: Option<Errand>,
    /// The current search in a window, if there is another way to do the same.
    retry: Option<Subgoal>,
}

/// The outcome of a call: no search is left, the next one is not ready yet, or this search, for these tasks.
pub(super) type Next = Option<Option<(TaskSet, RowSearch)>>;

impl Approximation {
    /// Begins for the open tasks.
    pub(super) fn new(unknown: TaskSet) -> Self {
        Self { waiting: unknown, ..Self::default() }
    }

    /// Whether a step is under way that can be interrupted anywhere. Do not change the marks meanwhile.
    pub(super) const fn is_on_errand(&self) -> bool {
        self.errand.is_some()
    }

    /// Continues to the next search, for the open tasks `unknown`, with about `left` expansions at most. `marks` holds zeros if no step is
    /// under way.
    #[inline(never)]
    pub(super) fn next<G: PushGrid + ?Sized>(
        &mut self,
        grid: &G,
        goals: &Goals<'_>,
        state: &G::State,
        unknown: TaskSet,
        marks: &mut [u64],
        left: &mut u32,
    ) -> Next {
        if let Some(errand) = &mut self.errand {
            let (found, is_retry) = (errand.advance(&Scene { grid, goals, state }, marks, left), errand.is_retry);
            let Some((search, subgoal)) = found.flatten() else {
                self.errand = self.errand.filter(|_| found.is_some());
                return Some(None);
            };
            (self.errand, self.retry) = (None, Some(subgoal).filter(|subgoal| !is_retry && subgoal.piece != Piece::ROBOT));
            return Some(Some((TaskSet::of(subgoal.task), search)));
        }
        let pieces = grid.pieces();
        if let Some(failed) = self.retry.take().filter(|failed| unknown.contains(failed.task)) {
            self.errand = Some(Errand::after(failed));
            return Some(None);
        }
        let Some(first) = self.waiting.iter().next() else {
            if unknown.is_empty() || self.pass >= pieces {
                return None;
            }
            self.pass = self.pass.saturating_add(1);
            self.waiting = if self.pass < pieces { unknown } else { unknown.common(self.too_large) };
            return Some(None);
        };
        if self.pass >= pieces {
            self.waiting = self.waiting.without(TaskSet::of(first));
            self.errand = Some(Errand::of(first));
            return Some(None);
        }
        *left = left.saturating_sub(grid.floor().cells.len() as u32);
        let own = goals.pieces_of(first);
        let group = self.waiting.common(goals.decided_by(own));
        self.waiting = self.waiting.without(group);
        let extra = if self.pass == 0 { 0 } else { Piece(self.pass as u8).bit() };
        let Some(own) = own.filter(|own| own & extra == 0) else { return Some(None) };
        let view = View { moving: own | extra | Piece::ROBOT.bit(), ..View::WHOLE };
        match RowSearch::layout(grid, goals, group, view, None, marks.len()) {
            Some(search) => return Some(Some((group, search))),
            None if self.pass == 0 => self.too_large = self.too_large.union(group),
            None => {}
        }
        Some(None)
    }
}
