//! Memory for the training data: the parameters that their descriptions need.

use super::layout::Layout;
use crate::capacity::{Capacities, Capacity, CapacityError};
use crate::language::bitext::{Alone, Bitext, LEAST_KEPT, LIGHT};
use crate::language::tables::Tables;
use crate::symbols::Symbol;

impl Tables<'_> {
    /// Checks that these parameters fit.
    pub(in crate::language) fn fits(&self, layout: &Layout) -> Result<(), CapacityError> {
        self.fits_rows(layout.tokens(), layout.words())?;
        let (room, cells) = (self.memory.alignments.len(), layout.cells());
        Capacity::Alignments.fits(cells, room)
    }

    /// Extends the layout by a description and a command of `length` words, in vocabularies of this many words and machine tokens.
    ///
    /// # Errors
    /// A [`CapacityError`] if it does not fit; nothing has changed then.
    pub(in crate::language) fn add_description(
        &mut self,
        description: &[Symbol],
        length: usize,
        words: usize,
        tokens: usize,
    ) -> Result<(), CapacityError> {
        let mut wanted = self.trained.wanted.layout;
        wanted.see(description);
        wanted.see_length(length);
        let wanted = wanted.with(words, tokens);
        self.fits(&wanted)?;
        self.trained.wanted.layout = wanted;
        Ok(())
    }
}

/// Adds a session. If not all of its descriptions fit, the lighter ones are left out. Memory for the parameters is checked later, together
/// with the vocabulary.
///
/// # Errors
/// A [`CapacityError`]; part of the session may have been added.
pub(crate) fn add<'a, I: Iterator<Item = (&'a [Symbol], f32)>>(
    bitext: &mut Bitext<'_>,
    words: &[Symbol],
    pairs: impl Fn() -> I,
) -> Result<(), CapacityError> {
    let before = bitext.extent();
    let Err(full) = add_heavy(bitext, words, &pairs, 0.0, 1.0) else { return Ok(()) };
    bitext.rewind(before);
    let kept: f32 = pairs().map(|(_, weight)| weight).filter(|&weight| weight >= LIGHT).sum();
    if kept < LEAST_KEPT { Err(full) } else { add_heavy(bitext, words, &pairs, LIGHT, kept) }
}

fn add_heavy<'a, I: Iterator<Item = (&'a [Symbol], f32)>>(
    bitext: &mut Bitext<'_>,
    words: &[Symbol],
    pairs: &impl Fn() -> I,
    least: f32,
    whole: f32,
) -> Result<(), CapacityError> {
    bitext.add_session(words)?;
    pairs().filter(|&(_, weight)| weight >= least).try_for_each(|(description, weight)| bitext.add_pair(description, weight / whole))
}

/// The capacities that a session needs by itself: with all its descriptions, or with the heavier ones only, as [`add`] would keep them in
/// empty tables of these sizes.
pub(crate) fn needs_alone<'a, I: Iterator<Item = (&'a [Symbol], f32)>>(
    alone: &Alone,
    rooms: &Capacities,
    pairs: &impl Fn() -> I,
) -> Capacities {
    let all = needs(alone, pairs());
    let kept: f32 = pairs().map(|(_, weight)| weight).filter(|&weight| weight >= LIGHT).sum();
    let fits = all.pairs <= rooms.pairs && all.commands <= rooms.commands && all.command_tokens <= rooms.command_tokens;
    if fits || kept < LEAST_KEPT { all } else { needs(alone, pairs().filter(|&(_, weight)| weight >= LIGHT)) }
}

fn needs<'a>(alone: &Alone, pairs: impl Iterator<Item = (&'a [Symbol], f32)>) -> Capacities {
    let mut layout = Layout::NONE;
    layout.see_length(alone.sentence);
    let (mut count, mut command_tokens) = (0_usize, 0_usize);
    for (description, _) in pairs {
        layout.see(description);
        count = count.saturating_add(1);
        command_tokens = command_tokens.saturating_add(description.len());
    }
    let layout = layout.with(alone.words, alone.tokens);
    Capacities { pairs: count, commands: count, command_tokens, alignments: layout.cells(), ..Capacities::NONE }
}
