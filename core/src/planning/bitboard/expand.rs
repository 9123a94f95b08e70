//! The states of one row at the distance under way, expanded together.

use super::{CANDIDATES, FREE, RowSearch};
use crate::oomdp::{Action, ActionSet, Piece, PushGrid};
use crate::planning::bits::take_from;
use crate::planning::goals::Goals;
use crate::planning::plan::Results;

impl RowSearch {
    /// Expands all states of one row at the distance under way. Returns how many expansions that took, at least the words of the row, or
    /// `None` where no row is left. `now` is the state that was planned for.
    #[inline]
    pub(in super::super) fn expand<G: PushGrid + ?Sized>(
        &mut self,
        marks: &mut [u64],
        results: &mut Results<'_>,
        grid: &G,
        goals: &Goals<'_>,
        now: &G::State,
    ) -> Option<u32> {
        let row = self.take(marks)?;
        let (state, occupied) = self.state_of_row(grid, now, row, marks);
        let touched = match (self.words, self.actions) {
            // Rows of one word are common: their loops are unrolled.
            (1, 4) => self.spread_word::<4>(marks, row, occupied),
            (1, 5) => self.spread_word::<5>(marks, row, occupied),
            _ => self.spread_words(marks, grid, row, &state),
        };
        self.meet(marks, results, grid, goals, &state, row);
        let expansions = if touched { self.push(marks, grid, now, &state, row) } else { 1 };
        let done = self.row_at(row).wrapping_add(self.here.wrapping_mul(self.words));
        for word in 0..self.words {
            if let Some(bits) = marks.get_mut(done.wrapping_add(word)) {
                *bits = 0;
            }
        }
        Some(expansions.max(self.words as u32))
    }

    /// Takes the next row that has a state at the distance under way.
    #[inline]
    fn take(&mut self, marks: &mut [u64]) -> Option<usize> {
        let start = self.frontier_at(self.here);
        take_from(marks.get_mut(start..start.wrapping_add(self.set))?, &mut self.cursor)
    }

    /// Opens what the robot's moves reach within a row of one word. Returns whether they touch an occupied cell.
    #[inline]
    fn spread_word<const ACTIONS: usize>(&mut self, marks: &mut [u64], row: usize, occupied: u64) -> bool {
        let Some((front, rows)) = marks.split_at_mut_checked(self.rows_at) else { return false };
        let Some(planes) = rows.get_mut(row.wrapping_mul(ACTIONS.wrapping_add(2))..) else { return false };
        let Some((planes, rest)) = planes.split_first_chunk_mut::<ACTIONS>() else { return false };
        let Some([even, odd]) = rest.first_chunk_mut::<2>() else { return false };
        let (here, next) = if self.here == ACTIONS { (*even, odd) } else { (*odd, even) };
        let width = self.bits.width as u32;
        let reached = beside_in_word(here, width);
        let known = planes.iter().fold(0, |all, plane| all | plane) & !*next;
        let new = reached & front.get(self.floor_plane_at(FREE)).copied().unwrap_or(0) & !occupied & !known;
        if new != 0 {
            for plane in planes {
                *plane |= beside_in_word(*plane & here, width) & new;
            }
            *next |= new;
            self.open(marks, row);
        }
        reached & occupied != 0
    }

    /// The same for a row of several words.
    fn spread_words<G: PushGrid + ?Sized>(&mut self, marks: &mut [u64], grid: &G, row: usize, state: &G::State) -> bool {
        let words = self.words;
        let (here, next) = (self.here, self.next);
        let Some((front, rows)) = marks.split_at_mut_checked(self.rows_at) else { return false };
        let start = row.wrapping_mul(self.stride);
        let Some(planes) = rows.get_mut(start..start.wrapping_add(self.stride)) else { return false };
        let at = |plane: usize, word: usize| plane.wrapping_mul(words).wrapping_add(word);
        let get = |planes: &[u64], at: usize| planes.get(at).copied().unwrap_or(0);
        let (mut opened, mut touched) = (0, 0);
        for word in 0..words {
            let reached = self.beside(word, |word| get(planes, at(here, word)));
            if reached == 0 {
                continue;
            }
            let occupied = self.occupied(grid, state, word);
            let known = (0..self.actions).fold(0, |all, action| all | get(planes, at(action, word))) & !get(planes, at(next, word));
            let new = reached & get(front, self.floor_plane_at(FREE).wrapping_add(word)) & !occupied & !known;
            touched |= reached & occupied;
            if new == 0 {
                continue;
            }
            for action in 0..self.actions {
                let ways = self.beside(word, |word| get(planes, at(action, word)) & get(planes, at(here, word)));
                if let Some(plane) = planes.get_mut(at(action, word)) {
                    *plane |= ways & new;
                }
            }
            if let Some(plane) = planes.get_mut(at(next, word)) {
                *plane |= new;
            }
            opened |= new;
        }
        if opened != 0 {
            self.open(marks, row);
        }
        touched != 0
    }

    /// The bits of a word that other moving pieces occupy.
    #[inline]
    fn occupied<G: PushGrid + ?Sized>(&self, grid: &G, state: &G::State, word: usize) -> u64 {
        self.pieces()
            .filter_map(|piece| self.bit_of(grid, state, piece))
            .fold(0, |bits, bit| bits | if bit / 64 == word { 1 << (bit % 64) } else { 0 })
    }

    #[inline]
    fn bit_of<G: PushGrid + ?Sized>(&self, grid: &G, state: &G::State, piece: Piece) -> Option<usize> {
        grid.floor().cells.get(grid.cell(state, piece).index()).map(|cell| self.bits.of(cell))
    }

    /// The bits of one word that are beside the bits of a plane of several words.
    #[inline]
    fn beside(&self, word: usize, plane: impl Fn(usize) -> u64) -> u64 {
        // Words beyond the row count as empty.
        let before = |by: usize| word.checked_sub(by).map_or(0, &plane);
        let after = |by: usize| if word.wrapping_add(by) < self.words { plane(word.wrapping_add(by)) } else { 0 };
        let (far, near) = (self.bits.width / 64, (self.bits.width % 64) as u32);
        let over = 63_u32.wrapping_sub(near);
        let bits = plane(word);
        let up = before(far) << near | before(far.wrapping_add(1)) >> 1 >> over;
        let down = after(far) >> near | after(far.wrapping_add(1)) << 1 << over;
        bits << 1 | before(1) >> 63 | bits >> 1 | after(1) << 63 | up | down
    }

    /// Finds the tasks that hold in the row's states of the distance under way.
    #[inline]
    fn meet<G: PushGrid + ?Sized>(
        &self,
        marks: &mut [u64],
        results: &mut Results<'_>,
        grid: &G,
        goals: &Goals<'_>,
        state: &G::State,
        row: usize,
    ) {
        let (words, actions, sought) = (self.words, self.actions, results.found.sought);
        let mut tasks = sought.common(self.only_robot);
        let candidates = self.set_at(CANDIDATES).wrapping_add(row / 64);
        if marks.get(candidates).is_some_and(|word| word >> (row % 64) & 1 == 1) {
            let allowed = |piece| self.view.allowed(goals, grid, state, piece, grid.cell(state, piece));
            let more = self.pieces().fold(sought.without(self.only_robot), |more, piece| more.common(allowed(piece)));
            // The tasks sought become fewer, so a row that is no candidate now never is again.
            if more.is_empty()
                && let Some(word) = marks.get_mut(candidates)
            {
                *word &= !(1 << (row % 64));
            }
            tasks = tasks.union(more);
        }
        let planes = self.row_at(row);
        let plane =
            |plane: usize, word: usize| marks.get(planes.wrapping_add(plane.wrapping_mul(words)).wrapping_add(word)).copied().unwrap_or(0);
        for task in tasks.iter() {
            let mask = self.of_robot.contains(task).then(|| self.floor_plane_at(self.plane_of(task)));
            for word in 0..words {
                let cells = mask.map_or(u64::MAX, |mask| marks.get(mask.wrapping_add(word)).copied().unwrap_or(0));
                let met = plane(self.here, word) & cells;
                if met != 0 {
                    let first = (0..actions).filter(|&action| plane(action, word) & met != 0);
                    results.meet(task, first.fold(ActionSet::EMPTY, |set, action| set.with(Action(action as u8))));
                }
            }
        }
    }

    /// Moves the pieces that the robot can move from beside them. Returns how many expansions that took.
    #[inline]
    fn push<G: PushGrid + ?Sized>(&mut self, marks: &mut [u64], grid: &G, now: &G::State, state: &G::State, row: usize) -> u32 {
        let planes = self.row_at(row);
        let here_at = planes.wrapping_add(self.here.wrapping_mul(self.words));
        let mut expansions = 1_u32;
        for piece in self.pieces() {
            let Some(occupied) = self.bit_of(grid, state, piece) else { continue };
            let here = marks.get(here_at).copied().unwrap_or(0);
            if self.words == 1 && beside_in_word(1_u64.wrapping_shl(occupied as u32), self.bits.width as u32) & here == 0 {
                continue;
            }
            for (direction, toward) in self.directions.into_iter().enumerate() {
                // A difference below bit 0 wraps around, and the bounds check rejects it.
                let bit = occupied.wrapping_add_signed(self.bits.shift(direction).wrapping_neg());
                let has = |at: usize| marks.get(at.wrapping_add(bit / 64)).is_some_and(|word| word >> (bit % 64) & 1 == 1);
                if bit / 64 >= self.words || !has(here_at) {
                    continue;
                }
                let (mut first, mut at) = (ActionSet::EMPTY, planes);
                for action in 0..self.actions {
                    first = ActionSet(first.0 | u16::from(has(at)) << action);
                    at = at.wrapping_add(self.words);
                }
                let here = grid.put(state, Piece::ROBOT, self.cell(self.rank_of_bit(marks, bit), marks));
                for action in core::iter::once(toward).chain(self.others.iter()) {
                    expansions = expansions.wrapping_add(1);
                    let next = grid.step(&here, action).filter(|next| *next != here);
                    if let Some(next) = next.and_then(|next| self.spot(grid, now, &next, marks)) {
                        self.reach(marks, next, first);
                    }
                }
            }
        }
        expansions
    }
}

/// The bits beside those of a row of one word.
#[inline]
const fn beside_in_word(bits: u64, width: u32) -> u64 {
    bits << 1 | bits >> 1 | bits.wrapping_shl(width) | bits.wrapping_shr(width)
}
