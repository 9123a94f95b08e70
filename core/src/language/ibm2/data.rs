//! Memory for the training data: one alignment table per pair of lengths.

use super::lengths::SeenLengths;
use crate::capacity::{Capacities, CapacityError};
use crate::language::bitext::{Alone, Bitext, BitextRef, LEAST_KEPT, LIGHT};
use crate::language::tables::{Tables, TablesRef};
use crate::symbols::Symbol;

/// Lays out the alignment tables again, for the pairs of lengths in the present training data.
///
/// # Errors
/// A [`CapacityError`] if one does not fit.
pub(crate) fn rebuild(tables: &mut Tables<'_>, bitext: BitextRef<'_>) -> Result<(), CapacityError> {
    tables.trained.wanted.length_pairs = 0;
    for pair in bitext.pairs() {
        tables.add_lengths(bitext.command(pair.command).len(), bitext.sentence(pair.session).len())?;
    }
    Ok(())
}

/// Adds a session. If the alignment tables are full, its lighter machine commands are left out if they need a table of their own.
///
/// # Errors
/// A [`CapacityError`]; part of the session may have been added.
pub(crate) fn add<'a, I: Iterator<Item = (&'a [Symbol], f32)>>(
    tables: &mut Tables<'_>,
    bitext: &mut Bitext<'_>,
    words: &[Symbol],
    pairs: impl Fn() -> I,
) -> Result<(), CapacityError> {
    bitext.add_session(words)?;
    for (command, _) in pairs().filter(|&(_, weight)| weight >= LIGHT) {
        tables.add_lengths(command.len(), words.len())?;
    }
    let mut left_out = None;
    for (command, _) in pairs() {
        left_out = tables.add_lengths(command.len(), words.len()).err().or(left_out);
    }
    let has_table = |tables: TablesRef<'_>, command: &[Symbol]| tables.length_pair(command.len(), words.len()).is_some();
    let mut kept = 1.0;
    if let Some(error) = left_out {
        kept = pairs().filter(|(command, _)| has_table(tables.read(), command)).map(|(_, weight)| weight).sum();
        if kept < LEAST_KEPT {
            return Err(error);
        }
    }
    for (command, weight) in pairs().filter(|(command, _)| has_table(tables.read(), command)) {
        bitext.add_pair(command, if left_out.is_some() { weight / kept } else { weight })?;
    }
    Ok(())
}

/// The capacities that a session needs by itself: with all its machine commands that find a table, as [`add`] would keep them in empty
/// tables of these sizes. Heavy ones need one.
pub(crate) fn needs_alone<'a, I: Iterator<Item = (&'a [Symbol], f32)>>(
    alone: &Alone,
    rooms: &Capacities,
    pairs: &impl Fn() -> I,
) -> Capacities {
    let mut lengths = SeenLengths::new();
    pairs().filter(|&(_, weight)| weight >= LIGHT).for_each(|(command, _)| lengths.see(command.len(), alone.sentence));
    let (heavy, heavy_cells) = (lengths.pairs, lengths.cells);
    let (mut count, mut command_tokens, mut kept) = (0_usize, 0_usize, 0.0);
    for (command, weight) in pairs() {
        if !lengths.see_within(command.len(), alone.sentence, rooms.length_pairs.max(heavy), rooms.alignments.max(heavy_cells)) {
            continue;
        }
        count = count.saturating_add(1);
        command_tokens = command_tokens.saturating_add(command.len());
        kept += weight;
    }
    // Too little is left: all would be needed.
    if kept < LEAST_KEPT {
        pairs().for_each(|(command, _)| lengths.see(command.len(), alone.sentence));
    }
    Capacities { pairs: count, commands: count, command_tokens, length_pairs: lengths.pairs, alignments: lengths.cells, ..Capacities::NONE }
}
