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

/// The tasks that no piece rules out for ever. `scratch` holds zeros, before and afterwards; if it is too small, fewer tasks are ruled out.
#[inline(never)]
pub(super) fn possible<G: PushGrid + ?Sized>(
    grid: &G,
    goals: &Goals<'_>,
    state: &G::State,
    tasks: TaskSet,
    scratch: &mut [u64],
) -> TaskSet {
    let mut possible = tasks;
    for piece in (1..grid.pieces()).map(|piece| Piece(piece as u8)) {
        let words = grid.floor().cells.len().div_ceil(64);
        let Some((seen, rest)) = scratch.split_at_mut_checked(words) else { return possible };
        let Some(open) = rest.get_mut(..words) else { return possible };
        let start = grid.cell(state, piece).index();
        insert(seen, start);
        insert(open, start);
        let (mut reached, mut cursor) = (TaskSet::EMPTY, 0);
        while let Some(cell) = take_from(open, &mut cursor).map(|cell| CellId(cell as u16)) {
            reached = reached.union(goals.allowed(grid, state, piece, cell));
            if possible.without(reached).is_empty() {
                break;
            }
            for next in moves(grid, piece, cell).map(CellId::index) {
                if insert(seen, next) && insert(open, next) {
                    cursor = cursor.min(next / 64);
                }
            }
        }
        seen.fill(0);
        open.fill(0);
        possible = possible.common(reached);
    }
    possible
}
