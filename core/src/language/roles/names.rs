//! How often a word was taken for a value, as a share of the times it was heard.

use super::layout::{Layout, cell, get};
use crate::language::tables::TablesRef;
use crate::symbols::Symbol;

/// The trained tables, read for how often words were taken for values.
#[derive(Clone, Copy)]
pub struct Names<'t> {
    layout: &'t Layout,
    rows: &'t [f32],
    others: &'t [f32],
    /// The number of words in the training data, repetitions included, plus the smoothing of `set_common`.
    whole: f32,
}

impl<'t> Names<'t> {
    /// The names in trained tables; `said` is the number of words in the training data, repetitions included.
    pub fn new(tables: TablesRef<'t>, said: f32) -> Self {
        let (layout, (rows, others)) = (tables.layout(), tables.cells());
        Self { layout, rows, others, whole: said + 0.5 * layout.words() as f32 }
    }

    /// The values that words can name.
    pub fn values(self) -> impl Iterator<Item = Symbol> {
        let layout = self.layout;
        (0..layout.tokens()).map(|token| Symbol(token as u16)).filter(|&token| layout.form(token).is_none())
    }

    /// How often the word was taken for the value, divided by one more than the times it was heard; 0 for unseen words and values.
    #[inline]
    pub fn share(self, word: Symbol, value: Symbol) -> f32 {
        let row = self.layout.row(Some(value));
        if word.index() >= self.layout.words() || value.index() >= self.layout.tokens() {
            return 0.0;
        }
        // The row holds expected counts over their sum, and its novelty is 1 over that sum.
        let novelty = cell(self.others, self.layout.novelty(value.index() + 1));
        let heard = cell(get(self.others, self.layout.common()), word.index()) * self.whole + 0.5;
        if novelty > 0.0 && heard > 0.0 { cell(get(self.rows, row), word.index()) / novelty / heard } else { 0.0 }
    }
}
