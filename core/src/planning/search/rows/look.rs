//! One row's states of the distance under way, all at once.

use super::{Findings, HOPEFUL, Rows};
use crate::oomdp::{Action, ActionSet, Domain};
use crate::planning::GoalTable;

impl Rows {
    /// Looks at all states of one row at the distance under way; gives `None` where no row is left.
    #[inline]
    pub(in super::super) fn look<D: Domain + ?Sized>(
        &mut self,
        marks: &mut [u64],
        found: &mut Findings<'_>,
        domain: &D,
        goals: &GoalTable<'_>,
    ) -> Option<u32> {
        let row = self.take(marks)?;
        Some(match (self.words, self.actions) {
            // What most homes have, as straight lines.
            (1, 4) => self.expand(marks, found, domain, goals, row, 1, 4),
            (words, actions) => self.expand(marks, found, domain, goals, row, words, actions),
        })
    }

    /// Takes the next row that has a state at the distance under way.
    #[inline]
    fn take(&mut self, marks: &mut [u64]) -> Option<usize> {
        let start = self.set_at(self.parity);
        let set = marks.get_mut(start..start.wrapping_add(self.set()))?;
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

    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "what is borrowed apart, and what is constant where it is called")]
    fn expand<D: Domain + ?Sized>(
        &mut self,
        marks: &mut [u64],
        found: &mut Findings<'_>,
        domain: &D,
        goals: &GoalTable<'_>,
        row: usize,
        words: usize,
        actions: usize,
    ) -> u32 {
        let state = domain.numbered((row as u64).wrapping_mul(self.places as u64));
        let (here, next) = self.frontiers();
        let Some((front, rows)) = marks.split_at_mut_checked(self.rows_at()) else { return 1 };
        let stride = words.wrapping_mul(actions.wrapping_add(2));
        let start = row.wrapping_mul(stride);
        let Some(planes) = rows.get_mut(start..start.wrapping_add(stride)) else { return 1 };
        let (mut opened, mut touched) = (0, 0);
        for word in 0..words {
            let at = |plane: usize| plane.wrapping_mul(words).wrapping_add(word);
            let get = |planes: &[u64], at: usize| planes.get(at).copied().unwrap_or(0);
            let taken = self.taken(domain, &state, word);
            let reached = self.beside(words, word, |word| get(planes, here.wrapping_mul(words).wrapping_add(word)));
            let known = (0..actions).fold(0, |all, action| all | get(planes, at(action)));
            let free = get(front, self.cells_at(1).wrapping_add(word));
            let new = reached & free & !taken & !(known & !get(planes, at(next)));
            touched |= reached & taken;
            if new != 0 {
                for action in 0..actions {
                    let ways = self.beside(words, word, |word| {
                        get(planes, action.wrapping_mul(words).wrapping_add(word))
                            & get(planes, here.wrapping_mul(words).wrapping_add(word))
                    });
                    if let Some(plane) = planes.get_mut(at(action)) {
                        *plane |= ways & new;
                    }
                }
                if let Some(plane) = planes.get_mut(at(next)) {
                    *plane |= new;
                }
                opened |= new;
            }
        }
        if opened != 0 {
            self.open(marks, row);
        }
        self.meet(marks, found, domain, goals, &state, row, words, actions);
        let looks = if touched == 0 { 1 } else { self.act(marks, domain, &state, row, words, actions) };
        let done = self.row_at(row).wrapping_add(here.wrapping_mul(words));
        marks.get_mut(done..done.wrapping_add(words)).unwrap_or(&mut []).fill(0);
        looks
    }

    /// The bits of a word that are taken.
    #[inline(always)]
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

    /// The bits of one word that are beside the bits of a plane.
    #[inline(always)]
    fn beside(&self, words: usize, word: usize, plane: impl Fn(usize) -> u64) -> u64 {
        let bits = plane(word);
        if words == 1 {
            let width = self.grid.width as u32;
            return bits << 1 | bits >> 1 | bits.checked_shl(width).unwrap_or(0) | bits.checked_shr(width).unwrap_or(0);
        }
        let (far, near) = (self.grid.width / 64, (self.grid.width % 64) as u32);
        // Beyond the first and the last word there is nothing.
        let (before, after) = (
            |by: usize| word.checked_sub(by).map_or(0, &plane),
            |by: usize| {
                let word = word.wrapping_add(by);
                if word < words { plane(word) } else { 0 }
            },
        );
        let over = 63_u32.wrapping_sub(near);
        let up = before(far) << near | before(far.wrapping_add(1)) >> 1 >> over;
        let down = after(far) >> near | after(far.wrapping_add(1)) << 1 << over;
        bits << 1 | before(1) >> 63 | bits >> 1 | after(1) << 63 | up | down
    }

    /// Finds the tasks that hold in the row's states of the distance under way.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "what is borrowed apart, and what is constant where it is called")]
    fn meet<D: Domain + ?Sized>(
        &self,
        marks: &mut [u64],
        found: &mut Findings<'_>,
        domain: &D,
        goals: &GoalTable<'_>,
        state: &D::State,
        row: usize,
        words: usize,
        actions: usize,
    ) {
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
                let met = plane(self.frontiers().0, word) & cells;
                if met != 0 {
                    let first = (0..actions).filter(|&action| plane(action, word) & met != 0);
                    found.meet(task, first.fold(ActionSet::EMPTY, |set, action| set.with(Action(action as u8))));
                }
            }
        }
    }

    /// Does what the robot can do to what is taken beside it. Gives the looks it took.
    fn act<D: Domain + ?Sized>(
        &mut self,
        marks: &mut [u64],
        domain: &D,
        state: &D::State,
        row: usize,
        words: usize,
        actions: usize,
    ) -> u32 {
        let planes = self.row_at(row);
        let mut looks = 1_u32;
        for variable in 1..domain.variables() {
            let Some(taken) = domain.taken(state, variable).map(|place| domain.bit_of(place)) else { continue };
            for (direction, toward) in self.grid.directions.into_iter().enumerate() {
                let shift = self.grid.shift(direction);
                let Some(bit) = taken.checked_add_signed(shift.wrapping_neg()).filter(|&bit| bit < self.grid.bits) else { continue };
                let has = |marks: &[u64], plane: usize| {
                    let word = planes.wrapping_add(plane.wrapping_mul(words)).wrapping_add(bit / 64);
                    marks.get(word).is_some_and(|word| word >> (bit % 64) & 1 == 1)
                };
                if !has(marks, self.frontiers().0) {
                    continue;
                }
                let first = (0..actions).filter(|&action| has(marks, action));
                let first = first.fold(ActionSet::EMPTY, |set, action| set.with(Action(action as u8)));
                let place = self.place(marks, bit);
                let here = domain.with_value(state, 0, place);
                let number = (row as u64).wrapping_mul(self.places as u64).wrapping_add(place as u64);
                for action in self.others.with(toward).iter() {
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
