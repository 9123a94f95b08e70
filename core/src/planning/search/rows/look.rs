//! One row's states of the distance under way, all at once.

use super::{Findings, HOPEFUL, Rows};
use crate::oomdp::{Action, ActionSet, Domain};
use crate::planning::GoalTable;

impl Rows {
    /// Looks at all states of one row at the distance under way; gives `None` where no row is left. It takes as many looks
    /// as the row has words, at least.
    #[inline]
    pub(in super::super) fn look<D: Domain + ?Sized>(
        &mut self,
        marks: &mut [u64],
        found: &mut Findings<'_>,
        domain: &D,
        goals: &GoalTable<'_>,
    ) -> Option<u32> {
        let row = self.take(marks)?;
        let state = domain.row(row as u64);
        let touched = match (self.words, self.actions) {
            // What most homes have, as straight lines.
            (1, 4) => self.spread_word::<4, D>(marks, domain, row, &state),
            (1, 5) => self.spread_word::<5, D>(marks, domain, row, &state),
            _ => self.spread_words(marks, domain, row, &state),
        };
        self.meet(marks, found, domain, goals, &state, row);
        let looks = if touched { self.act(marks, domain, &state, row) } else { 1 };
        let done = self.row_at(row).wrapping_add(self.here.wrapping_mul(self.words));
        for word in 0..self.words {
            if let Some(bits) = marks.get_mut(done.wrapping_add(word)) {
                *bits = 0;
            }
        }
        Some(looks.max(self.words as u32))
    }

    /// Takes the next row that has a state at the distance under way.
    #[inline]
    fn take(&mut self, marks: &mut [u64]) -> Option<usize> {
        let start = self.frontier_at(self.here);
        let set = marks.get_mut(start..start.wrapping_add(self.set))?;
        loop {
            let bits = set.get_mut(self.cursor)?;
            if *bits != 0 {
                let row = self.cursor.wrapping_mul(64).wrapping_add(bits.trailing_zeros() as usize);
                *bits &= bits.wrapping_sub(1);
                return Some(row);
            }
            self.cursor = self.cursor.wrapping_add(1);
        }
    }

    /// Opens what the robot's moves reach within a row of one word, and gives whether they touch what is taken.
    #[inline]
    fn spread_word<const ACTIONS: usize, D: Domain + ?Sized>(
        &mut self,
        marks: &mut [u64],
        domain: &D,
        row: usize,
        state: &D::State,
    ) -> bool {
        let Some((front, rows)) = marks.split_at_mut_checked(self.rows_at) else { return false };
        let Some(planes) = rows.get_mut(row.wrapping_mul(ACTIONS.wrapping_add(2))..) else { return false };
        let Some((planes, rest)) = planes.split_first_chunk_mut::<ACTIONS>() else { return false };
        let Some([even, odd]) = rest.first_chunk_mut::<2>() else { return false };
        let (here, next) = if self.here == ACTIONS { (*even, odd) } else { (*odd, even) };
        let width = self.grid.width as u32;
        let taken = self.taken(domain, state, 0);
        let reached = beside_in_word(here, width);
        let known = planes.iter().fold(0, |all, plane| all | plane) & !*next;
        let new = reached & front.get(self.cells_at(1)).copied().unwrap_or(0) & !taken & !known;
        if new != 0 {
            for plane in planes {
                *plane |= beside_in_word(*plane & here, width) & new;
            }
            *next |= new;
            self.open(marks, row);
        }
        reached & taken != 0
    }

    /// The same for a row of several words.
    fn spread_words<D: Domain + ?Sized>(&mut self, marks: &mut [u64], domain: &D, row: usize, state: &D::State) -> bool {
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
            let taken = self.taken(domain, state, word);
            let known = (0..self.actions).fold(0, |all, action| all | get(planes, at(action, word))) & !get(planes, at(next, word));
            let new = reached & get(front, self.cells_at(1).wrapping_add(word)) & !taken & !known;
            touched |= reached & taken;
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

    /// The bits of a word that are taken.
    #[inline]
    fn taken<D: Domain + ?Sized>(&self, domain: &D, state: &D::State, word: usize) -> u64 {
        let mut bits = 0;
        for variable in 1..domain.variables() {
            if let Some(place) = domain.taken(state, variable) {
                let bit = domain.bit_of(place);
                bits |= if bit / 64 == word { 1 << (bit % 64) } else { 0 };
            }
        }
        bits
    }

    /// The bits of one word that are beside the bits of a plane of several words.
    #[inline]
    fn beside(&self, word: usize, plane: impl Fn(usize) -> u64) -> u64 {
        // Beyond the first and the last word there is nothing.
        let before = |by: usize| word.checked_sub(by).map_or(0, &plane);
        let after = |by: usize| if word.wrapping_add(by) < self.words { plane(word.wrapping_add(by)) } else { 0 };
        let (far, near) = (self.grid.width / 64, (self.grid.width % 64) as u32);
        let over = 63_u32.wrapping_sub(near);
        let bits = plane(word);
        let up = before(far) << near | before(far.wrapping_add(1)) >> 1 >> over;
        let down = after(far) >> near | after(far.wrapping_add(1)) << 1 << over;
        bits << 1 | before(1) >> 63 | bits >> 1 | after(1) << 63 | up | down
    }

    /// Finds the tasks that hold in the row's states of the distance under way.
    #[inline]
    fn meet<D: Domain + ?Sized>(
        &self,
        marks: &mut [u64],
        found: &mut Findings<'_>,
        domain: &D,
        goals: &GoalTable<'_>,
        state: &D::State,
        row: usize,
    ) {
        let (words, actions) = (self.words, self.actions);
        let mut tasks = found.unresolved.common(self.only_placed);
        let hopeful = self.set_at(HOPEFUL).wrapping_add(row / 64);
        if marks.get(hopeful).is_some_and(|word| word >> (row % 64) & 1 == 1) {
            let mut more = found.unresolved.without(self.only_placed);
            for variable in 1..domain.variables() {
                more = more.common(goals.not_ruled_out(domain, state, variable));
            }
            // Tasks are resolved one after another, and none comes again.
            if more.is_empty()
                && let Some(word) = marks.get_mut(hopeful)
            {
                *word &= !(1 << (row % 64));
            }
            tasks = tasks.union(more);
        }
        let planes = self.row_at(row);
        let plane =
            |plane: usize, word: usize| marks.get(planes.wrapping_add(plane.wrapping_mul(words)).wrapping_add(word)).copied().unwrap_or(0);
        for task in tasks.iter() {
            let mask = self.placed.contains(task).then(|| self.cells_at(self.mask_of(task)));
            for word in 0..words {
                let cells = mask.map_or(u64::MAX, |mask| marks.get(mask.wrapping_add(word)).copied().unwrap_or(0));
                let met = plane(self.here, word) & cells;
                if met != 0 {
                    let first = (0..actions).filter(|&action| plane(action, word) & met != 0);
                    found.meet(task, first.fold(ActionSet::EMPTY, |set, action| set.with(Action(action as u8))));
                }
            }
        }
    }

    /// Does what the robot can do to what is taken beside it. Gives the looks it took.
    fn act<D: Domain + ?Sized>(&mut self, marks: &mut [u64], domain: &D, state: &D::State, row: usize) -> u32 {
        let planes = self.row_at(row);
        let here_at = planes.wrapping_add(self.here.wrapping_mul(self.words));
        let mut looks = 1_u32;
        for variable in 1..domain.variables() {
            let Some(taken) = domain.taken(state, variable).map(|place| domain.bit_of(place)) else { continue };
            let here = marks.get(here_at).copied().unwrap_or(0);
            if self.words == 1 && beside_in_word(1_u64.wrapping_shl(taken as u32), self.grid.width as u32) & here == 0 {
                continue;
            }
            for (direction, toward) in self.grid.directions.into_iter().enumerate() {
                // Behind the first cell there are bits beyond all words.
                let bit = taken.wrapping_add_signed(self.grid.shift(direction).wrapping_neg());
                let has = |at: usize| marks.get(at.wrapping_add(bit / 64)).is_some_and(|word| word >> (bit % 64) & 1 == 1);
                if bit / 64 >= self.words || !has(here_at) {
                    continue;
                }
                let (mut first, mut at) = (ActionSet::EMPTY, planes);
                for action in 0..self.actions {
                    first = ActionSet(first.0 | u16::from(has(at)) << action);
                    at = at.wrapping_add(self.words);
                }
                let place = self.place(marks, bit);
                let here = domain.with_value(state, 0, place);
                let number = (row as u64).wrapping_mul(self.places as u64).wrapping_add(place as u64);
                for action in core::iter::once(toward).chain(self.others.iter()) {
                    looks = looks.wrapping_add(1);
                    let next = domain.number_after(&here, number, action).filter(|&next| next != number);
                    if let Some(next) = next.and_then(|next| self.spot(domain, next)) {
                        self.reach(marks, next, first);
                    }
                }
            }
        }
        looks
    }

    /// The robot's place at a bit: there are as many cells before it as places.
    #[inline]
    fn place(&self, marks: &[u64], bit: usize) -> usize {
        let cells = marks.get(..self.words).unwrap_or(&[]);
        let before: u32 = cells.iter().take(bit / 64).map(|word| word.count_ones()).sum();
        let within = cells.get(bit / 64).map_or(0, |word| (word & ((1 << (bit % 64)) - 1)).count_ones());
        before.wrapping_add(within) as usize
    }
}

/// The bits beside those of a row of one word.
#[inline]
const fn beside_in_word(bits: u64, width: u32) -> u64 {
    bits << 1 | bits >> 1 | bits.wrapping_shl(width) | bits.wrapping_shr(width)
}
