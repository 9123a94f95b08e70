//! The path of a single piece, cell by cell, found and stored in borrowed words.
//!
//! Two arrays of 16-bit entries: for each cell the previous one (once the path is found, the next one), and the cells in the order in which
//! they were met. Entries are one more than a cell; 0 is none.

use crate::oomdp::CellId;
use crate::planning::bits::{entry, entry_words, set_entry};

/// A path stored in words that otherwise hold zeros, or the search for it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trail {
    from: CellId,
    cells: usize,
    /// The positions in the second array after the expanded cells, and after all met cells.
    taken: usize,
    met: usize,
}

impl Trail {
    /// Begins the search for a shortest path on a floor of `cells` cells. `None` if there are too few words.
    pub(super) fn begin(words: &mut [u64], cells: usize, from: CellId) -> Option<Self> {
        if entry_words(cells.saturating_mul(2)) > words.len() || from.index() >= cells {
            return None;
        }
        set(words, from.index(), Some(from));
        set(words, cells, Some(from));
        Some(Self { from, cells, taken: cells, met: cells.wrapping_add(1) })
    }

    /// Continues the search for a cell where `is_goal` holds, with at most `left` cells. Returns whether there is a path, once that is
    /// known.
    pub(super) fn find_on<I: Iterator<Item = CellId>>(
        &mut self,
        words: &mut [u64],
        left: &mut u32,
        beside: impl Fn(CellId) -> I,
        is_goal: impl Fn(CellId) -> bool,
    ) -> Option<bool> {
        while self.taken < self.met {
            if *left == 0 {
                return None;
            }
            *left = left.saturating_sub(1);
            let Some(cell) = get(words, self.taken) else { break };
            self.taken = self.taken.wrapping_add(1);
            if is_goal(cell) {
                self.turn(words, cell);
                return Some(true);
            }
            for next in beside(cell) {
                if next.index() < self.cells && get(words, next.index()).is_none() {
                    set(words, next.index(), Some(cell));
                    set(words, self.met, Some(next));
                    self.met = self.met.wrapping_add(1);
                }
            }
        }
        Some(false)
    }

    /// Turns the pointers: each cell of the path then points to the next one.
    fn turn(self, words: &mut [u64], to: CellId) {
        let (mut cell, mut after) = (to, None);
        while let Some(before) = get(words, cell.index()) {
            set(words, cell.index(), after);
            if cell == self.from {
                break;
            }
            (after, cell) = (Some(cell), before);
        }
    }

    /// The next cell of the path.
    pub(super) fn next(self, words: &[u64], cell: CellId) -> Option<CellId> {
        get(words, cell.index())
    }

    /// The cells of the path, from its start.
    pub(super) fn cells(self, words: &[u64]) -> impl Iterator<Item = CellId> {
        core::iter::successors(Some(self.from), move |&cell| self.next(words, cell))
    }

    /// Fills the words with zeros.
    pub(super) fn clear(self, words: &mut [u64]) {
        words.get_mut(..entry_words(self.cells.saturating_mul(2))).unwrap_or(&mut []).fill(0);
    }
}

fn get(words: &[u64], at: usize) -> Option<CellId> {
    entry(words, at).checked_sub(1).map(CellId)
}

fn set(words: &mut [u64], at: usize, cell: Option<CellId>) {
    set_entry(words, at, cell.map_or(0, |cell| cell.0.wrapping_add(1)));
}
