//! Expands the states of one row at the current distance together.

use super::{CANDIDATES, FREE, RowSearch, Spot, WayPlanes};
use crate::oomdp::{Action, ActionSet, Piece, PushGrid};
use crate::planning::bits::take_from;
use crate::planning::goals::Goals;
use crate::planning::plan::Results;

impl RowSearch {
    /// Expands all states of one row at the current distance. Returns the number of expansions, at least the words of the row, or `None` if
    /// no row is left. `now` is the planned state.
    #[inline]
    pub(in super::super) fn expand<G: PushGrid>(
        &mut self,
        marks: &mut [u64],
        results: &mut Results<'_>,
        grid: &G,
        goals: &Goals<'_>,
        now: &G::State,
    ) -> Option<u32> {
        let row = self.take(marks)?;
        let (state, occupied) = self.state_of_row(grid, now, row);
        self.meet(marks, results, grid, goals, &state, row);
        if let Some(way) = self.way() {
            self.stay_where_avoided(marks, &way, row);
        }
        let expansions = match (self.words, self.actions) {
            // Rows of one word are common: their loops are unrolled.
            (1, 4) => self.expand_word::<4, G>(marks, grid, now, &state, row, occupied),
            (1, 5) => self.expand_word::<5, G>(marks, grid, now, &state, row, occupied),
            _ => {
                self.spread_words(marks, grid, row, &state);
                self.push(marks, grid, now, &state, row)
            }
        };
        if let Some(way) = self.way() {
            self.change_layers(marks, &way, row);
        }
        let here = self.row_at(row).wrapping_add(self.here.wrapping_mul(self.words));
        if let Some(here) = marks.get_mut(here..here.wrapping_add(self.words)) {
            here.fill(0);
        }
        Some(expansions.max(self.words as u32))
    }

    /// Removes the cells to avoid: no move leads on from them.
    fn stay_where_avoided(&self, marks: &mut [u64], way: &WayPlanes, row: usize) {
        let here = self.row_at(row).wrapping_add(self.here.wrapping_mul(self.words));
        for word in 0..self.words {
            let onward = self.floor_word(marks, way.first, word);
            if let Some(here) = marks.get_mut(here.wrapping_add(word)) {
                *here &= onward;
            }
        }
    }

    /// Moves states that were opened on cells with progress to the row of another layer.
    fn change_layers(&mut self, marks: &mut [u64], way: &WayPlanes, row: usize) {
        let layer = self.layer(row);
        for word in 0..self.words {
            let planes = self.row_at(row).wrapping_add(word);
            let next = planes.wrapping_add(self.next.wrapping_mul(self.words));
            let mut leaving = marks.get(next).copied().unwrap_or(0) & self.leaving(marks, way, layer, word);
            while leaving != 0 {
                let bit = leaving & leaving.wrapping_neg();
                leaving ^= bit;
                let (mut first, mut at) = (ActionSet::EMPTY, planes);
                for action in 0..self.actions {
                    if let Some(plane) = marks.get_mut(at) {
                        first = first.with_if(action, *plane & bit != 0);
                        *plane &= !bit;
                    }
                    at = at.wrapping_add(self.words);
                }
                if let Some(open) = marks.get_mut(next) {
                    *open &= !bit;
                }
                let to = Spot { row, bit: word.wrapping_mul(64).wrapping_add(bit.trailing_zeros() as usize) };
                let to = self.come_to(marks, to);
                self.reach(marks, to, first);
            }
        }
    }

    /// Takes the next row with a state at the current distance.
    #[inline]
    fn take(&mut self, marks: &mut [u64]) -> Option<usize> {
        let start = self.frontier_at(self.here);
        take_from(marks.get_mut(start..start.wrapping_add(self.set))?, &mut self.cursor)
    }

    /// Opens the states that the robot's moves reach within a row of one word, and moves the pieces that it can move from there. Returns
    /// the number of expansions.
    #[inline]
    fn expand_word<const ACTIONS: usize, G: PushGrid>(
        &mut self,
        marks: &mut [u64],
        grid: &G,
        now: &G::State,
        state: &G::State,
        row: usize,
        occupied: u64,
    ) -> u32 {
        let free = marks.get(self.floor_plane_at(FREE)).copied().unwrap_or(0) & !occupied;
        let Some(planes) = marks.get_mut(self.row_at(row)..) else { return 1 };
        let Some((planes, rest)) = planes.split_first_chunk_mut::<ACTIONS>() else { return 1 };
        let Some([even, odd]) = rest.first_chunk_mut::<2>() else { return 1 };
        let (here, next) = if self.here == ACTIONS { (*even, odd) } else { (*odd, even) };
        let (width, first) = (self.bits.width as u32, *planes);
        let reached = beside_in_word(here, width);
        let known = planes.iter().fold(0, |all, plane| all | plane) & !*next;
        let new = reached & free & !known;
        if new != 0 {
            for plane in planes {
                *plane |= beside_in_word(*plane & here, width) & new;
            }
            *next |= new;
            self.open(marks, row);
        }
        if reached & occupied == 0 {
            1
        } else if self.others.is_empty() && grid.pushes_plainly() {
            self.push_word(marks, grid, state, row, &first, here, occupied, free)
        } else {
            self.push(marks, grid, now, state, row)
        }
    }

    /// Pushes the pieces in a row of one word. `first` are the planes of the first actions, `here` the states at the current distance.
    #[inline]
    #[expect(clippy::too_many_arguments, reason = "what is known of the row")]
    fn push_word<const ACTIONS: usize, G: PushGrid>(
        &mut self,
        marks: &mut [u64],
        grid: &G,
        state: &G::State,
        row: usize,
        first: &[u64; ACTIONS],
        here: u64,
        occupied: u64,
        free: u64,
    ) -> u32 {
        let mut expansions = 1_u32;
        for direction in 0..4 {
            let mut beside = self.bits.ahead(here, direction) & occupied;
            let can_go = self.bits.ahead(free, direction ^ 1);
            while beside != 0 {
                let (piece, bit) = (beside & beside.wrapping_neg(), beside.trailing_zeros() as usize);
                beside ^= piece;
                expansions = expansions.wrapping_add(1);
                if piece & can_go == 0 {
                    continue;
                }
                let robot = self.bits.ahead(piece, direction ^ 1);
                let first = first.iter().rev().fold(0, |set, plane| set << 1 | u16::from(plane & robot != 0));
                if let Some(row) = self.row_after_push(grid, state, row, bit, direction) {
                    let to = self.come_to(marks, Spot { row, bit });
                    self.reach(marks, to, ActionSet::of_first_16(first));
                }
            }
        }
        expansions
    }

    /// The row after a push of the piece on this bit.
    #[inline]
    fn row_after_push<G: PushGrid>(&self, grid: &G, state: &G::State, row: usize, bit: usize, direction: usize) -> Option<usize> {
        let (floor, mut weight) = (grid.floor(), 1_usize);
        for piece in self.pieces() {
            let from = grid.cell(state, piece);
            if self.bit_of(grid, state, piece) == Some(bit) {
                let by = floor.neighbour(from, direction).index().wrapping_sub(from.index());
                return Some(row.wrapping_add(by.wrapping_mul(weight)));
            }
            weight = weight.wrapping_mul(self.bits.cells);
        }
        None
    }

    /// Opens the states that the robot's moves reach within a row of several words.
    #[inline(never)]
    fn spread_words<G: PushGrid>(&mut self, marks: &mut [u64], grid: &G, row: usize, state: &G::State) {
        let (words, free_at) = (self.words, self.floor_plane_at(FREE));
        let Some((front, rows)) = marks.split_at_mut_checked(self.rows_at) else { return };
        let Some(free) = front.get_mut(free_at..free_at.wrapping_add(words)) else { return };
        let start = row.wrapping_mul(self.stride);
        let Some(planes) = rows.get_mut(start..start.wrapping_add(self.stride)) else { return };
        let Some((planes, frontier)) = planes.split_at_mut_checked(self.actions.wrapping_mul(words)) else { return };
        let Some((even, odd)) = frontier.split_at_mut_checked(words) else { return };
        let (here, next) = if self.here == self.actions { (even, odd) } else { (odd, even) };
        // The pieces are walls meanwhile.
        let mut walls = 0_u32;
        for piece in self.pieces() {
            if let Some(bit) = self.bit_of(grid, state, piece)
                && let Some(word) = free.get_mut(bit / 64)
            {
                walls |= if *word >> (bit % 64) & 1 == 1 { piece.bit() } else { 0 };
                *word &= !(1 << (bit % 64));
            }
        }
        let mut opened = false;
        for (word, &here) in here.iter().enumerate().filter(|(_, here)| **here != 0) {
            self.bits.beside(word, here, |word, reached| {
                let (Some(free), Some(next)) = (free.get(word), next.get_mut(word)) else { return };
                let (mut new, mut at) = (reached & free, word);
                opened |= new & *next != 0;
                // Open states were reached at this distance; all other states with a first action were reached before.
                new &= !*next;
                while let Some(plane) = planes.get(at).filter(|_| new != 0) {
                    new &= !plane;
                    at = at.wrapping_add(words);
                }
                *next |= new;
                opened |= new != 0;
            });
        }
        if opened {
            for (word, &here) in here.iter().enumerate().filter(|(_, here)| **here != 0) {
                let mut plane_at = 0_usize;
                for _ in 0..self.actions {
                    let ways = planes.get(plane_at.wrapping_add(word)).copied().unwrap_or(0) & here;
                    self.bits.beside(word, ways, |word, ways| {
                        let (Some(free), Some(next)) = (free.get(word), next.get(word)) else { return };
                        if let Some(plane) = planes.get_mut(plane_at.wrapping_add(word)) {
                            *plane |= ways & free & next;
                        }
                    });
                    plane_at = plane_at.wrapping_add(words);
                }
            }
        }
        for piece in self.pieces().filter(|piece| walls & piece.bit() != 0) {
            if let Some(bit) = self.bit_of(grid, state, piece)
                && let Some(word) = free.get_mut(bit / 64)
            {
                *word |= 1 << (bit % 64);
            }
        }
        if opened {
            self.open(marks, row);
        }
    }

    #[inline]
    fn bit_of<G: PushGrid>(&self, grid: &G, state: &G::State, piece: Piece) -> Option<usize> {
        grid.floor().cells.get(grid.cell(state, piece).index()).map(|cell| self.bits.of(cell))
    }

    /// Finds the tasks that hold in the row's states at the current distance.
    #[inline]
    fn meet<G: PushGrid>(&self, marks: &mut [u64], results: &mut Results<'_>, grid: &G, goals: &Goals<'_>, state: &G::State, row: usize) {
        let (words, actions, sought) = (self.words, self.actions, results.found.sought);
        // A goal holds only in the last layer.
        if self.way().is_some_and(|way| self.layer(row).wrapping_add(1) < way.layers) {
            return;
        }
        let mut tasks = sought.common(self.only_robot);
        let candidates = self.set_at(CANDIDATES).wrapping_add(row / 64);
        if marks.get(candidates).is_some_and(|word| word >> (row % 64) & 1 == 1) {
            let allowed = |piece| goals.allowed(grid, state, piece, grid.cell(state, piece));
            let more = self.pieces().fold(sought.without(self.only_robot), |more, piece| more.common(allowed(piece)));
            // The sought tasks become fewer, so a row that is no candidate now never becomes one again.
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

    /// Moves the pieces that the robot can move from beside them. Returns the number of expansions.
    #[inline]
    fn push<G: PushGrid>(&mut self, marks: &mut [u64], grid: &G, now: &G::State, state: &G::State, row: usize) -> u32 {
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
                    first = first.with_if(action, has(at));
                    at = at.wrapping_add(self.words);
                }
                let here = grid.put(state, Piece::ROBOT, self.cell_of_bit(marks, bit));
                for action in core::iter::once(toward).chain(self.others.iter()) {
                    expansions = expansions.wrapping_add(1);
                    let next = grid.step(&here, action).filter(|next| *next != here);
                    if let Some(next) = next.and_then(|next| self.spot(grid, now, &next)) {
                        let next = self.come_to(marks, self.in_layer(next, self.layer(row)));
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
