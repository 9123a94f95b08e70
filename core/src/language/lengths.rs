//! Which pairs of lengths there are, counted without a table: what the alignments of some data will take.

/// The most tokens of one of Model 2's machine commands: four propositions with three arguments, and eight facts of two tokens.
const MOST_TOKENS: usize = 32;

/// The pairs of lengths seen so far, one bit each.
pub(crate) struct SeenLengths {
    seen: [u128; MOST_TOKENS + 1],
    /// How many.
    pub pairs: usize,
    /// Cells of their alignment tables together.
    pub cells: usize,
}

impl SeenLengths {
    pub fn new() -> Self {
        Self { seen: [0; MOST_TOKENS + 1], pairs: 0, cells: 0 }
    }

    pub fn see(&mut self, machine: usize, english: usize) {
        let bit = 1_u128.checked_shl(english as u32).unwrap_or(0);
        let Some(seen) = self.seen.get_mut(machine).filter(|seen| **seen & bit == 0) else { return };
        *seen |= bit;
        self.pairs = self.pairs.saturating_add(1);
        self.cells = self.cells.saturating_add(machine.saturating_add(1).saturating_mul(english));
    }
}
