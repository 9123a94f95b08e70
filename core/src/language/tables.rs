//! The parameters: two tables of numbers, `translations` and `alignments`, and the expected count of each number.
//!
//! Each model defines its parts of them in its own folder: [`ibm2`](super::ibm2) and [`roles::layout`](super::roles::layout).

use super::roles::Layout;
use crate::capacity::{Capacities, Capacity, CapacityError};
use crate::memory::{ParameterTables, ParameterTablesRef};
use crate::symbols::Symbol;

/// The parameters that the present training data need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Wanted {
    /// Model 2's: the number of pairs of lengths with an alignment table.
    pub(super) length_pairs: usize,
    /// The role model's.
    pub(super) layout: Layout,
}

impl Wanted {
    /// No parameters.
    pub(super) const NONE: Self = Self { length_pairs: 0, layout: Layout::NONE };
}

/// The extent of the trained parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Trained {
    /// V: the English words in the training data.
    pub(super) words: usize,
    /// The machine tokens in the training data, NULL not counted.
    pub(super) tokens: usize,
    /// The layout of the role model's trained parameters.
    pub(super) layout: Layout,
    pub(super) wanted: Wanted,
}

impl Trained {
    /// No parameters.
    pub(crate) const NONE: Self = Self { words: 0, tokens: 0, layout: Layout::NONE, wanted: Wanted::NONE };
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

/// The cells that can be trained with this many words for the expected counts. A robot that only obeys needs no counts.
const fn countable(counts: usize) -> usize {
    if cfg!(feature = "learning") { counts.saturating_mul(2) } else { usize::MAX }
}

/// The parameters, and room for the expected counts of the next round.
#[derive(Debug)]
pub struct Tables<'t> {
    pub(super) memory: ParameterTables<'t>,
    /// The expected counts of all cells, two to a word. Their contents are unspecified between trainings.
    counts: &'t mut [u64],
    pub(super) trained: &'t mut Trained,
}

/// The parameters, read-only.
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct TablesRef<'t> {
    pub(super) memory: ParameterTablesRef<'t>,
    pub(super) trained: &'t Trained,
}

impl<'t> Tables<'t> {
    /// The parameters in the extent `trained`. Cells without room for their counts are left out.
    pub(crate) fn new(mut memory: ParameterTables<'t>, counts: &'t mut [u64], trained: &'t mut Trained) -> Self {
        let cells = countable(counts.len());
        memory.translations = first(memory.translations, cells);
        memory.alignments = first(memory.alignments, cells.saturating_sub(memory.translations.len()));
        Self { memory, counts, trained }
    }

    /// The parameters, read-only.
    pub const fn read(&self) -> TablesRef<'_> {
        TablesRef { memory: self.memory.read(), trained: self.trained }
    }

    /// The parameters with their counts: t and its counts, then a and its counts.
    pub(super) fn parts(&mut self) -> (Cells<'_>, Cells<'_>) {
        let counts: &mut [f32] = bytemuck::try_cast_slice_mut(self.counts).unwrap_or(&mut []);
        let memory = &mut self.memory;
        let (of_translations, of_alignments) = counts.split_at_mut_checked(memory.translations.len()).unwrap_or((&mut [], &mut []));
        (Cells { values: memory.translations, counts: of_translations }, Cells { values: memory.alignments, counts: of_alignments })
    }

    /// Whether there is room for a row of `words` for NULL, or the background, and for one row per token.
    pub(super) fn fits_rows(&self, tokens: usize, words: usize) -> Result<(), CapacityError> {
        let cells = tokens.saturating_add(1).saturating_mul(words);
        let room = self.memory.translations.len();
        Capacity::Translations.fits(cells, room)
    }

    /// Takes over the role model's parameters from another robot: the cells of both tables, one after the other.
    pub(super) fn take_over(&mut self, layout: Layout, cells: impl Iterator<Item = f32>) {
        let wanted = Wanted { layout, ..Wanted::NONE };
        *self.trained = Trained { words: layout.words(), tokens: layout.tokens(), layout, wanted };
        let translations = first(self.memory.translations, layout.translations());
        let alignments = first(self.memory.alignments, layout.trellis_start());
        translations.iter_mut().chain(alignments).zip(cells).for_each(|(slot, cell)| *slot = cell);
    }

    /// Clears the counts of the cells in use.
    pub(super) fn clear_counts(&mut self) {
        let translations = self.trained.tokens.saturating_add(1).saturating_mul(self.trained.words);
        let alignments = self.read().alignments_end().max(self.trained.layout.cells());
        let (t, a) = self.parts();
        t.counts.get_mut(..translations).unwrap_or(&mut []).fill(0.0);
        a.counts.get_mut(..alignments).unwrap_or(&mut []).fill(0.0);
    }
}

impl<'t> TablesRef<'t> {
    /// The role model's parameters.
    pub const fn layout(self) -> &'t Layout {
        &self.trained.layout
    }

    /// The cells of both tables.
    pub const fn cells(&self) -> (&'t [f32], &'t [f32]) {
        (self.memory.translations, self.memory.alignments)
    }

    /// The parameters in the extent `trained`, with room for the counts of `cells` cells.
    pub(crate) fn new(mut memory: ParameterTablesRef<'t>, counts: usize, trained: &'t Trained) -> Self {
        let cells = countable(counts);
        memory.translations = memory.translations.get(..cells).unwrap_or(memory.translations);
        memory.alignments = memory.alignments.get(..cells.saturating_sub(memory.translations.len())).unwrap_or(memory.alignments);
        Self { memory, trained }
    }

    /// The sizes of the tables.
    pub(super) const fn room(self, rooms: &mut Capacities) {
        rooms.translations = self.memory.translations.len();
        rooms.alignments = self.memory.alignments.len();
        rooms.length_pairs = self.memory.length_pairs.len();
    }

    /// The used parts of the tables.
    pub(super) fn usage(self, used: &mut Capacities) {
        used.translations = self.trained.tokens.saturating_add(1).saturating_mul(self.trained.words);
        let alignments = self.alignments_end().max(self.trained.wanted.layout.cells());
        (used.alignments, used.length_pairs) = (alignments, self.trained.wanted.length_pairs);
    }

    /// V: the number of English words in the training; 0 for an untrained model.
    pub const fn words(self) -> usize {
        self.trained.words
    }

    /// The share of a command's words that were not in the training, from 0 to 1.
    pub fn unknown_share(self, sentence: &[Option<Symbol>]) -> f32 {
        let known = sentence.iter().flatten().filter(|word| word.index() < self.words()).count();
        1.0 - known as f32 / sentence.len().max(1) as f32
    }

    /// The number of machine tokens in the training, NULL not counted.
    pub const fn tokens(self) -> usize {
        self.trained.tokens
    }
}
