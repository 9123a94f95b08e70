//! A* with the lower bound as heuristic, over the real states of all pieces. It finds every shortest plan's first action.
//!
//! It goes breadth first, from one distance g to the next, and leaves out states whose g and lower bound h together exceed a threshold: first
//! the start's own bound, then the least sum that was left out before (breadth-first iterative-deepening A*: Zhou and Hansen, 2004). So a goal
//! is met first at its true distance. Until then, equal states need to be told only within one distance, and only two distances are in memory.
//!
//! A state is one word: the robot's cell, that of the task's piece, the arrangement of the others, and the first actions of the plans that lead
//! to it. An arrangement is a chain of the pieces that have moved, in order, each with its new cell. It needs no number of the joint state, so
//! homes may have more states than can be numbered.

use super::relaxation::{Relaxation, others};
use crate::oomdp::{ActionSet, CellId, Piece, PushGrid, own_actions};
use crate::planning::goals::Goals;
use crate::planning::plan::Results;
use crate::task::TaskSet;

/// What a call comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    Working,
    /// All goals at the least distance are met.
    Met,
    /// The memory or the work does not suffice.
    GivenUp,
}

/// The most arrangements of other pieces.
const MOST_ARRANGEMENTS: usize = 1 << 12;
/// Places of a table for each state at the distance before.
const BRANCHES: usize = 8;
/// Where so many places in a row are taken, a table counts as full.
const PROBES: usize = 32;

/// The search for one task, and how far it has come.
#[derive(Clone, Copy, Debug)]
pub(super) struct AStar {
    task: usize,
    piece: Piece,
    /// Where its memory begins in the marks: the arrangements, and behind them two tables of states.
    at: usize,
    arrangements: usize,
    /// Words of a table of states, and how many of them are in use at the distance under way and at the next.
    table: usize,
    here: usize,
    next: usize,
    /// Which of the two tables is the next.
    flipped: bool,
    /// States at the next distance.
    ahead: usize,
    /// The place in the table that is looked at.
    cursor: usize,
    level: u32,
    threshold: u32,
    /// The least sum above the threshold.
    beyond: u32,
    /// Expansions that are left.
    left: u32,
    /// The first actions of the plans whose goals are met at the next distance.
    first: ActionSet,
}

/// What is searched.
pub(super) struct Scene<'d, G: PushGrid + ?Sized> {
    pub(super) grid: &'d G,
    pub(super) goals: &'d Goals<'d>,
    pub(super) relaxation: &'d Relaxation,
    /// The state that is planned for.
    pub(super) start: &'d G::State,
}

impl<G: PushGrid + ?Sized> Scene<'_, G> {
    /// The cells of the robot and of a piece.
    fn cells(&self, state: &G::State, piece: Piece) -> (CellId, CellId) {
        (self.grid.cell(state, Piece::ROBOT), self.grid.cell(state, piece))
    }
}

/// The memory apart.
struct Parts<'m> {
    relaxed: &'m [u64],
    arrangements: &'m mut [u64],
    here: &'m mut [u64],
    next: &'m mut [u64],
}

/// The key of a state: all but its first actions.
const fn key(arrangement: u16, robot: CellId, piece: CellId) -> u64 {
    (arrangement as u64) << 48 | (robot.0 as u64) << 32 | (piece.0 as u64) << 16
}

const FIRST_ACTIONS: u64 = 0xffff;

/// The place of a key in the first `used` places of a table: that where it is, or a free one. `None` if the table is full.
fn place(table: &mut [u64], used: usize, key: u64, is_key: impl Fn(u64) -> bool) -> Option<(usize, &mut u64)> {
    let mut spread = key ^ key >> 32;
    spread = spread.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mut at = ((spread >> 32).wrapping_mul(used as u64) >> 32) as usize;
    for _ in 0..PROBES {
        if table.get(..used)?.get(at).is_some_and(|&word| word == 0 || is_key(word)) {
            return Some((at, table.get_mut(at)?));
        }
        at = at.wrapping_add(1);
        if at >= used {
            at = 0;
        }
    }
    None
}

impl AStar {
    /// The search for a task whose distance is at least this, with at most so many expansions; `None` where there is no memory for one.
    pub(super) fn new(relaxation: &Relaxation, words: usize, task: usize, piece: Piece, distance: u32, most: u32) -> Option<Self> {
        let at = relaxation.words();
        let room = words.checked_sub(at)?;
        let arrangements = (room / 8).min(MOST_ARRANGEMENTS);
        let table = room.saturating_sub(arrangements) / 2;
        (table > 0).then_some(Self {
            task,
            piece,
            at,
            arrangements,
            table,
            here: 0,
            next: 0,
            flipped: false,
            ahead: 0,
            cursor: 0,
            level: 0,
            threshold: distance,
            beyond: u32::MAX,
            left: most,
            first: ActionSet::EMPTY,
        })
    }

    fn parts<'m>(&self, marks: &'m mut [u64]) -> Option<Parts<'m>> {
        let (relaxed, rest) = marks.split_at_mut_checked(self.at)?;
        let (arrangements, rest) = rest.split_at_mut_checked(self.arrangements)?;
        let (even, rest) = rest.split_at_mut_checked(self.table)?;
        let odd = rest.get_mut(..self.table)?;
        let (here, next) = if self.flipped { (odd, even) } else { (even, odd) };
        Some(Parts { relaxed, arrangements, here, next })
    }

    /// Leaves zeros in its memory.
    pub(super) fn clear(&self, marks: &mut [u64]) {
        let Some(Parts { arrangements, here, next, .. }) = self.parts(marks) else { return };
        arrangements.fill(0);
        here.get_mut(..self.here).unwrap_or(&mut []).fill(0);
        next.get_mut(..self.next).unwrap_or(&mut []).fill(0);
    }

    /// Goes on, with at most `left` expansions. `start` is the state that is planned for. It leaves zeros in its memory at its end.
    pub(super) fn advance<G: PushGrid + ?Sized>(
        &mut self,
        marks: &mut [u64],
        results: &mut Results<'_>,
        scene: &Scene<'_, G>,
        left: &mut u32,
    ) -> Outcome {
        while *left > 0 {
            let outcome = match self.take(marks) {
                Some(word) => {
                    *left = left.saturating_sub(1);
                    self.left = self.left.saturating_sub(1);
                    self.expand(marks, scene, word).map_or(Outcome::GivenUp, |()| Outcome::Working)
                }
                None => self.next_level(marks, scene),
            };
            if outcome == Outcome::Met {
                results.found.level = self.threshold;
                results.meet(self.task, self.first);
                results.end_level();
            }
            if outcome != Outcome::Working || self.left == 0 {
                self.clear(marks);
                return if outcome == Outcome::Met { outcome } else { Outcome::GivenUp };
            }
        }
        Outcome::Working
    }

    /// Takes the next state at the distance under way.
    #[inline]
    fn take(&mut self, marks: &mut [u64]) -> Option<u64> {
        let Parts { here, .. } = self.parts(marks)?;
        let (skipped, word) = here.get_mut(self.cursor..self.here)?.iter_mut().enumerate().find(|(_, word)| **word != 0)?;
        self.cursor = self.cursor.wrapping_add(skipped).wrapping_add(1);
        Some(core::mem::take(word))
    }

    /// Goes on to the next distance, or to the next threshold from the start.
    fn next_level<G: PushGrid + ?Sized>(&mut self, marks: &mut [u64], scene: &Scene<'_, G>) -> Outcome {
        if !self.first.is_empty() {
            return Outcome::Met;
        }
        self.flipped = !self.flipped;
        (self.level, self.here, self.cursor) = (self.level.saturating_add(1), self.next, 0);
        if self.ahead == 0 {
            // The first threshold is the start's own bound.
            if self.here > 0 {
                self.threshold = self.beyond;
            }
            if self.threshold == u32::MAX {
                return Outcome::GivenUp;
            }
            (self.level, self.beyond, self.here, self.ahead) = (0, u32::MAX, 1, 1);
            let (robot, piece) = scene.cells(scene.start, self.piece);
            let Some(word) = self.parts(marks).and_then(|parts| parts.here.first_mut()) else { return Outcome::GivenUp };
            // Its first actions are not read.
            *word = key(0, robot, piece) | FIRST_ACTIONS;
        }
        // At most half of a table is taken, where there is room.
        self.next = self.ahead.saturating_mul(BRANCHES).min(self.table);
        self.ahead = 0;
        Outcome::Working
    }

    /// Opens what the actions lead to from a state; `None` if there is no room for it.
    fn expand<G: PushGrid + ?Sized>(&mut self, marks: &mut [u64], scene: &Scene<'_, G>, word: u64) -> Option<()> {
        let Scene { grid, goals, relaxation, start } = *scene;
        let parts = self.parts(marks)?;
        let (arrangement, robot, piece) = ((word >> 48) as u16, CellId((word >> 32) as u16), CellId((word >> 16) as u16));
        let mut state = *start;
        let mut link = usize::from(arrangement);
        while let Some(&moved) = link.checked_sub(1).and_then(|at| parts.arrangements.get(at)) {
            state = grid.put(&state, Piece((moved >> 16) as u8), CellId(moved as u16));
            link = (moved >> 32) as usize;
        }
        state = grid.put(&grid.put(&state, self.piece, piece), Piece::ROBOT, robot);
        let floor = grid.floor();
        for action in own_actions(grid) {
            if let Some(direction) = floor.directions.iter().position(|&direction| direction == action) {
                // Most actions are left out without a look at the other pieces.
                let ahead = floor.neighbour(robot, direction);
                let pushed = if ahead == piece { floor.neighbour(piece, direction) } else { piece };
                if ahead == CellId::NONE || ahead == piece && pushed == CellId::NONE {
                    continue;
                }
                if !self.is_within(relaxation.distance(parts.relaxed, ahead, pushed)) {
                    continue;
                }
            }
            let Some(next) = grid.step(&state, action).filter(|next| *next != state) else { continue };
            let (robot, piece) = scene.cells(&next, self.piece);
            let bound = relaxation.distance(parts.relaxed, robot, piece);
            if !self.is_within(bound) {
                continue;
            }
            let first = if self.level == 0 { ActionSet::of(action) } else { ActionSet(word as u16) };
            if bound == Some(0) && !goals.satisfied(grid, &next, TaskSet::of(self.task)).is_empty() {
                self.first = self.first.union(first);
                continue;
            }
            let mut arrangement = 0_u16;
            for other in others(grid, self.piece) {
                let cell = grid.cell(&next, other);
                if cell != grid.cell(start, other) {
                    let moved = u64::from(arrangement) << 32 | u64::from(other.0) << 16 | u64::from(cell.0);
                    let (at, entry) = place(parts.arrangements, self.arrangements, moved, |entry| entry == moved)?;
                    *entry = moved;
                    arrangement = at.wrapping_add(1) as u16;
                }
            }
            let key = key(arrangement, robot, piece);
            let (_, entry) = place(parts.next, self.next, key, |entry| entry & !FIRST_ACTIONS == key)?;
            self.ahead = self.ahead.wrapping_add(usize::from(*entry == 0));
            *entry |= key | u64::from(first.0);
        }
        Some(())
    }

    /// Whether a state at the next distance with this lower bound can be on a plan as short as the threshold. If not, takes note of the sum.
    #[inline]
    fn is_within(&mut self, bound: Option<u32>) -> bool {
        let Some(bound) = bound else { return false };
        let sum = self.level.saturating_add(1).saturating_add(bound);
        if sum > self.threshold {
            self.beyond = self.beyond.min(sum);
        }
        sum <= self.threshold
    }
}
