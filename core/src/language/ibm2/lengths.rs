//! Counts pairs of lengths without a table, to tell how much memory their alignments will take.

use crate::capacity::TOKENS_PER_COMMAND;

/// The pairs of lengths seen so far.
pub(crate) struct SeenLengths {
    /// One bit for each length of an English command from 1 to 64, by the length of the machine command.
    seen: [u64; TOKENS_PER_COMMAND + 1],
    /// One bit for each length of a machine command that came with an empty English command.
    wordless: u64,
    /// The number of pairs.
    pub pairs: usize,
    /// The number of cells of their alignment tables together.
    pub cells: usize,
}

impl SeenLengths {
    pub fn new() -> Self {
        Self { seen: [0; TOKENS_PER_COMMAND + 1], wordless: 0, pairs: 0, cells: 0 }
    }

    pub fn see(&mut self, machine: usize, english: usize) {
        let _ = self.see_within(machine, english, usize::MAX, usize::MAX);
    }

    /// Sees a pair of lengths, unless it is new and the alignments of all would take more than this. Returns whether it is seen.
    pub fn see_within(&mut self, machine: usize, english: usize, most_pairs: usize, most_cells: usize) -> bool {
        let (seen, position) = match english.checked_sub(1) {
            Some(position) => (self.seen.get_mut(machine), position),
            None => (Some(&mut self.wordless), machine),
        };
        let bit = 1_u64.checked_shl(position as u32).unwrap_or(0);
        let Some(seen) = seen.filter(|seen| **seen & bit == 0) else { return true };
        let cells = self.cells.saturating_add(machine.saturating_add(1).saturating_mul(english));
        if self.pairs >= most_pairs || cells > most_cells {
            return false;
        }
        *seen |= bit;
        self.pairs = self.pairs.saturating_add(1);
        self.cells = cells;
        true
    }
}
