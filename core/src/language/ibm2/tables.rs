//! The parameter tables: translation probabilities t(word | token) and alignment probabilities a(j | i, l, n).
//!
//! Position 0 of every machine command is NULL. The translation table has one row for NULL and one per machine token, and one column per
//! English word. Each pair of lengths l, n in the training data has its own n rows of l + 1 alignment probabilities.

use crate::capacity::{Capacity, CapacityError};
use crate::language::tables::{Tables, TablesRef};
use crate::symbols::Symbol;

/// A pair of lengths, and the position of its alignment table.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(hidden)]
pub struct LengthPair {
    /// l: the number of machine tokens.
    pub machine: u8,
    /// n: the number of English words.
    pub english: u8,
    pub(super) start: u32,
    pub(super) trained: bool,
    /// The total weight of the training pairs of these lengths.
    pub weight: f32,
}

impl LengthPair {
    /// The value of unused memory.
    pub const UNUSED: Self = Self { machine: 0, english: 0, start: 0, trained: false, weight: 0.0 };

    pub(super) const fn cells(&self) -> usize {
        (self.machine as usize + 1) * self.english as usize
    }

    fn is_of(&self, machine: usize, english: usize) -> bool {
        usize::from(self.machine) == machine && usize::from(self.english) == english
    }
}

/// The translations into one word: a column of the table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Column<'t> {
    cells: &'t [f32],
    stride: usize,
    rows: usize,
    unseen: f32,
}

impl Column<'_> {
    /// t(word | token), by the token's row.
    #[inline]
    pub(super) fn translation(&self, row: usize) -> f32 {
        if row > self.rows { self.unseen } else { self.cells.get(row.wrapping_mul(self.stride)).copied().unwrap_or(0.0) }
    }
}

impl Tables<'_> {
    /// Adds an alignment table for a pair of lengths if there is none. A new one stays uniform until the next training.
    pub(in crate::language) fn add_lengths(&mut self, machine: usize, english: usize) -> Result<(), CapacityError> {
        if self.read().length_pair(machine, english).is_some() {
            return Ok(());
        }
        let start = self.read().alignments_end();
        let pair = LengthPair { machine: machine as u8, english: english as u8, start: start as u32, trained: false, weight: 0.0 };
        let end = start.saturating_add(pair.cells());
        let room = self.memory.alignments.len();
        Capacity::Alignments.fits(end, room)?;
        let limit = self.memory.length_pairs.len();
        let Some(slot) = self.memory.length_pairs.get_mut(self.trained.wanted.length_pairs) else {
            return Err(CapacityError::full(Capacity::LengthPairs, limit));
        };
        *slot = pair;
        // If a training is under way, it has not cleared these counts.
        let (_, a) = self.parts();
        a.counts.get_mut(start..end).unwrap_or(&mut []).fill(0.0);
        self.trained.wanted.length_pairs = self.trained.wanted.length_pairs.saturating_add(1);
        Ok(())
    }

    pub(super) fn length_pair_mut(&mut self, machine: usize, english: usize) -> Option<&mut LengthPair> {
        self.memory.length_pairs.iter_mut().take(self.trained.wanted.length_pairs).find(|pair| pair.is_of(machine, english))
    }
}

impl<'t> TablesRef<'t> {
    /// The end of the last alignment table.
    pub(in crate::language) fn alignments_end(self) -> usize {
        self.length_pairs().last().map_or(0, |last| (last.start as usize).saturating_add(last.cells()))
    }

    /// The pairs of lengths in the training data.
    pub fn length_pairs(self) -> &'t [LengthPair] {
        self.memory.length_pairs.get(..self.trained.wanted.length_pairs).unwrap_or(&[])
    }

    /// The row of a token in the translation table.
    pub(super) fn row(token: Option<Symbol>) -> usize {
        token.map_or(0, |token| token.index().saturating_add(1))
    }

    /// t(word | token), NULL for `None`: 1/V for a token never seen, 0 for a word never seen.
    pub fn translation(self, word: Symbol, token: Option<Symbol>) -> f32 {
        if word.index() >= self.trained.words { 0.0 } else { self.column(word).translation(Self::row(token)) }
    }

    /// The translations into one word, which must be one that the parameters were trained on.
    #[inline]
    pub(super) fn column(self, word: Symbol) -> Column<'t> {
        let cells = self.memory.translations.get(word.index()..).unwrap_or(&[]);
        Column { cells, stride: self.trained.words, rows: self.trained.tokens, unseen: 1.0 / self.trained.words.max(1) as f32 }
    }

    /// The trained alignment table of a pair of lengths: n rows of l + 1.
    pub(super) fn alignment_table(self, machine: usize, english: usize) -> Option<&'t [f32]> {
        let pair = self.length_pair(machine, english).filter(|pair| pair.trained)?;
        let start = pair.start as usize;
        self.memory.alignments.get(start..start.saturating_add(pair.cells()))
    }

    pub(super) fn length_pair(self, machine: usize, english: usize) -> Option<&'t LengthPair> {
        self.length_pairs().iter().find(|pair| pair.is_of(machine, english))
    }

    /// a(j | i, l, n), for j from 0 to l and i from 0 to n - 1: uniform for lengths never seen.
    pub fn alignment(self, j: usize, i: usize, machine: usize, english: usize) -> f32 {
        let width = machine.saturating_add(1);
        match self.alignment_table(machine, english) {
            Some(table) => table.get(i.saturating_mul(width).saturating_add(j)).copied().filter(|_| j < width).unwrap_or(0.0),
            None => 1.0 / width as f32,
        }
    }
}
