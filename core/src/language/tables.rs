//! IBM Model 2's parameters: translation probabilities t(word | token) and alignment probabilities a(j | i, l, n).
//!
//! Position 0 of every machine command is NULL. The translation table has a row for NULL and one for each machine token, a column for
//! each English word. Each pair of lengths l, n that the data have has its own n rows of l + 1 alignment probabilities.

use crate::capacity::{Capacities, Capacity, CapacityError};
use crate::symbols::Symbol;

/// A pair of lengths and where its alignment table lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LengthPair {
    /// l: machine tokens.
    pub machine: u8,
    /// n: English words.
    pub english: u8,
    pub(super) start: u32,
    pub(super) trained: bool,
    /// The weight of the data of these lengths.
    pub weight: f32,
}

impl LengthPair {
    /// What unused memory holds.
    pub const UNUSED: Self = Self { machine: 0, english: 0, start: 0, trained: false, weight: 0.0 };

    pub(super) const fn cells(&self) -> usize {
        (self.machine as usize + 1) * self.english as usize
    }
}

/// Memory for [`Tables`].
#[derive(Debug)]
pub struct TableMemory<'m> {
    /// t(word | token).
    pub translations: &'m mut [f32],
    /// a(j | i, l, n).
    pub alignments: &'m mut [f32],
    /// The expected counts of all cells of both, two to a word. Between trainings it is no matter what is in them.
    pub counts: &'m mut [u64],
    /// One entry a pair of lengths.
    pub length_pairs: &'m mut [LengthPair],
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

impl TableMemory<'_> {
    /// The parameters, and the counts of each: t and its counts, then a and its counts.
    pub(super) fn parts(&mut self) -> (Cells<'_>, Cells<'_>) {
        let counts: &mut [f32] = bytemuck::try_cast_slice_mut(self.counts).unwrap_or(&mut []);
        let (translation_counts, alignment_counts) = counts.split_at_mut_checked(self.translations.len()).unwrap_or((&mut [], &mut []));
        (Cells { values: self.translations, counts: translation_counts }, Cells { values: self.alignments, counts: alignment_counts })
    }
}

/// Parameters, and the expected count of each.
#[derive(Debug)]
pub(super) struct Cells<'t> {
    pub values: &'t mut [f32],
    pub counts: &'t mut [f32],
}

fn first<T>(all: &mut [T], most: usize) -> &mut [T] {
    let count = all.len().min(most);
    all.get_mut(..count).unwrap_or(&mut [])
}

/// The parameters, and room for the expected counts of the next round.
#[derive(Debug)]
pub struct Tables<'m> {
    pub(super) memory: TableMemory<'m>,
    pub(super) length_pairs: usize,
    /// V: English words that the parameters were trained on.
    pub(super) words: usize,
    /// Machine tokens that they were trained on, NULL not counted.
    pub(super) tokens: usize,
}

impl<'m> Tables<'m> {
    /// Untrained parameters. Cells beyond those that can be counted are left out.
    pub fn new(mut memory: TableMemory<'m>) -> Self {
        let cells = memory.counts.len().saturating_mul(2);
        memory.translations = first(memory.translations, cells);
        memory.alignments = first(memory.alignments, cells.saturating_sub(memory.translations.len()));
        Self { memory, length_pairs: 0, words: 0, tokens: 0 }
    }

    /// Begins to count, in the cells that are in use.
    pub(super) fn clear_counts(&mut self) {
        let translations = self.tokens.saturating_add(1).saturating_mul(self.words);
        let alignments = self.alignments_end();
        let (t, a) = self.memory.parts();
        t.counts.get_mut(..translations).unwrap_or(&mut []).fill(0.0);
        a.counts.get_mut(..alignments).unwrap_or(&mut []).fill(0.0);
    }

    /// Where the alignment tables end.
    fn alignments_end(&self) -> usize {
        self.length_pairs().last().map_or(0, |last| (last.start as usize).saturating_add(last.cells()))
    }

    /// Gives the words of the counts away, until the next training.
    pub(super) fn lend_counts(&mut self) -> &'m mut [u64] {
        core::mem::take(&mut self.memory.counts)
    }

    /// Takes the words of the counts back.
    pub(super) fn take_counts(&mut self, counts: &'m mut [u64]) {
        self.memory.counts = counts;
    }

    /// How much the tables hold.
    pub(super) fn room(&self, rooms: &mut Capacities) {
        rooms.translations = self.memory.translations.len();
        rooms.alignments = self.memory.alignments.len();
        rooms.length_pairs = self.memory.length_pairs.len();
    }

    /// V: the English words that the parameters were trained on; 0 for an untrained model.
    pub fn words(&self) -> usize {
        self.words
    }

    /// The machine tokens that they were trained on, NULL not counted.
    pub fn tokens(&self) -> usize {
        self.tokens
    }

    /// The pairs of lengths that the data have.
    pub fn length_pairs(&self) -> &[LengthPair] {
        self.memory.length_pairs.get(..self.length_pairs).unwrap_or(&[])
    }

    /// The row of a token in the translation table.
    pub(super) fn row(token: Option<Symbol>) -> usize {
        token.map_or(0, |token| token.index().saturating_add(1))
    }

    /// t(word | token), NULL for `None`: 1/V for a token never seen, 0 for a word never seen.
    pub fn translation(&self, word: Symbol, token: Option<Symbol>) -> f32 {
        if word.index() >= self.words { 0.0 } else { self.column(word).translation(Self::row(token)) }
    }

    /// The translations into one word, which the parameters were trained on.
    #[inline]
    pub(super) fn column(&self, word: Symbol) -> Column<'_> {
        let cells = self.memory.translations.get(word.index()..).unwrap_or(&[]);
        Column { cells, stride: self.words, rows: self.tokens, unseen: 1.0 / self.words.max(1) as f32 }
    }

    /// The trained alignment table of a pair of lengths: n rows of l + 1.
    pub(super) fn alignment_table(&self, machine: usize, english: usize) -> Option<&[f32]> {
        let pair = self.length_pair(machine, english).filter(|pair| pair.trained)?;
        let start = pair.start as usize;
        self.memory.alignments.get(start..start.saturating_add(pair.cells()))
    }

    pub(super) fn length_pair(&self, machine: usize, english: usize) -> Option<&LengthPair> {
        self.length_pairs().iter().find(|pair| usize::from(pair.machine) == machine && usize::from(pair.english) == english)
    }

    /// a(j | i, l, n), for j from 0 to l and i from 0 to n - 1: uniform for lengths never seen.
    pub fn alignment(&self, j: usize, i: usize, machine: usize, english: usize) -> f32 {
        let width = machine.saturating_add(1);
        match self.alignment_table(machine, english) {
            Some(table) => table.get(i.saturating_mul(width).saturating_add(j)).copied().filter(|_| j < width).unwrap_or(0.0),
            None => 1.0 / width as f32,
        }
    }

    /// Makes sure that there is an alignment table for a pair of lengths. A new one stays uniform until the next training.
    pub(super) fn add_lengths(&mut self, machine: usize, english: usize) -> Result<(), CapacityError> {
        if self.length_pair(machine, english).is_some() {
            return Ok(());
        }
        let start = self.alignments_end();
        let pair = LengthPair { machine: machine as u8, english: english as u8, start: start as u32, trained: false, weight: 0.0 };
        let end = start.saturating_add(pair.cells());
        let room = self.memory.alignments.len();
        if end > room {
            return Err(CapacityError::new(Capacity::Alignments, room, end));
        }
        let limit = self.memory.length_pairs.len();
        let Some(slot) = self.memory.length_pairs.get_mut(self.length_pairs) else {
            return Err(CapacityError::full(Capacity::LengthPairs, limit));
        };
        *slot = pair;
        // A training under way has not cleared them.
        let (_, a) = self.memory.parts();
        a.counts.get_mut(start..end).unwrap_or(&mut []).fill(0.0);
        self.length_pairs = self.length_pairs.saturating_add(1);
        Ok(())
    }

    /// Whether the translation table has room for so many tokens (NULL not counted) and words.
    pub(super) fn fits(&self, tokens: usize, words: usize) -> Result<(), CapacityError> {
        let cells = tokens.saturating_add(1).saturating_mul(words);
        let room = self.memory.translations.len();
        if cells > room { Err(CapacityError::new(Capacity::Translations, room, cells)) } else { Ok(()) }
    }
}
