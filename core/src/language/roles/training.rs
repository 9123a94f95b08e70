//! Expectation maximisation, in parts.
//!
//! After the start, in each round every training pair adds expected counts of its weight, by forward and backward sums over all ways to
//! read the words. With c the expected counts,
//!
//! ```text
//! F             = (c + common) / (sum of c + 1)
//! A[l]          = (c - d min(c, 1) + d kinds[l] spoken + common) / (sum of c + 1)
//! T[v]          = (c - d min(c, 1) + d kinds[v] named + common) / (sum of c + 1)
//! lambda        = c + 1
//! pool[l,r]     = (sum over m of c[l,m,r] + 4 prior[r]) / (... + 4)
//! p0[l,m,r]     = (c[l,m,r] + 4 pool[l,r]) / (sum over r of c[l,m,r] + 4)
//! lift[w',k]    = ((c[w',k] + 8 share[k]) / (sum over k of c[w',k] + 8)) / share[k],   share[k] the share of kind k in all counts
//! end[l,m]      = (stops + 1) / (moves + stops + 5)
//! ```
//!
//! A word heard once with a value is weak evidence for it: of each of the value's words the part d is given to all words that name values
//! (absolute discounting), so that a word heard once, with one color, is a hint of that color but no proof. `kinds[v]` sums min(c, 1) over
//! the words of v; `named(w)` is the share of w in these sums over all values; and d = once / (once + 2 twice + 100), Ney's estimate from
//! the numbers of pairs of a value and a word that were seen about once and about twice. The 100 stands for pairs seen more often, so that
//! a few lessons, in which every pair is seen once, are believed. Words of the task are treated alike: `spoken(w)` is the share of w in
//! such sums over all lifted tasks, and d is estimated from their own pairs, with 1,000 in place of 100.
//!
//! If tasks have ways, max(0, c - 1.5) replaces c and the discount in T, and max(0, c - 1) in A, and there are ten rounds instead of eight.
//!
//! If the words in the names of propositions are values, a pair counts its weight / the root of how often its machine command was told, and
//! a token's row adds only a tenth of `common`.
//!
//! A round may lose likelihood where plain EM would not: `lift` multiplies `p0` and is set from the same counts, and pseudo-counts pull
//! each row towards its prior. On four sets of recorded commands none of 16 rounds lost any. After the rounds the [kind of
//! task](super::kind) is trained.

use super::forward::{Before, END, Moves, Reader, Roles, Scratch, kept, prior};
use super::layout::{KINDS, Layout, SHARES_NAMED, cell, get, get_mut};
use super::{kind, start};
use crate::language::bitext::{BitextRef, Pair};
use crate::language::tables::Cells;
use crate::probability::square_root;
use crate::symbols::Symbol;
use crate::task::role::{RoleKind, VALUE_SORTS};
use core::ops::Range;

const OF_COMMON: f32 = 1.0;
/// The same if the words in names are values. There are then many values, each named by few words, and a new meaning is composed from them:
/// a value's own counts must outweigh the frequencies of its words.
const OF_COMMON_WITH_NAMES: f32 = 0.1;
/// The number of pairs of a value and a word assumed to be seen more than twice. With fewer, the paper's course ends less certain.
const OFTEN_NAMED: f32 = 100.0;
/// The same for pairs of a lifted task and a word. There are more of them: most words occur with a lifted task.
const OFTEN_SPOKEN: f32 = 1000.0;
const OF_LAMBDA: f32 = 1.0;
const OF_POOL: f32 = 4.0;
const OF_SHARE: f32 = 8.0;
const LEAST_SHARE: f32 = 0.001;
const OF_CUE: f32 = 1.0;
const OF_NAMING: f32 = 0.5;
/// If tasks have ways, the discount of each expected count of a word, for a value and for a kind of task: a word heard once with one says
/// nothing about it.
const OF_VALUES: f32 = 1.5;
const OF_FORMS: f32 = 1.0;
/// If tasks have ways, the factor of the configured number of rounds.
const ROUNDS_WITH_WAYS: f32 = 1.25;
const OF_STOP: f32 = 1.0;
const OF_MOVES: f32 = 4.0;

/// The next step of the training.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Part {
    /// Count words and values, from this pair on.
    Count(usize),
    /// Set the rows to begin with, from this one on, with the share of its token; the background's row is the last.
    Begin(usize, start::Share),
    /// Expected counts, from this pair on, and from this point in it.
    Expect(usize, Pass),
    /// Count how often words were seen with values and lifted tasks, from this row on.
    Seen(usize, Seen),
    /// Set the rows, from this one on.
    Rows(usize, Seen),
    /// Set the lifts, from this word on, with the share of each kind in all counts.
    Lifts(usize, [f32; KINDS]),
    /// Set p0 and end, from this lifted task on, and from this step of it: first the pool of its memories, then each memory.
    Moves(usize, usize),
    /// Set lambda and naming.
    Lambdas,
    /// The kind of task: a batch, from this session on.
    Kinds(u32, usize),
    /// The kind of task: the step after a batch, from this lifted task on.
    Steps(u32, usize),
    /// Done.
    Done,
}

/// The direction in which the words of a pair are read, and the next position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Pass {
    /// How much of each role is named, where tasks have ways.
    Named,
    /// Forward, from this word on.
    Forward(u8),
    /// Backward, from this word and this memory on.
    Backward { word: u8, memory: u8 },
}

impl Pass {
    /// Nothing is done yet.
    const START: Self = Self::Named;
}

/// The numbers of words seen with values, and with lifted tasks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Seen {
    values: Pairs,
    forms: Pairs,
}

/// The number of pairs seen about once and about twice, and the sum of min(c, 1) over all.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Pairs {
    once: f32,
    twice: f32,
    all: f32,
}

impl Pairs {
    /// Adds one row to the sums, and each word's part to `of_words`.
    fn see(&mut self, counts: &[f32], of_words: &mut [f32]) {
        for (&count, of_word) in counts.iter().zip(of_words) {
            let kind = count.min(1.0);
            *of_word += kind;
            self.all += kind;
            self.once += f32::from(u8::from((0.5..1.5).contains(&count)));
            self.twice += f32::from(u8::from((1.5..2.5).contains(&count)));
        }
    }

    /// d, the discount of each word of a row, which is shared by all words of such rows; `often` is the number of pairs assumed to be seen
    /// more than twice.
    fn discount(self, often: f32) -> f32 {
        if self.all > 0.0 { self.once / (self.once + 2.0 * self.twice + often) } else { 0.0 }
    }
}

/// The tables and the training data that a training works on.
pub(crate) struct Work<'t, 'b> {
    pub layout: &'t Layout,
    pub tokens: usize,
    pub bitext: BitextRef<'b>,
    pub t: Cells<'t>,
    pub a: Cells<'t>,
}

impl Work<'_, '_> {
    /// Sets the parameters before the first part to those of no training. The counts must be cleared.
    pub fn clear(&mut self) {
        let layout = self.layout;
        get_mut(self.a.values, 0..layout.trellis_start()).fill(0.0);
        for word in 0..=layout.words() {
            get_mut(self.a.values, layout.lift(word)).fill(1.0);
            if word < layout.words() {
                get_mut(self.a.values, layout.cue(word)).fill(1.0);
            }
        }
        let prior = self.prior();
        for form in 0..layout.forms().len() {
            for memory in 0..layout.memories() {
                get_mut(self.a.values, layout.p0(form, memory)).iter_mut().zip(&prior).for_each(|(slot, value)| *slot = *value);
            }
            get_mut(self.a.values, layout.end(form)).fill(END);
        }
        // Lambda, naming and novelty follow each other.
        get_mut(self.a.values, layout.lambda(0).start..layout.trellis_start()).fill(1.0);
    }

    fn prior(&self) -> Moves {
        prior(self.layout, self.layout.roles().iter().map(|role| role.kind()))
    }

    /// Does one part, or about `left` table cells of it if it can be cut. Returns the number of cells and the next part.
    pub fn advance(&mut self, part: Part, round: &mut u32, rounds: u32, left: usize) -> (usize, Part) {
        let layout = self.layout;
        let pairs = self.bitext.pairs();
        let rows = self.tokens + 1;
        match part {
            Part::Count(position) => match pairs.get(position) {
                Some(pair) if self.bitext.leaves_out(pair.session) => (1, Part::Count(position + 1)),
                Some(pair) => {
                    let before = position.checked_sub(1).and_then(|before| pairs.get(before));
                    let first = before.is_none_or(|before| before.session != pair.session);
                    start::count(layout, self.bitext, pair, first, &mut self.t, &mut self.a);
                    (self.cells(pair), Part::Count(position + 1))
                }
                None => {
                    start::set_common(layout, self.a.values);
                    (layout.words(), Part::Begin(0, start::Share::default()))
                }
            },
            Part::Begin(row, mut share) if row < rows => {
                // The first row counts all commands and is still needed, so it goes last.
                let token = row.saturating_add(1).checked_rem(rows).unwrap_or(0).checked_sub(1).map(|token| Symbol(token as u16));
                if let Some(token) = token.filter(|_| share.pairs() < pairs.len()) {
                    return (share.weigh(layout, self.bitext, token, left), Part::Begin(row, share));
                }
                start::set_row(layout, token, &share, &mut self.t, get(self.a.values, layout.common()));
                (layout.words().saturating_mul(2), Part::Begin(row + 1, start::Share::default()))
            }
            Part::Begin(..) => {
                for row in 0..rows {
                    get_mut(self.t.counts, layout.row(row.checked_sub(1).map(|token| Symbol(token as u16)))).fill(0.0);
                }
                (rows.saturating_mul(layout.words()), if rounds > 0 { Part::Expect(0, Pass::START) } else { Part::Kinds(0, 0) })
            }
            Part::Expect(position, pass) => match pairs.get(position) {
                Some(pair) if self.bitext.leaves_out(pair.session) => (1, Part::Expect(position + 1, Pass::START)),
                Some(pair) => {
                    let (cells, next) = self.expect(pair, pass, left);
                    let after = Part::Expect(position + 1, Pass::START);
                    (cells, next.map_or(after, |next| Part::Expect(position, next)))
                }
                None => {
                    get_mut(self.a.counts, layout.common()).fill(0.0);
                    (layout.words(), Part::Seen(0, Seen::default()))
                }
            },
            Part::Seen(token, mut seen) if token < self.tokens => {
                self.see(Symbol(token as u16), &mut seen);
                (layout.words(), Part::Seen(token + 1, seen))
            }
            Part::Seen(_, seen) => (0, Part::Rows(0, seen)),
            Part::Rows(row, seen) if row < rows => {
                self.set_row(row, seen);
                (layout.words(), Part::Rows(row + 1, seen))
            }
            Part::Rows(..) => {
                for is_form in [false, true] {
                    get_mut(self.a.counts, self.of_words(is_form)).fill(0.0);
                }
                (layout.words().saturating_mul(layout.kinds()), Part::Lifts(0, self.shares()))
            }
            Part::Lifts(word, shares) if word <= layout.words() => {
                self.set_lift(word, &shares);
                if layout.has_ways() && word < layout.words() {
                    self.set_cue(word);
                }
                (layout.kinds(), Part::Lifts(word + 1, shares))
            }
            Part::Lifts(..) => (0, Part::Moves(0, 0)),
            Part::Moves(form, step) if form < layout.forms().len() => {
                match step.checked_sub(1) {
                    None => self.pool_moves(form),
                    Some(memory) => self.set_moves(form, memory),
                }
                let next = if step < layout.memories() { (form, step + 1) } else { (form + 1, 0) };
                (layout.moves(), Part::Moves(next.0, next.1))
            }
            Part::Moves(..) => (0, Part::Lambdas),
            Part::Lambdas => {
                for form in 0..layout.forms().len() {
                    self.set_naming(form);
                }
                let range = layout.lambda(0).start..layout.naming(0).start;
                let (values, counts) = (get_mut(self.a.values, range.clone()), get_mut(self.a.counts, range));
                for (value, count) in values.iter_mut().zip(counts) {
                    *value = core::mem::take(count) + OF_LAMBDA;
                }
                *round = round.saturating_add(1);
                (
                    layout.roles().len().saturating_mul(VALUE_SORTS),
                    if *round < self.rounds(rounds) { Part::Expect(0, Pass::START) } else { Part::Kinds(0, 0) },
                )
            }
            Part::Kinds(batch, _) if batch >= self.batches() || layout.forms().len() < 2 => (0, Part::Done),
            Part::Kinds(batch, session) if session < self.bitext.sessions() && self.bitext.leaves_out(session as u16) => {
                (1, Part::Kinds(batch, session + 1))
            }
            Part::Kinds(batch, session) if session < self.bitext.sessions() => {
                kind::count(layout, self.bitext, session as u16, &mut self.t, &mut self.a);
                let words = self.bitext.sentence(session as u16).len();
                (words.saturating_mul(layout.forms().len()).saturating_mul(2), Part::Kinds(batch, session + 1))
            }
            Part::Kinds(batch, _) => (0, Part::Steps(batch, 0)),
            Part::Steps(batch, form) if form < layout.forms().len() => {
                kind::step(layout, form, &mut self.t, &mut self.a);
                (layout.words().saturating_mul(2), Part::Steps(batch, form + 1))
            }
            Part::Steps(batch, _) => (0, Part::Kinds(batch.saturating_add(1), 0)),
            Part::Done => (0, Part::Done),
        }
    }

    /// The number of rounds: with many sessions, which are not so easily learned by heart, up to half as many again; with ways, always a
    /// quarter more.
    fn rounds(&self, rounds: u32) -> u32 {
        let of_each = if self.layout.has_ways() { ROUNDS_WITH_WAYS } else { 1.0 + 0.5 * self.layout.many() };
        (rounds as f32 * of_each) as u32
    }

    /// The number of batches for the kind of task: fewer in a model that serves only the sessions it leaves out.
    fn batches(&self) -> u32 {
        if self.bitext.leaves_out_any() { kind::BATCHES_OF_A_FOLD } else { kind::BATCHES }
    }

    fn cells(&self, pair: &Pair) -> usize {
        self.bitext.command(pair.command).len().saturating_mul(self.bitext.sentence(pair.session).len())
    }

    /// Adds the expected counts of one pair, from `pass` on, with at most about `left` table cells of work but at least one memory of a
    /// word. Returns the number of cells, and where to continue, or `None` if the pair is done. Between calls, the trellis and the cells
    /// after it must be kept.
    #[inline(never)]
    fn expect(&mut self, pair: &Pair, mut pass: Pass, left: usize) -> (usize, Option<Pass>) {
        let (sentence, description) = (self.bitext.sentence(pair.session), self.bitext.command(pair.command));
        let Some((parameters, trellis)) = self.a.values.split_at_mut_checked(self.layout.trellis_start()) else { return (0, None) };
        let mut reader = Reader::new(self.layout, self.t.values, parameters, description);
        reader.take_groups();
        let weight = self.layout.weight(self.bitext, pair);
        let mut counts = Counts { reader: &reader, sentence, weight, t: &mut *self.t.counts, a: &mut *self.a.counts };
        let Some(form) = reader.form else { return (0, None) };
        let (mut cells, mut scratch) = (0_usize, Scratch::NEW);
        while cells < left {
            let next = match pass {
                Pass::Named => {
                    if self.layout.has_ways() {
                        let row = get_mut(counts.a, self.layout.naming(form));
                        reader.naming(sentence.iter().map(|word| word.index()), |at| {
                            if let Some(slot) = row.get_mut(at) {
                                *slot += weight;
                            }
                        });
                        cells = cells.saturating_add(description.len().saturating_mul(sentence.len()));
                    }
                    Some(Pass::Forward(0))
                }
                pass => {
                    let more = left.saturating_sub(cells);
                    let (done, next) = read_on(&reader, sentence, trellis, pass, more, &mut scratch, &mut counts);
                    cells = cells.saturating_add(done);
                    next
                }
            };
            let Some(next) = next else { return (cells, None) };
            pass = next;
        }
        (cells, Some(pass))
    }

    /// The range that holds `named` or `spoken` of each word, among counts that are not in use at that time.
    fn of_words(&self, is_form: bool) -> Range<usize> {
        if is_form { self.layout.kind_of_task(0) } else { self.layout.common() }
    }

    /// Adds one token's pairs.
    fn see(&mut self, token: Symbol, seen: &mut Seen) {
        let is_form = self.layout.form(token).is_some();
        let pairs = if is_form { &mut seen.forms } else { &mut seen.values };
        let of_words = self.of_words(is_form);
        pairs.see(get(self.t.counts, self.layout.row(Some(token))), get_mut(self.a.counts, of_words));
    }

    fn set_row(&mut self, row: usize, seen: Seen) {
        let token = row.checked_sub(1).map(|token| Symbol(token as u16));
        let range = self.layout.row(token);
        let is_form = token.is_some_and(|token| self.layout.form(token).is_some());
        let of_words = self.of_words(is_form);
        let (values, counts) = (get_mut(self.t.values, range.clone()), get_mut(self.t.counts, range));
        let (common, of_words) = (get(self.a.values, self.layout.common()), get(self.a.counts, of_words));
        let (pairs, often) = if is_form { (seen.forms, OFTEN_SPOKEN) } else { (seen.values, OFTEN_NAMED) };
        let mut discount = if token.is_some() { pairs.discount(often) } else { 0.0 };
        // If there are ways, the discount is fixed and goes to no other word.
        if token.is_some() && self.layout.has_ways() {
            let once = if is_form { OF_FORMS } else { OF_VALUES };
            counts.iter_mut().for_each(|count| *count = (*count - once).max(0.0));
            discount = 0.0;
        }
        let of_common = if token.is_some() && self.layout.has_names() { OF_COMMON_WITH_NAMES } else { OF_COMMON };
        let (mut whole, mut kinds) = (of_common, 0.0);
        for &count in &*counts {
            whole += count;
            kinds += count.min(1.0);
        }
        let novelty = of_common / whole;
        let spread = if discount > 0.0 { discount * kinds / pairs.all } else { 0.0 };
        for (((value, count), common), of_word) in values.iter_mut().zip(counts).zip(common).zip(of_words) {
            let count = core::mem::take(count);
            *value = (count - discount * count.min(1.0) + spread * of_word + of_common * common) / whole;
        }
        if let Some(slot) = self.a.values.get_mut(self.layout.novelty(row)) {
            *slot = novelty;
        }
    }

    /// The share of each kind in all counts.
    fn shares(&self) -> [f32; KINDS] {
        let mut shares = [LEAST_SHARE; KINDS];
        for word in 0..=self.layout.words() {
            for (share, count) in shares.iter_mut().zip(get(self.a.counts, self.layout.lift(word))) {
                *share += count;
            }
        }
        let whole: f32 = shares.iter().take(self.layout.kinds()).sum();
        shares.map(|share| share / whole)
    }

    fn set_lift(&mut self, word: usize, shares: &[f32; KINDS]) {
        let range = self.layout.lift(word);
        let (values, counts) = (get_mut(self.a.values, range.clone()), get_mut(self.a.counts, range));
        let whole = counts.iter().sum::<f32>() + OF_SHARE;
        for ((value, count), share) in values.iter_mut().zip(counts).zip(shares) {
            *value = (core::mem::take(count) + OF_SHARE * share) / whole / share;
        }
    }

    /// Multiplies a cue by (seen / expected)^(3/4), for each kind of role after it.
    fn set_cue(&mut self, word: usize) {
        let range = self.layout.cue(word);
        let (values, counts) = (get_mut(self.a.values, range.clone()), get_mut(self.a.counts, range));
        let Some((seen, expected)) = counts.split_at_mut_checked(RoleKind::COUNT) else { return };
        for ((value, seen), expected) in values.iter_mut().zip(seen).zip(expected) {
            let ratio = (core::mem::take(seen) + OF_CUE) / (core::mem::take(expected) + OF_CUE);
            *value *= square_root(ratio * square_root(ratio));
        }
    }

    fn set_naming(&mut self, form: usize) {
        let range = self.layout.naming(form);
        let (values, counts) = (get_mut(self.a.values, range.clone()), get_mut(self.a.counts, range));
        let (values, counts) = (values.as_chunks_mut::<SHARES_NAMED>().0, counts.as_chunks_mut::<SHARES_NAMED>().0);
        for (values, counts) in values.iter_mut().zip(counts) {
            let whole = counts.iter().sum::<f32>() + OF_NAMING * SHARES_NAMED as f32;
            values.iter_mut().zip(counts).for_each(|(value, count)| *value = (core::mem::take(count) + OF_NAMING) / whole);
        }
    }

    /// The range that holds the pool of a lifted task's moves, in the trellis, which is not in use at that time.
    fn pool(&self) -> Range<usize> {
        let start = self.layout.trellis_start();
        start..start.saturating_add(self.layout.moves())
    }

    /// Sums the moves of all memories of a lifted task.
    fn pool_moves(&mut self, form: usize) {
        let mut pool = self.prior();
        pool.iter_mut().for_each(|slot| *slot *= OF_POOL);
        let mut whole = OF_POOL;
        for memory in 0..self.layout.memories() {
            for (slot, count) in pool.iter_mut().zip(get(self.a.counts, self.layout.p0(form, memory))) {
                *slot += count;
                whole += count;
            }
        }
        let range = self.pool();
        get_mut(self.a.values, range).iter_mut().zip(&pool).for_each(|(slot, part)| *slot = part / whole);
    }

    fn set_moves(&mut self, form: usize, memory: usize) {
        let (range, ends, pool) = (self.layout.p0(form, memory), self.layout.end(form), self.pool());
        let Some((parameters, pool)) = self.a.values.split_at_mut_checked(pool.start) else { return };
        let (values, counts) = (get_mut(parameters, range.clone()), get_mut(self.a.counts, range));
        let moves: f32 = counts.iter().sum();
        for ((value, count), pool) in values.iter_mut().zip(counts).zip(pool) {
            *value = (core::mem::take(count) + OF_POOL * *pool) / (moves + OF_POOL);
        }
        if let (Some(value), Some(stops)) =
            (get_mut(parameters, ends.clone()).get_mut(memory), get_mut(self.a.counts, ends).get_mut(memory))
        {
            let stops = core::mem::take(stops);
            *value = (stops + OF_STOP) / (moves + stops + OF_STOP + OF_MOVES);
        }
    }
}

/// Hears the posterior probabilities in reading a command. Each method is called at one place, where it is compiled in.
pub(super) trait Listener {
    /// The probability that the command ends with this memory.
    fn stop(&mut self, memory: usize, share: f32);
    /// A word, read from one memory.
    fn word(&mut self, word: &WordRead<'_>);
    /// A word at this position, over all memories: Pr(w | role), and the probability of each present role.
    fn values(&mut self, position: usize, emissions: &Roles, roles: &[f32]);
}

/// A word, read from one memory.
pub(super) struct WordRead<'e> {
    /// The position of the word.
    position: usize,
    /// The memory before it.
    memory: usize,
    /// The probability of that memory with the word as background, as a word of the task, and as each present role.
    pub background: f32,
    pub task: f32,
    roles: &'e [f32],
    /// The context before it.
    before: &'e Before,
    /// The unnormalised probability of each present role before the word was heard.
    expected: &'e [f32],
}

/// Adds the expected counts of one pair to the tables.
struct Counts<'r, 't> {
    reader: &'r Reader<'t, 't>,
    sentence: &'r [Symbol],
    weight: f32,
    t: &'r mut [f32],
    a: &'r mut [f32],
}

/// Adds to a cell, if there is one.
fn add(cells: &mut [f32], position: usize, part: f32) {
    if let Some(slot) = cells.get_mut(position) {
        *slot += part;
    }
}

impl Listener for Counts<'_, '_> {
    fn stop(&mut self, memory: usize, share: f32) {
        let layout = self.reader.layout();
        if let Some((form, row)) = self.reader.form.zip(self.reader.memory(memory)) {
            add(get_mut(self.a, layout.end(form)), row, self.weight * share);
        }
    }

    fn word(&mut self, read: &WordRead<'_>) {
        let (reader, sentence, weight) = (self.reader, self.sentence, self.weight);
        let layout = reader.layout();
        let &WordRead { position, memory, background, task, roles, before, expected } = read;
        let (Some(form), Some(&word)) = (reader.form, sentence.get(position)) else { return };
        let previous = position.checked_sub(1).and_then(|before| sentence.get(before)).map_or(layout.words(), |word| word.index());
        add(self.t, layout.of_word(None, word.index()), weight * background);
        if let Some(&token) = layout.forms().get(form) {
            add(self.t, layout.of_word(Some(token), word.index()), weight * task);
        }
        if layout.has_ways() {
            let (of_roles, all): (f32, f32) = (roles.iter().sum(), expected.iter().sum());
            if of_roles > 0.0 && all > 0.0 {
                for &cue in &before.cues {
                    let row = get_mut(self.a, layout.cue(usize::from(cue)));
                    for ((present, &share), &step) in reader.present.iter().zip(roles).zip(expected) {
                        add(row, present.kind().index(), weight * share);
                        add(row, RoleKind::COUNT.saturating_add(present.kind().index()), weight * of_roles * step / all);
                    }
                }
            }
        }
        let Some(row) = reader.memory(memory) else { return };
        // The lifts come before p0.
        let range = layout.p0(form, row);
        let Some((lifts, rest)) = self.a.split_at_mut_checked(range.start) else { return };
        let (lift, moves) = (get_mut(lifts, layout.lift(previous)), get_mut(rest, 0..range.len()));
        let mut add_both = |column: usize, kind: usize, part: f32| {
            add(moves, column, part);
            add(lift, kind, part);
        };
        add_both(0, 0, weight * background);
        add_both(1, 1, weight * task);
        for (present, &share) in reader.present.iter().zip(roles) {
            add_both(present.column(), present.lift(), weight * share);
        }
    }

    fn values(&mut self, position: usize, emissions: &Roles, roles: &[f32]) {
        let (reader, weight) = (self.reader, self.weight);
        let (layout, Some(&word)) = (reader.layout(), self.sentence.get(position)) else { return };
        for group in &reader.groups {
            let (share, emission) = (cell(roles, group.present()), cell(emissions, group.present()));
            if share <= 0.0 || emission <= 0.0 {
                continue;
            }
            let scale = weight * share * group.share / emission;
            let mut sum = 0.0;
            for &value in reader.values(group) {
                let part = scale * reader.value(value, word.index());
                add(self.t, layout.of_word(Some(value), word.index()), part);
                sum += part;
            }
            if let Some(role) = reader.known(group.present()) {
                add(get_mut(self.a, layout.lambda(role)), group.sort(), sum);
            }
        }
    }
}

/// One row of a trellis.
pub(super) fn row_of(reader: &Reader<'_, '_>, position: usize) -> core::ops::Range<usize> {
    let width = reader.memories() + 1;
    let start = position.saturating_mul(width);
    start..start.saturating_add(width)
}

/// Fills the trellis for one word: the probability of each memory after it. The divisor of these is stored at the end of the row of the
/// memories before it. `None` if the command is impossible or the trellis too short.
fn forward_word(reader: &Reader<'_, '_>, sentence: &[Symbol], position: usize, trellis: &mut [f32], scratch: &mut Scratch) -> Option<()> {
    let row = row_of(reader, position);
    let (before, after) = trellis.split_at_mut_checked(row.end)?;
    let (last, before) = get_mut(before, row.clone()).split_last_mut()?;
    if position == 0 {
        before.fill(0.0);
        *before.first_mut()? = 1.0;
    }
    let (next, after) = get_mut(after, 0..row.len()).split_last_mut()?;
    let words = reader.before(position, |position| sentence.get(position).map(|word| word.index()));
    let sum = reader.advance(sentence.get(position)?.index(), &words, before, after, scratch);
    *last = sum;
    if sum <= 0.0 {
        return None;
    }
    after.iter_mut().for_each(|slot| *slot = kept(*slot / sum));
    *next = 1.0;
    Some(())
}

/// Begins the way back through a filled trellis: tells the ends of the command, and writes the probability of the rest for each memory
/// after the trellis.
fn begin_backward(reader: &Reader<'_, '_>, sentence: &[Symbol], trellis: &mut [f32], listener: &mut impl Listener) -> Option<()> {
    let (filled, after) = trellis.split_at_mut_checked(row_of(reader, sentence.len()).end)?;
    let last = get(filled, row_of(reader, sentence.len()));
    let whole: f32 = (0..reader.memories()).map(|memory| cell(last, memory) * reader.end(memory)).sum();
    if whole <= 0.0 {
        return None;
    }
    for (memory, slot) in after.get_mut(..reader.memories())?.iter_mut().enumerate() {
        let mass = cell(last, memory);
        // No reading leads to a memory that was dropped.
        *slot = if mass > 0.0 { reader.end(memory) / whole } else { 0.0 };
        listener.stop(memory, mass * *slot);
    }
    Some(())
}

/// Goes back by one word and tells its expected counts: through at most `most` memories that were not dropped, beginning with `first`, and
/// after the last one over all memories together. Returns how many memories it did, and the next one; the word is done if there is none.
///
/// The forward values of the word and of the one after it are not needed again. The word's row is reused for the probability of the rest by
/// memory, and the row after it for the probability of each role.
fn backward_word(
    reader: &Reader<'_, '_>,
    sentence: &[Symbol],
    position: usize,
    (first, most): (usize, usize),
    trellis: &mut [f32],
    scratch: &mut Scratch,
    listener: &mut impl Listener,
) -> (usize, usize) {
    let (memories, count) = (reader.memories(), reader.present.len());
    let nothing = (0, memories);
    let Some((filled, rest)) = trellis.split_at_mut_checked(row_of(reader, sentence.len()).end) else { return nothing };
    let Some((filled, roles_of_all)) = filled.split_at_mut_checked(row_of(reader, position).end) else { return nothing };
    let (Some(after), Some(of_all), Some(word)) = (rest.get_mut(..memories), roles_of_all.get_mut(..count), sentence.get(position)) else {
        return nothing;
    };
    let before = get_mut(filled, row_of(reader, position));
    let words = reader.before(position, |position| sentence.get(position).map(|word| word.index()));
    let Scratch { lifts, emissions, moves, into: roles } = scratch;
    reader.lifts(&words, lifts);
    let (background, task) = reader.background_and_task(word.index());
    reader.emissions(word.index(), emissions);
    let (Some(of_emissions), Some(roles)) = (emissions.get(..count), roles.get_mut(..count)) else { return nothing };
    let sum = cell(before, memories);
    if first == 0 {
        of_all.fill(0.0);
    }
    let mut done = 0_usize;
    for (memory, slot) in before.iter_mut().enumerate().take(memories).skip(first) {
        let mass = *slot;
        if mass <= 0.0 {
            *slot = 0.0;
            continue;
        }
        if done >= most {
            return (done, memory);
        }
        done += 1;
        let scale = reader.step(memory, lifts, moves) / sum;
        let (here, there) = (cell(after, memory), after.get(1..).unwrap_or(&[]));
        let [of_background, of_task, moves @ ..] = &*moves;
        let Some(moves) = moves.get(..count) else { return nothing };
        let (of_background, of_task) = (scale * of_background * background * here, scale * of_task * task * here);
        let mut total = of_background + of_task;
        for ((((part, all), step), emission), there) in roles.iter_mut().zip(&mut *of_all).zip(moves).zip(of_emissions).zip(there) {
            let share = scale * step * emission * there;
            total += share;
            *part = mass * share;
            *all += *part;
        }
        *slot = total;
        let (background, task) = (mass * of_background, mass * of_task);
        listener.word(&WordRead { position, memory, background, task, roles, before: &words, expected: moves });
    }
    listener.values(position, emissions, of_all);
    after.iter_mut().zip(&*before).for_each(|(slot, next)| *slot = *next);
    (done, memories)
}

/// Does the next step of reading a command, which is at most a word: forward, then back. Of a word on the way back it reads as many memories
/// as `left` table cells allow, but at least one. Returns the number of cells, and the step after it; there is none if the command is read,
/// impossible, or the trellis too short.
#[inline(always)]
pub(super) fn read_on(
    reader: &Reader<'_, '_>,
    sentence: &[Symbol],
    trellis: &mut [f32],
    pass: Pass,
    left: usize,
    scratch: &mut Scratch,
    listener: &mut impl Listener,
) -> (usize, Option<Pass>) {
    let width = reader.described();
    match pass {
        Pass::Named => (0, Some(Pass::Forward(0))),
        Pass::Forward(word) if usize::from(word) < sentence.len() => {
            let next = forward_word(reader, sentence, usize::from(word), trellis, scratch);
            (width.saturating_mul(reader.layout().moves()), next.map(|()| Pass::Forward(word.saturating_add(1))))
        }
        Pass::Forward(words) => {
            let next = begin_backward(reader, sentence, trellis, listener);
            (0, next.and_then(|()| Some(Pass::Backward { word: words.checked_sub(1)?, memory: 0 })))
        }
        Pass::Backward { word, memory } => {
            let from = (usize::from(memory), left.div_ceil(width.max(1)));
            let (done, next) = backward_word(reader, sentence, usize::from(word), from, trellis, scratch, listener);
            let next = match next < reader.memories() {
                true => Some(Pass::Backward { word, memory: next as u8 }),
                false => word.checked_sub(1).map(|word| Pass::Backward { word, memory: 0 }),
            };
            (width.saturating_mul(done), next)
        }
    }
}
