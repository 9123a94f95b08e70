//! Deadlocks: tasks that one piece alone makes impossible for ever.
//!
//! A block that can only be pushed never leaves a corner, and one along a wall stays at the wall. So each piece is followed from its cell,
//! as if no other piece were in the way and the robot could stand anywhere. A task that accepts none of the cells reached by the piece is a
//! dead end. The test is sound but incomplete: a search may find more dead ends.

use super::bits::{insert, take_from};
use super::goals::Goals;
use crate::oomdp::{CellId, Piece, PushGrid};
use crate::task::TaskSet;

/// The cells to which a piece can be moved from a cell, if nothing else is in the way.
pub(super) fn moves<G: PushGrid>(grid: &G, piece: Piece, cell: CellId) -> impl Iterator<Item = CellId> {
    let floor = grid.floor();
    let free = move |direction: usize| floor.neighbour(cell, direction) != CellId::NONE;
    // Opposite directions differ in the lowest bit: north and south are 0 and 1, east and west 2 and 3.
    let movable = piece == Piece::ROBOT || grid.can_pull();
    (0..4)
        .filter(move |&direction| free(direction) && (movable || free(direction ^ 1)))
        .map(move |direction| floor.neighbour(cell, direction))
}

/// The search for tasks that a single piece makes impossible.
#[derive(Clone, Copy, Debug)]
pub(super) struct Deadlocks {
    possible: TaskSet,
    /// The followed piece, and whether its search has begun.
    piece: u8,
    has_left: bool,
    /// The tasks that it does not rule out so far, and the next word of open cells.
    reached: TaskSet,
    cursor: usize,
}

impl Deadlocks {
    /// Begins for these tasks.
    pub(super) const fn of(tasks: TaskSet) -> Self {
        Self { possible: tasks, piece: 1, has_left: false, reached: TaskSet::EMPTY, cursor: 0 }
    }

    /// Continues, with at most `left` cells. Returns the possible tasks once they are known. `scratch` holds zeros before and afterwards;
    /// if it is too small, fewer tasks are ruled out.
    #[inline(never)]
    pub(super) fn advance<G: PushGrid>(
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
