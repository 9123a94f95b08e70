//! IBM Model 2's parameters: translation probabilities t(word | token) and alignment probabilities a(j | i, l, n).
//!
//! Position 0 of every machine command is NULL. The translation table has a row for NULL and one for each machine token, a column for
//! each English word. Each pair of lengths l, n that the data have has its own n rows of l + 1 alignment probabilities.

use super::roles::Layout;
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

crate::memory::tables! {
    /// The tables of the parameters.
    ParameterTables,
    /// The tables of the parameters, to be read.
    ParameterTablesRef {
        /// t(word | token).
        translations: f32,
        /// a(j | i, l, n).
        alignments: f32,
        /// One entry a pair of lengths.
        length_pairs: LengthPair,
    }
}

/// How much of the tables is in use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Trained {
    pub(super) length_pairs: usize,
    /// V: English words that the parameters were trained on.
    pub(super) words: usize,
    /// Machine tokens that they were trained on, NULL not counted.
    pub(super) tokens: usize,
    /// The role model's parameters that were trained.
    pub(super) layout: Layout,
    /// Those that the training data now would have.
    pub(super) wanted: Layout,
}

impl Trained {
    /// Nothing is in use.
    pub(crate) const NONE: Self = Self { length_pairs: 0, words: 0, tokens: 0, layout: Layout::NONE, wanted: Layout::NONE };
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

/// Parameters, and the expected count of each.
#[derive(Debug)]
pub(crate) struct Cells<'t> {
    pub values: &'t mut [f32],
    pub counts: &'t mut [f32],
}

fn first<T>(all: &mut [T], most: usize) -> &mut [T] {
    let count = all.len().min(most);
    all.get_mut(..count).unwrap_or(&mut [])
}

/// The parameters, and room for the expected counts of the next round.
#[derive(Debug)]
pub struct Tables<'t> {
    pub(super) memory: ParameterTables<'t>,
    /// The expected counts of all cells, two to a word. Their contents are unspecified between trainings.
    counts: &'t mut [u64],
    pub(super) trained: &'t mut Trained,
}

/// The parameters, to be read.
#[derive(Clone, Copy, Debug)]
pub struct TablesRef<'t> {
    memory: ParameterTablesRef<'t>,
    trained: &'t Trained,
}

impl<'t> Tables<'t> {
    /// The parameters that `trained` says are there. Cells beyond those that can be counted are left out.
    pub(crate) fn new(mut memory: ParameterTables<'t>, counts: &'t mut [u64], trained: &'t mut Trained) -> Self {
        let cells = counts.len().saturating_mul(2);
        memory.translations = first(memory.translations, cells);
        memory.alignments = first(memory.alignments, cells.saturating_sub(memory.translations.len()));
        Self { memory, counts, trained }
    }

    /// The parameters, to be read.
    pub const fn read(&self) -> TablesRef<'_> {
        TablesRef { memory: self.memory.read(), trained: self.trained }
    }

    /// The parameters, and the counts of each: t and its counts, then a and its counts.
    pub(super) fn parts(&mut self) -> (Cells<'_>, Cells<'_>) {
        let counts: &mut [f32] = bytemuck::try_cast_slice_mut(self.counts).unwrap_or(&mut []);
        let memory = &mut self.memory;
        let (of_translations, of_alignments) = counts.split_at_mut_checked(memory.translations.len()).unwrap_or((&mut [], &mut []));
        (Cells { values: memory.translations, counts: of_translations }, Cells { values: memory.alignments, counts: of_alignments })
    }

    /// Begins to count, in the cells that are in use.
    pub(super) fn clear_counts(&mut self) {
        let translations = self.trained.tokens.saturating_add(1).saturating_mul(self.trained.words);
        let alignments = self.read().alignments_end().max(self.trained.layout.cells());
        let (t, a) = self.parts();
        t.counts.get_mut(..translations).unwrap_or(&mut []).fill(0.0);
        a.counts.get_mut(..alignments).unwrap_or(&mut []).fill(0.0);
    }

    /// Makes sure that there is an alignment table for a pair of lengths. A new one stays uniform until the next training.
    pub(super) fn add_lengths(&mut self, machine: usize, english: usize) -> Result<(), CapacityError> {
        if self.read().length_pair(machine, english).is_some() {
            return Ok(());
        }
        let start = self.read().alignments_end();
        let pair = LengthPair { machine: machine as u8, english: english as u8, start: start as u32, trained: false, weight: 0.0 };
        let end = start.saturating_add(pair.cells());
        let room = self.memory.alignments.len();
        if end > room {
            return Err(CapacityError::new(Capacity::Alignments, room, end));
        }
        let limit = self.memory.length_pairs.len();
        let Some(slot) = self.memory.length_pairs.get_mut(self.trained.length_pairs) else {
            return Err(CapacityError::full(Capacity::LengthPairs, limit));
        };
        *slot = pair;
        // A training under way has not cleared them.
        let (_, a) = self.parts();
        a.counts.get_mut(start..end).unwrap_or(&mut []).fill(0.0);
        self.trained.length_pairs = self.trained.length_pairs.saturating_add(1);
        Ok(())
    }

    /// Whether the translation table has room for so many tokens (NULL not counted) and words.
    pub(super) fn fits(&self, tokens: usize, words: usize) -> Result<(), CapacityError> {
        let cells = tokens.saturating_add(1).saturating_mul(words);
        let room = self.memory.translations.len();
        if cells > room { Err(CapacityError::new(Capacity::Translations, room, cells)) } else { Ok(()) }
    }
}

impl<'t> TablesRef<'t> {
    /// Whether the tables have room for the role model's parameters.
    pub(super) fn fits_roles(self, tokens: usize, layout: &Layout) -> Result<(), CapacityError> {
        let (rows, alignments) = (self.memory.translations.len(), self.memory.alignments.len());
        let cells = tokens.saturating_add(1).saturating_mul(layout.words());
        if cells > rows {
            return Err(CapacityError::new(Capacity::Translations, rows, cells));
        }
        let cells = layout.cells();
        if cells > alignments { Err(CapacityError::new(Capacity::Alignments, alignments, cells)) } else { Ok(()) }
    }

    /// The role model's parameters.
    pub(super) const fn layout(self) -> &'t Layout {
        &self.trained.layout
    }

    /// The cells of both tables.
    pub(super) const fn cells(&self) -> (&'t [f32], &'t [f32]) {
        (self.memory.translations, self.memory.alignments)
    }

    /// The parameters that `trained` says are there, with room for the counts of so many `cells`.
    pub(crate) fn new(mut memory: ParameterTablesRef<'t>, counts: usize, trained: &'t Trained) -> Self {
        let cells = counts.saturating_mul(2);
        memory.translations = memory.translations.get(..cells).unwrap_or(memory.translations);
        memory.alignments = memory.alignments.get(..cells.saturating_sub(memory.translations.len())).unwrap_or(memory.alignments);
        Self { memory, trained }
    }

    /// Where the alignment tables end.
    fn alignments_end(self) -> usize {
        self.length_pairs().last().map_or(0, |last| (last.start as usize).saturating_add(last.cells()))
    }

    /// How much the tables hold.
    pub(super) const fn room(self, rooms: &mut Capacities) {
        rooms.translations = self.memory.translations.len();
        rooms.alignments = self.memory.alignments.len();
        rooms.length_pairs = self.memory.length_pairs.len();
    }

    /// How much of the tables is used.
    pub(super) fn usage(self, used: &mut Capacities) {
        used.translations = self.trained.tokens.saturating_add(1).saturating_mul(self.trained.words);
        let alignments = self.alignments_end().max(self.trained.wanted.cells());
        (used.alignments, used.length_pairs) = (alignments, self.trained.length_pairs);
    }

    /// V: the English words that the parameters were trained on; 0 for an untrained model.
    pub const fn words(self) -> usize {
        self.trained.words
    }

    /// The machine tokens that they were trained on, NULL not counted.
    pub const fn tokens(self) -> usize {
        self.trained.tokens
    }

    /// The pairs of lengths that the data have.
    pub fn length_pairs(self) -> &'t [LengthPair] {
        self.memory.length_pairs.get(..self.trained.length_pairs).unwrap_or(&[])
    }

    /// The row of a token in the translation table.
    pub(super) fn row(token: Option<Symbol>) -> usize {
        token.map_or(0, |token| token.index().saturating_add(1))
    }

    /// t(word | token), NULL for `None`: 1/V for a token never seen, 0 for a word never seen.
    pub fn translation(self, word: Symbol, token: Option<Symbol>) -> f32 {
        if word.index() >= self.trained.words { 0.0 } else { self.column(word).translation(Self::row(token)) }
    }

    /// The translations into one word, which the parameters were trained on.
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
        self.length_pairs().iter().find(|pair| usize::from(pair.machine) == machine && usize::from(pair.english) == english)
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
