//! The way of one piece alone, from cell to cell, found and kept in borrowed words.
//!
//! Two arrays of 16-bit entries: for each cell the one before it (once the way is found, the next on it), and the cells in the order in
//! which they were met. Entries are one more than a cell; 0 is none.

use crate::oomdp::CellId;
use crate::planning::bits::{entry, entry_words, set_entry};

/// A way that is kept in words, which hold zeros otherwise.
#[derive(Debug)]
pub(super) struct Trail<'t> {
    words: &'t mut [u64],
    from: CellId,
}

impl<'t> Trail<'t> {
    /// Finds a shortest way on a floor of so many cells to one where `is_goal` holds. `None` where there is none or the words are too few.
    pub(super) fn find<I: Iterator<Item = CellId>>(
        scratch: &'t mut [u64],
        cells: usize,
        from: CellId,
        beside: impl Fn(CellId) -> I,
        is_goal: impl Fn(CellId) -> bool,
    ) -> Option<Self> {
        let words = scratch.get_mut(..entry_words(cells.saturating_mul(2))).filter(|_| from.index() < cells)?;
        let trail = Self { words, from };
        set(trail.words, from.index(), Some(from));
        set(trail.words, cells, Some(from));
        let (mut taken, mut met) = (cells, cells.wrapping_add(1));
        while taken < met {
            let Some(cell) = get(trail.words, taken) else { break };
            taken = taken.wrapping_add(1);
            if is_goal(cell) {
                return Some(trail.turned(cell));
            }
            for next in beside(cell) {
                if next.index() < cells && get(trail.words, next.index()).is_none() {
                    set(trail.words, next.index(), Some(cell));
                    set(trail.words, met, Some(next));
                    met = met.wrapping_add(1);
                }
            }
        }
        None
    }

    /// Each cell of the way points to the next, no longer to the one before.
    fn turned(self, to: CellId) -> Self {
        let (mut cell, mut after) = (to, None);
        while let Some(before) = get(self.words, cell.index()) {
            set(self.words, cell.index(), after);
            if cell == self.from {
                break;
            }
            (after, cell) = (Some(cell), before);
        }
        self
    }

    /// The next cell of the way.
    pub(super) fn next(&self, cell: CellId) -> Option<CellId> {
        get(self.words, cell.index())
    }

    /// The cells of the way, from its start.
    pub(super) fn cells(&self) -> impl Iterator<Item = CellId> {
        core::iter::successors(Some(self.from), |&cell| self.next(cell))
    }
}

impl Drop for Trail<'_> {
    fn drop(&mut self) {
        self.words.fill(0);
    }
}

fn get(words: &[u64], at: usize) -> Option<CellId> {
    entry(words, at).checked_sub(1).map(CellId)
}

fn set(words: &mut [u64], at: usize, cell: Option<CellId>) {
    set_entry(words, at, cell.map_or(0, |cell| cell.0.wrapping_add(1)));
}
