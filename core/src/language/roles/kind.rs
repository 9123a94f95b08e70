//! The kind of task that the words speak of: a log-linear model over the words, their number and the lifted task. It ignores the scene.
//!
//! q_l(e) is proportional to exp(b_l + u_l n / 8 + the sum of w_l over the command's different words), with n the number of its words: a
//! command with two goals is longer. Training takes batches of all sessions, with each session's posterior of the lifted tasks as target, a
//! step size of its own for every weight (AdaGrad) and a pull towards 0. The role model then decides among the tasks of a kind, and counts
//! only half about the kind:
//!
//! ```text
//! Pr(t|e,s) proportional to q_l(e) pi_t Pr(e|t) / Z_l^(1/2),   Z_l the sum of pi_t Pr(e|t) over the tasks of the kind
//! ```

use super::layout::{BESIDE_WORDS, Layout, cell, get, get_mut};
use crate::capacity::{LIFTED_TASKS, WORDS_PER_COMMAND};
use crate::language::bitext::BitextRef;
use crate::language::tables::{Cells, TablesRef};
use crate::probability::{Scaled, exp, square_root, total};
use crate::symbols::{Symbol, listed};
use crate::task::description::form;
use heapless::Vec;

/// The number of batches: more change little. After 30 the weights of rare words still move.
pub(super) const BATCHES: u32 = 100;
/// The number in a model that leaves out sessions: more do not help the [layer](crate::language::layer).
pub(super) const BATCHES_OF_A_FOLD: u32 = 30;
const RATE: f32 = 0.3;
/// The prior of a weight is normal around 0 with variance 1 / PULL. With a higher PULL, seven lessons leave the kinds too uncertain.
const PULL: f32 = 0.5;

/// The number of words whose length term weighs as much as one different word.
const WORDS_OF_LENGTH: f32 = 8.0;
/// The weight of an unknown word, relative to a word that says nothing about the task.
const UNKNOWN_SAYS_NOTHING: f32 = 0.5;

type Forms = [f32; LIFTED_TASKS];

/// q_l(e) for each lifted task of the training data.
fn shares(layout: &Layout, alignments: &[f32], words: &[Symbol], length: f32) -> Forms {
    let mut shares: Forms = [0.0; LIFTED_TASKS];
    let (count, constant) = (layout.forms().len(), layout.words());
    for (form, slot) in shares.iter_mut().enumerate().take(count) {
        let row = get(alignments, layout.kind_of_task(form));
        let of_length = length * cell(row, constant + 1);
        *slot = cell(row, constant) + of_length + words.iter().map(|word| cell(row, word.index())).sum::<f32>();
    }
    let most = shares.iter().take(count).fold(f32::MIN, |most, &score| most.max(score));
    let mut whole = 0.0;
    for slot in shares.iter_mut().take(count) {
        *slot = exp(*slot - most);
        whole += *slot;
    }
    shares.iter_mut().for_each(|slot| *slot /= whole);
    shares
}

/// The different words of a command, in the order in which they are first said.
pub(super) fn different(sentence: &[Symbol]) -> Vec<Symbol, WORDS_PER_COMMAND> {
    let mut different: Vec<Symbol, WORDS_PER_COMMAND> = Vec::new();
    // A bit for each word, which others may share, saves most searches.
    let mut seen = 0_u64;
    for &word in sentence {
        let before = seen;
        seen |= 1 << (word.0 & 63);
        if seen != before || !different.contains(&word) {
            // No more than the command has, so they fit.
            let _ = different.push(word);
        }
    }
    different
}

fn length(words: usize) -> f32 {
    words as f32 / WORDS_OF_LENGTH
}

/// The kinds of task that a command may speak of.
pub struct Kinds {
    /// q_l(e) for each lifted task of the training data.
    shares: Forms,
    /// The number of words that training has not seen.
    new: f32,
}

impl Kinds {
    /// The kinds of a command; `sentence` has only the known words, and `new` is the number of unknown ones.
    pub fn of(layout: &Layout, alignments: &[f32], sentence: &[Symbol], new: usize) -> Self {
        let shares = match layout.forms().len() {
            0 | 1 => [1.0; LIFTED_TASKS],
            _ => shares(layout, alignments, &different(sentence), length(sentence.len().saturating_add(new))),
        };
        Self { shares, new: new as f32 }
    }

    /// q_l(e) of the lifted task of a token. A lifted task that training has not seen counts as one more session, plus one for each new
    /// word.
    pub fn share(&self, layout: &Layout, token: Symbol) -> f32 {
        match layout.form(token) {
            Some(form) => cell(&self.shares, form),
            None => (1.0 + self.new) / (layout.sessions() + 1.0 + self.new),
        }
    }
}

/// With weights pi_t Pr(e|t) and the lifted-task token of each task, turns the weights into
///
/// ```text
/// q_l(e) pi_t Pr(e|t) / Z_l^(1/2),   Z_l the sum of pi_t Pr(e|t) over the tasks of the kind,
/// ```
///
/// with Z_l^(3/4) if tasks have ways, because their kinds differ by few words. An untrained model leaves the weights unchanged.
pub fn weigh(tables: TablesRef<'_>, sentence: &[Option<Symbol>], form: impl Fn(usize) -> Symbol, weights: &mut [Scaled]) {
    let (count, layout) = (weights.len(), tables.layout());
    if layout.words() == 0 {
        return;
    }
    let known: Vec<Symbol, WORDS_PER_COMMAND> = listed(sentence.iter().copied().flatten().filter(|word| word.index() < layout.words()));
    let kinds = Kinds::of(layout, tables.cells().1, &known, sentence.len().saturating_sub(known.len()));
    for first in 0..count {
        let token = form(first);
        // Searched backwards from the nearest: tasks of one kind follow each other, and there may be thousands.
        if (0..first).rev().any(|before| form(before) == token) {
            continue;
        }
        let whole = total(weights.iter().enumerate().filter(|&(task, _)| form(task) == token).map(|(_, &weight)| weight));
        let root = whole.square_root();
        let root = if layout.has_ways() { root.times(root.square_root()) } else { root };
        let kind = kinds.share(layout, token);
        for (_, weight) in weights.iter_mut().enumerate().filter(|&(task, _)| form(task) == token) {
            *weight = weight.divided_by(root).scaled_by(kind);
        }
    }
}

/// Half the share of unknown words falls back to the task prior; but not if the words in names are values, when an unknown word is only
/// taken for a value that was never named.
pub fn dilute(tables: TablesRef<'_>, sentence: &[Option<Symbol>], prior: impl Fn(usize) -> f32, weights: &mut [Scaled]) {
    if tables.words() == 0 || tables.layout().has_names() {
        return;
    }
    let whole = total(weights.iter().copied());
    let unknown = UNKNOWN_SAYS_NOTHING * tables.unknown_share(sentence);
    if !whole.is_zero() && unknown > 0.0 {
        for (task, weight) in weights.iter_mut().enumerate() {
            *weight = weight.scaled_by(1.0 - unknown).plus(whole.scaled_by(unknown * prior(task)));
        }
    }
}

/// Adds one session's gradient. Gradients accumulate in the lifted tasks' count rows; those of constant and length reuse the counts of
/// `common`.
pub(super) fn count(layout: &Layout, bitext: BitextRef<'_>, session: u16, t: &mut Cells<'_>, a: &mut Cells<'_>) {
    let sentence = bitext.sentence(session);
    let length = length(sentence.len());
    let words = different(sentence);
    let shares = shares(layout, a.values, &words, length);
    for (position, &token) in layout.forms().iter().enumerate() {
        let meant = |command: u16| form(bitext.command(command)) == Some(token);
        let wanted: f32 = bitext.pairs_of(session).iter().filter(|pair| meant(pair.command)).map(|pair| pair.weight).sum();
        let error = cell(&shares, position) - wanted;
        let counts = get_mut(t.counts, layout.row(Some(token)));
        for word in &words {
            if let Some(slot) = counts.get_mut(word.index()) {
                *slot += error;
            }
        }
        for (slot, of_one) in get_mut(a.counts, beside_words(layout, position)).iter_mut().zip([1.0, length]) {
            *slot += error * of_one;
        }
    }
}

/// The cells for the gradients of the constant and the length. A vocabulary too small for them teaches no kinds anyway.
fn beside_words(layout: &Layout, position: usize) -> core::ops::Range<usize> {
    let (common, start) = (layout.common(), position.saturating_mul(BESIDE_WORDS));
    start.min(common.end)..start.saturating_add(BESIDE_WORDS).min(common.end)
}

/// One step of a lifted task's weights, from the accumulated gradient.
pub(super) fn step(layout: &Layout, position: usize, t: &mut Cells<'_>, a: &mut Cells<'_>) {
    let Some(&token) = layout.forms().get(position) else { return };
    let mut beside = [0.0; BESIDE_WORDS];
    for (slope, slot) in beside.iter_mut().zip(get_mut(a.counts, beside_words(layout, position))) {
        *slope = core::mem::take(slot);
    }
    let [constant, length] = beside;
    let range = layout.kind_of_task(position);
    let (weights, squares) = (get_mut(a.values, range.clone()), get_mut(a.counts, range));
    let gradient = get_mut(t.counts, layout.row(Some(token)));
    let slopes = gradient.iter_mut().map(|slope| (core::mem::take(slope), PULL)).chain([(constant, 0.0), (length, PULL)]);
    for ((weight, square), (slope, pull)) in weights.iter_mut().zip(squares).zip(slopes) {
        let slope = slope + pull * *weight;
        *square += slope * slope;
        if *square > 0.0 {
            *weight -= RATE * slope / square_root(*square);
        }
    }
}
