//! The parameters that training starts from.
//!
//! A value's words are those that occur in a larger share of the commands with the value than of the others. With p_v the weight of
//! commands with value v that contain word w, n_v of all commands with v, and p and n the same over all commands,
//!
//! ```text
//! d(w) = max(0, p_v / (n_v + 1) - (p - p_v) / (n - n_v + 1)),   T[v] = .95 d / (sum of d) + .05 common
//! ```
//!
//! and likewise for each lifted task. If no word stands out, T[v] is the frequency of each word.

use super::kind::different;
use super::layout::{Layout, cell, get, get_mut};
use crate::language::bitext::{BitextRef, Pair};
use crate::language::tables::Cells;
use crate::symbols::Symbol;
use crate::task::description::{form, groups, has_value, is_of_task};

const STANDING_OUT: f32 = 0.95;

/// Counts the words and values that occur together in one pair.
pub(super) fn count(layout: &Layout, bitext: BitextRef<'_>, pair: &Pair, first: bool, t: &mut Cells<'_>, a: &mut Cells<'_>) {
    let (sentence, description) = (bitext.sentence(pair.session), bitext.command(pair.command));
    let weight = layout.weight(bitext, pair);
    if first {
        let times = if layout.has_names() { weight } else { 1.0 };
        let common = get_mut(a.values, layout.common());
        for word in sentence {
            if let Some(slot) = common.get_mut(word.index()) {
                *slot += times;
            }
        }
    }
    // Once for all rows: to find a repetition, a word is compared with all before it.
    let words = different(sentence);
    let mut add = |token: Option<Symbol>| {
        let counts = get_mut(t.counts, layout.row(token));
        for word in &words {
            if let Some(slot) = counts.get_mut(word.index()) {
                *slot += weight;
            }
        }
    };
    add(None);
    add(form(description));
    // A value of the task in several of its roles counts once.
    let of_task = || groups(description).filter(is_of_task);
    for (position, group) in of_task().enumerate() {
        for &value in group.values {
            if !of_task().take(position).any(|other| other.values.contains(&value)) {
                add(Some(value));
            }
        }
    }
}

/// Turns the counts of words into their frequencies.
pub(super) fn set_common(layout: &Layout, values: &mut [f32]) {
    let common = get_mut(values, layout.common());
    let whole = common.iter().sum::<f32>() + 0.5 * common.len() as f32;
    common.iter_mut().for_each(|slot| *slot = (*slot + 0.5) / whole);
}

/// The weight of the pairs that have a token, and of all pairs, among those weighed so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Share {
    pairs: u32,
    with: f32,
    all: f32,
}

impl Share {
    /// The number of pairs weighed so far.
    pub(super) const fn pairs(&self) -> usize {
        self.pairs as usize
    }

    /// Weighs at most `most` more pairs. Returns their number.
    pub(super) fn weigh(&mut self, layout: &Layout, bitext: BitextRef<'_>, token: Symbol, most: usize) -> usize {
        let before = self.pairs();
        for pair in bitext.pairs().iter().skip(before).take(most) {
            self.pairs = self.pairs.saturating_add(1);
            if bitext.leaves_out(pair.session) {
                continue;
            }
            let description = bitext.command(pair.command);
            let weight = layout.weight(bitext, pair);
            self.all += weight;
            if form(description) == Some(token) || has_value(description, token) {
                self.with += weight;
            }
        }
        self.pairs().saturating_sub(before)
    }
}

/// Turns the counts into a token's row, once all pairs are weighed. The background's row must be set last.
pub(super) fn set_row(layout: &Layout, token: Option<Symbol>, share: &Share, t: &mut Cells<'_>, common: &[f32]) {
    let Some(token) = token else {
        get_mut(t.values, layout.row(None)).iter_mut().zip(common).for_each(|(slot, value)| *slot = *value);
        return;
    };
    let &Share { with, all, .. } = share;
    let of_all = layout.row(None);
    let (of_token, words) = (layout.row(Some(token)), layout.words());
    let stands_out = |word: usize, counts: &[f32]| {
        let (with_word, word) = (cell(get(counts, of_token.clone()), word), cell(get(counts, of_all.clone()), word));
        (with_word / (with + 1.0) - (word - with_word) / (all - with + 1.0)).max(0.0)
    };
    let sum: f32 = (0..words).map(|word| stands_out(word, t.counts)).sum();
    for word in 0..words {
        let common = cell(common, word);
        let value = if sum > 0.0 { STANDING_OUT * stands_out(word, t.counts) / sum + (1.0 - STANDING_OUT) * common } else { common };
        if let Some(slot) = get_mut(t.values, of_token.clone()).get_mut(word) {
            *slot = value;
        }
    }
}
