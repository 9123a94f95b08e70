//! Deadlocks: tasks that one piece alone rules out for ever.
//!
//! A block that can only be pushed never leaves a corner, and one along a wall stays there. So each piece is followed from where it is, as
//! if no other piece were in the way and the robot were wherever it has to be. A task that asks for none of the cells it can come to is a
//! dead end. The test is sound but incomplete: a search may find more dead ends.

use super::bits::{insert, take_from};
use super::goals::Goals;
use crate::oomdp::{CellId, Piece, PushGrid};
use crate::task::TaskSet;

/// The directions in which a piece can be moved from a cell, if nothing else is in the way: the next cells.
pub(super) fn moves<G: PushGrid + ?Sized>(grid: &G, piece: Piece, cell: CellId) -> impl Iterator<Item = CellId> {
    let floor = grid.floor();
    let free = move |direction: usize| floor.neighbour(cell, direction) != CellId::NONE;
    // North and south stand side by side, and so do east and west.
    let movable = piece == Piece::ROBOT || grid.can_pull();
    (0..4)
        .filter(move |&direction| free(direction) && (movable || free(direction ^ 1)))
        .map(move |direction| floor.neighbour(cell, direction))
}

/// Which tasks no piece rules out for ever, as far as is known.
#[derive(Clone, Copy, Debug)]
pub(super) struct Deadlocks {
    possible: TaskSet,
    /// The piece that is followed, and whether it has left its cell.
    piece: u8,
    has_left: bool,
    /// The tasks that it does not rule out, and the word of the cells to go on from.
    reached: TaskSet,
    cursor: usize,
}

impl Deadlocks {
    /// Begins for these tasks.
    pub(super) const fn of(tasks: TaskSet) -> Self {
        Self { possible: tasks, piece: 1, has_left: false, reached: TaskSet::EMPTY, cursor: 0 }
    }

    /// Goes on, with at most `left` cells. Returns the tasks that are possible once that is known. `scratch` holds zeros before and
    /// afterwards; if it is too small, fewer tasks are ruled out.
    #[inline(never)]
    pub(super) fn advance<G: PushGrid + ?Sized>(
        &mut self,
        grid: &G,
        goals: &Goals<'_>,
        state: &G::State,
        scratch: &mut [u64],
        left: &mut u32,
    ) -> Option<TaskSet> {
        let words = grid.floor().cells.len().div_ceil(64);
        let Some((seen, open)) = scratch.get_mut(..words.saturating_mul(2)).and_then(|both| both.split_at_mut_checked(words)) else {
            return Some(self.possible);
        };
        while usize::from(self.piece) < grid.pieces() {
            let piece = Piece(self.piece);
            if !self.has_left {
                let start = grid.cell(state, piece).index();
                insert(seen, start);
                insert(open, start);
                (self.has_left, self.reached, self.cursor) = (true, TaskSet::EMPTY, 0);
            }
            while !self.possible.without(self.reached).is_empty() {
                if *left == 0 {
                    return None;
                }
                let Some(cell) = take_from(open, &mut self.cursor).map(|cell| CellId(cell as u16)) else { break };
                *left = left.saturating_sub(1);
                self.reached = self.reached.union(goals.allowed(grid, state, piece, cell));
                for next in moves(grid, piece, cell).map(CellId::index) {
                    if insert(seen, next) && insert(open, next) {
                        self.cursor = self.cursor.min(next / 64);
                    }
                }
            }
            seen.fill(0);
            open.fill(0);
            self.possible = self.possible.common(self.reached);
            (self.piece, self.has_left) = (self.piece.saturating_add(1), false);
        }
        Some(self.possible)
    }
}
