//! Whether a task can be done from a layout.

use crate::exercise::Intention;
use goodbot::home::{BLOCK_IN_ROOM, COLOR, Home, HomeState, ROOM, SHAPE};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Action, CellId, Domain, GroundProposition, Piece, PushGrid};

/// The most free cells of a home for [`is_solvable`]: one bit each.
pub const CELLS: usize = 64;

/// Reached places of the agent and of one block: a row for each place of the block, a bit for each place of the agent.
#[derive(Clone, Copy)]
struct Reached([u64; CELLS]);

impl Reached {
    fn row(&mut self, block: usize) -> Option<&mut u64> {
        self.0.get_mut(block)
    }
}

/// The goal of an intention in a home, `None` if its objects are missing.
fn goal(home: &Home<impl HomeMemory>, intention: &Intention) -> Option<GroundProposition> {
    let objects = home.world().objects;
    let room = objects.of_class(ROOM).find(|&room| objects.value(room, COLOR) == intention.room)?;
    let subject = match intention.block {
        None => home.agent(),
        Some((color, shape)) => {
            *home.blocks().iter().find(|&&block| objects.value(block, COLOR) == color && objects.value(block, SHAPE) == shape)?
        }
    };
    Some(GroundProposition::new(intention.proposition, &[subject, room]))
}

/// Whether the intended task can be done and is not done yet. All reachable places of the agent and of the block in question are tried,
/// while the other blocks stay in place. A home of more than [`CELLS`] free cells counts as unsolvable.
pub fn is_solvable(home: &Home<impl HomeMemory>, start: &HomeState, intention: &Intention) -> bool {
    let Some(goal) = goal(home, intention) else { return false };
    if home.places().len() > CELLS || home.holds(&goal, start) {
        return false;
    }
    // The block that moves; if the agent itself is meant, every block stays.
    let moving = if goal.proposition == BLOCK_IN_ROOM { home.piece_of(&goal) } else { None };
    let cell = |state: &HomeState, piece: Piece| home.cell(state, piece).index();
    let place = |state: &HomeState| (moving.map_or(0, |piece| cell(state, piece)), cell(state, Piece::ROBOT));
    let (mut reached, mut done) = (Reached([0; CELLS]), Reached([0; CELLS]));
    let mark = |reached: &mut Reached, (block, agent): (usize, usize)| {
        if let Some(row) = reached.row(block) {
            *row |= 1_u64.checked_shl(agent as u32).unwrap_or(0);
        }
    };
    mark(&mut reached, place(start));
    // Each pass handles at least one new place, and there are finitely many.
    for _ in 0..CELLS * CELLS {
        let mut fresh = false;
        for block in 0..home.places().len() {
            let open = reached.row(block).map_or(0, |row| *row) & !done.row(block).map_or(0, |row| *row);
            for agent in (0..CELLS).filter(|&agent| open >> agent & 1 == 1) {
                fresh = true;
                mark(&mut done, (block, agent));
                let at = home.put(start, Piece::ROBOT, CellId::new(agent as u16));
                let at = moving.map_or(at, |piece| home.put(&at, piece, CellId::new(block as u16)));
                for action in 0..home.actions().len() {
                    let Some(next) = home.step(&at, Action::new(action as u8)) else { continue };
                    let mut others = (1..home.pieces()).map(|piece| Piece::new(piece as u8)).filter(|&piece| Some(piece) != moving);
                    let others_stay = others.all(|piece| home.cell(&next, piece) == home.cell(start, piece));
                    if !others_stay {
                        continue;
                    }
                    if home.holds(&goal, &next) {
                        return true;
                    }
                    mark(&mut reached, place(&next));
                }
            }
        }
        if !fresh {
            return false;
        }
    }
    false
}
