//! Weighted expectation maximisation, in steps as large as the caller allows.
//!
//! Every training starts from t = 1/V and a = 1/(l + 1). In each round, every pair of the data gives its weight's worth of expected
//! counts to the cells that explain its words; then t = (count + s) / (total + s V) and a = count / total.

use super::bitext::BitextRef;
use super::roles::Layout;
use super::roles::training::{Part, Work};
use super::settings::Settings;
use super::tables::{Tables, TablesRef};
use crate::planning::Progress;
use crate::symbols::Symbol;

/// Where the training stands.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Phase {
    #[default]
    Done,
    /// The tables take their new sizes.
    Start,
    /// The E-step: expected counts, from this pair on.
    Expect(usize),
    /// The M-step of t, from this row on.
    Translations(usize),
    /// The M-step of a, from this pair of lengths on.
    Alignments(usize),
    /// The role model's.
    Roles(Part),
}

/// A training, under way or done.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Training {
    phase: Phase,
    round: u32,
}

impl Training {
    /// No training is under way.
    pub(super) const DONE: Self = Self { phase: Phase::Done, round: 0 };

    /// Begins, for so many words and tokens. The caller has made sure that the tables have room. Without words there is nothing to train.
    pub(super) fn begin(tables: &mut Tables<'_>, bitext: BitextRef<'_>, words: usize, tokens: usize, settings: &Settings) -> Self {
        (tables.trained.words, tables.trained.tokens) = (words, tokens);
        let is_nothing = words == 0 || (settings.rounds == 0 && !settings.model.is_roles());
        Self { phase: if is_nothing { start(tables, bitext, settings) } else { Phase::Start }, round: 0 }
    }

    /// Whether it has come to its end.
    pub fn is_done(&self) -> bool {
        self.phase == Phase::Done
    }

    /// The round under way, from 0.
    pub fn round(&self) -> u32 {
        self.round
    }

    /// Goes on, with at most about `budget` table cells of work: at least one pair, row or alignment table, or of the role model one memory of
    /// a word. The first call also takes the tables' sizes, which is not cut.
    pub(super) fn advance(&mut self, tables: &mut Tables<'_>, bitext: BitextRef<'_>, settings: &Settings, budget: u32) -> Progress {
        let mut left = budget.max(1) as usize;
        if self.phase == Phase::Start {
            self.phase = start(tables, bitext, settings);
            left = left.saturating_sub(tables.trained.words.saturating_mul(tables.trained.tokens));
        }
        let (layout, tokens) = (tables.trained.layout, tables.trained.tokens);
        while left > 0 {
            let (work, next) = match self.phase {
                Phase::Done | Phase::Start => return Progress::Done,
                Phase::Roles(part) => {
                    let (t, a) = tables.parts();
                    let mut work = Work { layout: &layout, tokens, bitext, t, a };
                    let (cells, next) = work.advance(part, &mut self.round, settings.rounds, left);
                    (cells, if next == Part::Done { Phase::Done } else { Phase::Roles(next) })
                }
                Phase::Expect(pair) => match bitext.pairs().get(pair) {
                    Some(entry) => {
                        let command = bitext.command(entry.command);
                        let sentence = bitext.sentence(entry.session);
                        expect(tables, command, sentence, entry.weight, self.round == 0);
                        let cells = command.len().saturating_add(1).saturating_mul(sentence.len());
                        (cells.saturating_mul(2), Phase::Expect(pair.saturating_add(1)))
                    }
                    None => (0, Phase::Translations(0)),
                },
                Phase::Translations(row) if row <= tables.trained.tokens => {
                    maximise_translations(tables, row, settings.smoothing);
                    (tables.trained.words, Phase::Translations(row.saturating_add(1)))
                }
                Phase::Translations(_) => (0, Phase::Alignments(0)),
                Phase::Alignments(pair) if pair < tables.trained.length_pairs => {
                    (maximise_alignments(tables, pair, settings), Phase::Alignments(pair.saturating_add(1)))
                }
                Phase::Alignments(_) => {
                    self.round = self.round.saturating_add(1);
                    (0, if self.round >= settings.rounds { Phase::Done } else { Phase::Expect(0) })
                }
            };
            self.phase = next;
            left = left.saturating_sub(work.max(1));
        }
        if self.is_done() { Progress::Done } else { Progress::Working }
    }
}

/// Gives the tables their new sizes.
#[inline(never)]
fn start(tables: &mut Tables<'_>, bitext: BitextRef<'_>, settings: &Settings) -> Phase {
    let (words, tokens) = (tables.trained.words, tables.trained.tokens);
    if settings.model.is_roles() {
        tables.trained.layout = Layout::of(bitext, words, tokens);
        tables.clear_counts();
        if words == 0 {
            return Phase::Done;
        }
        let layout = tables.trained.layout;
        let (t, a) = tables.parts();
        Work { layout: &layout, tokens, bitext, t, a }.clear();
        return Phase::Roles(Part::Count(0));
    }
    tables.trained.layout = Layout::NONE;
    tables.clear_counts();
    for pair in tables.memory.length_pairs.iter_mut() {
        pair.weight = 0.0;
        pair.trained = false;
    }
    for pair in bitext.pairs() {
        let (machine, english) = (bitext.command(pair.command).len(), bitext.sentence(pair.session).len());
        let wanted =
            |lengths: &&mut super::tables::LengthPair| usize::from(lengths.machine) == machine && usize::from(lengths.english) == english;
        if let Some(lengths) = tables.memory.length_pairs.iter_mut().take(tables.trained.length_pairs).find(wanted) {
            lengths.weight += pair.weight;
        }
    }
    if words == 0 || settings.rounds == 0 { Phase::Done } else { Phase::Expect(0) }
}

/// Gives one pair's expected counts. In the first round all parameters are uniform, and the tables hold nothing yet.
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

/// Sets the alignment table of one pair of lengths from its counts, and clears them. Gives the number of its cells.
fn maximise_alignments(tables: &mut Tables<'_>, pair: usize, settings: &Settings) -> usize {
    let Some(lengths) = tables.memory.length_pairs.get_mut(pair) else { return 0 };
    lengths.trained = lengths.weight > 0.0;
    let (start, cells) = (lengths.start as usize, lengths.cells());
    let width = usize::from(lengths.machine).saturating_add(1);
    let range = start..start.saturating_add(cells);
    let (_, a) = tables.parts();
    let (Some(alignments), Some(counts)) = (a.values.get_mut(range.clone()), a.counts.get_mut(range)) else { return 0 };
    let uniform = 1.0 / width as f32;
    // Not zipped: where that is not inlined, it has a division that could panic.
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
