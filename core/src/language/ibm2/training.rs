//! Weighted expectation maximisation.
//!
//! Training starts from t = 1/V and a = 1/(l + 1). In each round, every training pair spreads its weight, as expected counts, over the
//! cells that explain its words; then t = (count + s) / (total + s V) and a = (count + p / (l + 1)) / (total + p), with the smoothing s and
//! the prior of alignments p.

use crate::language::bitext::BitextRef;
use crate::language::settings::Settings;
use crate::language::tables::{Tables, TablesRef};
use crate::symbols::Symbol;

/// The next part of the training.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Part {
    /// The E-step: expected counts, from this pair on.
    Expect(usize),
    /// The M-step of t, from this row on.
    Translations(usize),
    /// The M-step of a, from this pair of lengths on.
    Alignments(usize),
    /// None.
    Done,
}

/// Sums the weights of each pair of lengths. The counts must be cleared.
pub(crate) fn start(tables: &mut Tables<'_>, bitext: BitextRef<'_>, settings: &Settings) -> Part {
    for pair in tables.memory.length_pairs.iter_mut() {
        pair.weight = 0.0;
        pair.trained = false;
    }
    for pair in bitext.pairs() {
        let (machine, english) = (bitext.command(pair.command).len(), bitext.sentence(pair.session).len());
        if let Some(lengths) = tables.length_pair_mut(machine, english) {
            lengths.weight += pair.weight;
        }
    }
    if tables.trained.words == 0 || settings.rounds == 0 { Part::Done } else { Part::Expect(0) }
}

/// Does one part. Returns the number of table cells it worked on, and the next part.
pub(crate) fn advance(tables: &mut Tables<'_>, bitext: BitextRef<'_>, part: Part, round: &mut u32, settings: &Settings) -> (usize, Part) {
    match part {
        Part::Done => (0, Part::Done),
        Part::Expect(pair) => match bitext.pairs().get(pair) {
            Some(entry) => {
                let command = bitext.command(entry.command);
                let sentence = bitext.sentence(entry.session);
                expect(tables, command, sentence, entry.weight, *round == 0);
                let cells = command.len().saturating_add(1).saturating_mul(sentence.len());
                (cells.saturating_mul(2), Part::Expect(pair.saturating_add(1)))
            }
            None => (0, Part::Translations(0)),
        },
        Part::Translations(row) if row <= tables.trained.tokens => {
            maximise_translations(tables, row, settings.smoothing);
            (tables.trained.words, Part::Translations(row.saturating_add(1)))
        }
        Part::Translations(_) => (0, Part::Alignments(0)),
        Part::Alignments(pair) if pair < tables.trained.wanted.length_pairs => {
            (maximise_alignments(tables, pair, settings), Part::Alignments(pair.saturating_add(1)))
        }
        Part::Alignments(_) => {
            *round = round.saturating_add(1);
            (0, if *round >= settings.rounds { Part::Done } else { Part::Expect(0) })
        }
    }
}

/// Adds one pair's expected counts. In the first round all parameters are uniform, and the tables are not filled yet.
fn expect(tables: &mut Tables<'_>, command: &[Symbol], sentence: &[Symbol], weight: f32, first_round: bool) {
    let width = command.len().saturating_add(1);
    let Some(pair) = tables.read().length_pair(command.len(), sentence.len()) else { return };
    let start = pair.start as usize;
    let words = tables.trained.words;
    let (t, a) = tables.parts();
    let rows = || core::iter::once(0).chain(command.iter().map(|&token| TablesRef::row(Some(token))));
    for (i, word) in sentence.iter().enumerate() {
        let from = start.saturating_add(i.saturating_mul(width));
        let range = from..from.saturating_add(width);
        let (Some(alignment), Some(alignment_count)) = (a.values.get(range.clone()), a.counts.get_mut(range)) else { return };
        let cell = |row: usize| row.wrapping_mul(words).wrapping_add(word.index());
        if first_round {
            let share = weight / width as f32;
            for (row, count) in rows().zip(alignment_count) {
                *count += share;
                if let Some(count) = t.counts.get_mut(cell(row)) {
                    *count += share;
                }
            }
            continue;
        }
        let mut whole = 0.0;
        for (row, a) in rows().zip(alignment) {
            whole += a * t.values.get(cell(row)).copied().unwrap_or(0.0);
        }
        if whole <= 0.0 {
            continue;
        }
        let scale = weight / whole;
        for ((row, a), alignment_count) in rows().zip(alignment).zip(alignment_count) {
            let share = a * t.values.get(cell(row)).copied().unwrap_or(0.0) * scale;
            *alignment_count += share;
            if let Some(count) = t.counts.get_mut(cell(row)) {
                *count += share;
            }
        }
    }
}

/// Sets one row of t from its counts, and clears them.
fn maximise_translations(tables: &mut Tables<'_>, row: usize, smoothing: f32) {
    let start = row.saturating_mul(tables.trained.words);
    let range = start..start.saturating_add(tables.trained.words);
    let (t, _) = tables.parts();
    let (Some(row), Some(counts)) = (t.values.get_mut(range.clone()), t.counts.get_mut(range)) else { return };
    let total: f32 = counts.iter().sum();
    let whole = total + smoothing * row.len() as f32;
    let uniform = 1.0 / row.len().max(1) as f32;
    for (t, count) in row.iter_mut().zip(counts) {
        *t = if whole > 0.0 { (*count + smoothing) / whole } else { uniform };
        *count = 0.0;
    }
}

/// Sets the alignment table of one pair of lengths from its counts, and clears them. Returns the number of its cells.
fn maximise_alignments(tables: &mut Tables<'_>, pair: usize, settings: &Settings) -> usize {
    let Some(lengths) = tables.memory.length_pairs.get_mut(pair) else { return 0 };
    lengths.trained = lengths.weight > 0.0;
    let (start, cells) = (lengths.start as usize, lengths.cells());
    let width = usize::from(lengths.machine).saturating_add(1);
    let range = start..start.saturating_add(cells);
    let (_, a) = tables.parts();
    let (Some(alignments), Some(counts)) = (a.values.get_mut(range.clone()), a.counts.get_mut(range)) else { return 0 };
    let uniform = 1.0 / width as f32;
    // Not zipped: where `zip` is not inlined, it contains a division that could panic.
    let mut counts = counts.chunks_mut(width);
    for alignments in alignments.chunks_mut(width) {
        let counts = counts.next().unwrap_or_default();
        let total: f32 = counts.iter().sum();
        let whole = total + settings.alignment_prior;
        for (a, count) in alignments.iter_mut().zip(counts) {
            *a = if whole > 0.0 { (*count + settings.alignment_prior * uniform) / whole } else { uniform };
            *count = 0.0;
        }
    }
    cells
}
