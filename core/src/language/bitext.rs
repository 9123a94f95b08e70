//! The training data: pairs of an English command and a machine command, each with a weight.
//!
//! Equal machine commands are stored once. A session's English command is stored once, for all its machine commands.

use super::layer::LeftOut;
use crate::capacity::{Capacities, Capacity, CapacityError, TOKENS_PER_COMMAND, WORDS_PER_COMMAND};
use crate::memory::{BitextTables, BitextTablesRef};
use crate::probability::square_root;
use crate::symbols::{Symbol, close_gap};
use crate::task::role::is_marker;
use core::cell::Cell;

/// The place of a run of symbols in its pool: the start, above a byte with the length and, for a session, a bit that is set if its command
/// was heard more than once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[doc(hidden)]
pub struct Span(u32);

/// The most symbols of a pool that spans can reach.
const MOST_POOL: usize = 1 << 24;

impl Span {
    /// The value of unused memory.
    pub const UNUSED: Self = Self(0);

    const LENGTH: u32 = 0x7f;
    const AGAIN: u32 = 0x80;

    const fn new(start: usize, len: usize) -> Self {
        Self(((start as u32) << 8) | (len & Self::LENGTH as usize) as u32)
    }

    /// The same span, with its symbols at another place.
    const fn moved(self, start: usize) -> Self {
        Self(((start as u32) << 8) | (self.0 & 0xff))
    }

    const fn start(self) -> usize {
        (self.0 >> 8) as usize
    }

    const fn len(self) -> usize {
        (self.0 & Self::LENGTH) as usize
    }

    const fn end(self) -> usize {
        self.start() + self.len()
    }
}

/// An English command and a machine command that it may mean, with the weight of this meaning.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(hidden)]
pub struct Pair {
    /// The session, by position.
    pub session: u16,
    /// The machine command, by position.
    pub command: u16,
    /// The weight in training.
    pub weight: f32,
}

impl Pair {
    /// The value of unused memory.
    pub const UNUSED: Self = Self { session: 0, command: 0, weight: 0.0 };
}

/// The used part of the memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Extent {
    commands: usize,
    command_tokens: usize,
    sessions: usize,
    sentence_words: usize,
    pairs: usize,
    /// Counts the changes of whole sessions.
    changes: u32,
    removal: Removal,
}

/// A removal of a session that is not complete. The pairs after the session are not counted until they have moved up, and the machine
/// commands that only it had remain until then.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Removal {
    /// The next pair to move up; once all have, the number of machine commands that may be unused. One number for both, because a micro:bit
    /// has no more room.
    from: u32,
    /// The end of the pairs that move up; 0 once all have.
    until: u32,
}

impl Removal {
    const NONE: Self = Self { from: 0, until: 0 };

    /// The rest of a removal: to move these pairs up, and then to look at this number of machine commands.
    const fn of(from: usize, until: usize, commands: usize) -> Self {
        if from < until { Self { from: from as u32, until: until as u32 } } else { Self { from: commands as u32, until: 0 } }
    }
}

/// At most this number of pairs move up in one part of a removal.
const PAIRS_A_PART: usize = 2_048;

impl Extent {
    /// Nothing is used.
    pub(crate) const NONE: Self =
        Self { commands: 0, command_tokens: 0, sessions: 0, sentence_words: 0, pairs: 0, changes: 0, removal: Removal::NONE };
}

/// The training data.
#[derive(Debug)]
pub struct Bitext<'t> {
    memory: BitextTables<'t>,
    used: &'t mut Extent,
}

/// If the parameters have no room for all of a session's machine commands, those of a smaller weight are left out.
pub(super) const LIGHT: f32 = 0.1;

/// The smallest share of a session's weight that must be kept.
pub(super) const LEAST_KEPT: f32 = 0.5;

/// The size of a session by itself.
pub(crate) struct Alone {
    /// Its number of different words.
    pub words: usize,
    /// Its number of different machine tokens.
    pub tokens: usize,
    /// The number of words in its command, repetitions included.
    pub sentence: usize,
}

/// The training data, read-only.
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct BitextRef<'t> {
    memory: BitextTablesRef<'t>,
    used: Extent,
    left_out: LeftOut,
}

impl<'t> BitextRef<'t> {
    /// The data in the extent `used`.
    pub(crate) const fn new(memory: BitextTablesRef<'t>, used: Extent) -> Self {
        Self { memory, used, left_out: LeftOut::NONE }
    }

    /// The same data, with some sessions left out of training.
    pub(super) const fn without(self, left_out: LeftOut) -> Self {
        Self { left_out, ..self }
    }

    /// Whether a session is left out of training.
    pub fn leaves_out(self, session: u16) -> bool {
        self.left_out.has(session)
    }

    /// The weight of a pair, if each meaning counts as the square root of its number of occurrences.
    pub(super) fn weight_of_meaning(self, pair: &Pair) -> f32 {
        let same = |other: &&Pair| other.command == pair.command && !self.leaves_out(other.session);
        let times: f32 = self.pairs().iter().filter(same).map(|other| other.weight).sum();
        pair.weight / square_root(times.max(1.0))
    }

    /// Whether some sessions are left out of training.
    pub(super) fn leaves_out_any(self) -> bool {
        self.left_out != LeftOut::NONE
    }

    /// The number of sessions kept in training.
    #[cfg(feature = "layer")]
    pub(super) fn sessions_kept(self) -> usize {
        (0..self.used.sessions as u16).filter(|&session| !self.leaves_out(session)).count()
    }

    /// The number of sessions.
    #[cfg(not(feature = "layer"))]
    pub(super) const fn sessions_kept(self) -> usize {
        self.used.sessions
    }

    /// The number of words in all sessions, repetitions included.
    #[cfg(feature = "layer")]
    pub(super) const fn words_said(self) -> usize {
        self.used.sentence_words
    }

    /// The number of sessions.
    pub const fn sessions(self) -> usize {
        self.used.sessions
    }

    /// Whether a session is being removed, and some pairs or machine commands are not at their place.
    pub(crate) const fn is_removing(self) -> bool {
        self.used.removal.from > 0 || self.used.removal.until > 0
    }

    /// A number that changes whenever sessions are added or removed.
    pub(crate) const fn changes(self) -> u32 {
        self.used.changes
    }

    /// The number of distinct machine commands.
    pub const fn commands(self) -> usize {
        self.used.commands
    }

    /// The pairs, session by session.
    pub fn pairs(self) -> &'t [Pair] {
        self.memory.pairs.get(..self.used.pairs).unwrap_or(&[])
    }

    /// The words of a session's English command.
    pub fn sentence(self, session: u16) -> &'t [Symbol] {
        span(self.memory.sessions, self.memory.sentence_words, usize::from(session), self.used.sessions)
    }

    /// The number of words of the longest English command.
    pub fn longest_sentence(self) -> usize {
        self.memory.sessions.iter().take(self.used.sessions).map(|span| span.len()).max().unwrap_or(0)
    }

    /// Whether a session's English command was heard more than once in the robot's life, as far as its sessions tell.
    pub fn heard_again(self, session: u16) -> bool {
        let span = self.memory.sessions.get(..self.used.sessions).and_then(|sessions| sessions.get(usize::from(session)));
        span.is_some_and(|span| span.0 & Span::AGAIN != 0)
    }

    /// The tokens of a machine command.
    pub fn command(self, command: u16) -> &'t [Symbol] {
        span(self.memory.commands, self.memory.command_tokens, usize::from(command), self.used.commands)
    }

    /// The pairs of one session.
    pub fn pairs_of(self, session: u16) -> &'t [Pair] {
        let pairs = self.pairs();
        let start = pairs.partition_point(|pair| pair.session < session);
        let end = pairs.partition_point(|pair| pair.session <= session);
        pairs.get(start..end).unwrap_or(&[])
    }

    /// The sizes of the tables.
    pub(crate) fn room(self, rooms: &mut Capacities) {
        rooms.commands = self.memory.commands.len().min(usize::from(u16::MAX));
        rooms.command_tokens = self.memory.command_tokens.len().min(MOST_POOL);
        rooms.sessions = self.memory.sessions.len().min(usize::from(u16::MAX));
        rooms.sentence_words = self.memory.sentence_words.len().min(MOST_POOL);
        rooms.pairs = self.memory.pairs.len();
    }

    /// The used parts of the tables.
    pub(crate) const fn usage(self, used: &mut Capacities) {
        let Extent { commands, command_tokens, sessions, sentence_words, pairs, .. } = self.used;
        (used.commands, used.command_tokens) = (commands, command_tokens);
        (used.sessions, used.sentence_words, used.pairs) = (sessions, sentence_words, pairs);
    }
}

impl<'t> Bitext<'t> {
    /// The data in the extent `used`.
    pub(crate) const fn new(memory: BitextTables<'t>, used: &'t mut Extent) -> Self {
        Self { memory, used }
    }

    /// The data, read-only.
    pub const fn read(&self) -> BitextRef<'_> {
        BitextRef::new(self.memory.read(), *self.used)
    }

    /// The number of sessions.
    pub const fn sessions(&self) -> usize {
        self.used.sessions
    }

    const fn count_change(&mut self) {
        self.used.changes = self.used.changes.wrapping_add(1);
    }

    /// Forgets everything.
    pub(crate) const fn clear(&mut self) {
        *self.used = Extent { changes: self.used.changes, ..Extent::NONE };
        self.count_change();
    }

    pub(crate) fn set_heard_again(&mut self, session: u16) {
        self.count_change();
        if let Some(span) = self.memory.sessions.get_mut(..self.used.sessions).and_then(|all| all.get_mut(usize::from(session))) {
            span.0 |= Span::AGAIN;
        }
    }

    /// The used part, for [`rewind`](Self::rewind).
    pub const fn extent(&self) -> Extent {
        *self.used
    }

    /// Forgets all data after `extent`.
    pub fn rewind(&mut self, extent: Extent) {
        *self.used = extent;
    }

    /// Adds a session with its English command. Pairs added afterwards belong to it.
    ///
    /// # Errors
    /// A [`CapacityError`]; nothing is added then.
    pub fn add_session(&mut self, words: &[Symbol]) -> Result<(), CapacityError> {
        Capacity::WordsPerCommand.fits(words.len(), WORDS_PER_COMMAND)?;
        let (spans, pool) = (&mut *self.memory.sessions, &mut *self.memory.sentence_words);
        let capacities = [Capacity::Sessions, Capacity::SentenceWords];
        add_span(spans, &mut self.used.sessions, pool, &mut self.used.sentence_words, words, capacities)?;
        self.count_change();
        Ok(())
    }

    /// Adds a pair of the last session's English command and a machine command.
    ///
    /// # Errors
    /// A [`CapacityError`]; nothing is added then.
    pub fn add_pair(&mut self, tokens: &[Symbol], weight: f32) -> Result<(), CapacityError> {
        let limit = self.memory.pairs.len();
        if self.used.pairs >= limit {
            return Err(CapacityError::full(Capacity::Pairs, limit));
        }
        let command = self.intern_command(tokens)?;
        self.add_pair_with(command, weight)
    }

    /// Adds a pair of the last session's English command and a machine command, by its position.
    pub(crate) fn add_pair_with(&mut self, command: u16, weight: f32) -> Result<(), CapacityError> {
        let full = CapacityError::full(Capacity::Pairs, self.memory.pairs.len());
        let entry = self.memory.pairs.get_mut(self.used.pairs).ok_or(full)?;
        *entry = Pair { session: self.used.sessions.saturating_sub(1) as u16, command, weight };
        self.used.pairs = self.used.pairs.saturating_add(1);
        Ok(())
    }

    /// Forgets a session and its pairs. Later ones move up by one. If another session has the same English command, it is marked as heard
    /// before.
    pub(super) fn remove_session(&mut self, session: u16) {
        self.begin_removal(session);
        while !self.remove_on() {}
    }

    /// Begins to forget a session as [`remove_session`](Self::remove_session) does: call [`remove_on`](Self::remove_on) until it is done.
    pub(super) fn begin_removal(&mut self, session: u16) {
        let position = usize::from(session);
        if position >= self.used.sessions {
            return;
        }
        self.count_change();
        let same = |&other: &u16| other != session && self.read().sentence(other) == self.read().sentence(session);
        if let Some(heir) = (0..self.used.sessions as u16).rev().find(same) {
            self.set_heard_again(heir);
        }
        remove_span(self.memory.sessions, &mut self.used.sessions, self.memory.sentence_words, &mut self.used.sentence_words, position);
        let pairs = self.read().pairs();
        let first = pairs.partition_point(|pair| pair.session < session);
        let from = pairs.partition_point(|pair| pair.session <= session);
        self.used.removal = Removal::of(from, self.used.pairs, self.used.commands);
        self.used.pairs = first;
    }

    /// Continues to forget a session, by a bounded part. Returns whether it is done.
    pub(super) fn remove_on(&mut self) -> bool {
        let (to, from, until) = (self.used.pairs, self.used.removal.from as usize, self.used.removal.until as usize);
        if until > 0 {
            let end = from.saturating_add(PAIRS_A_PART).min(until);
            let cells = Cell::from_mut(self.memory.pairs.get_mut(to..end).unwrap_or(&mut [])).as_slice_of_cells();
            for (to, from) in cells.iter().zip(cells.iter().skip(from.saturating_sub(to))) {
                let pair = from.get();
                to.set(Pair { session: pair.session.wrapping_sub(1), ..pair });
            }
            self.used.pairs = to.saturating_add(end.saturating_sub(from));
            self.used.removal = Removal::of(end, until, self.used.commands);
            return false;
        }
        // At most one machine command is removed at once, because the others are then renamed in all pairs.
        while let Some(command) = self.used.removal.from.checked_sub(1) {
            self.used.removal.from = command;
            let command = command as u16;
            if self.read().pairs().iter().any(|pair| pair.command == command) {
                continue;
            }
            let tokens = (&mut *self.memory.command_tokens, &mut self.used.command_tokens);
            remove_span(self.memory.commands, &mut self.used.commands, tokens.0, tokens.1, usize::from(command));
            for pair in self.memory.pairs.iter_mut().take(self.used.pairs).filter(|pair| pair.command > command) {
                pair.command = pair.command.saturating_sub(1);
            }
            return false;
        }
        true
    }

    /// The words of all sessions.
    pub(super) fn words_mut(&mut self) -> &mut [Symbol] {
        self.memory.sentence_words.get_mut(..self.used.sentence_words).unwrap_or(&mut [])
    }

    /// The tokens of all machine commands.
    pub(super) fn tokens_mut(&mut self) -> &mut [Symbol] {
        self.memory.command_tokens.get_mut(..self.used.command_tokens).unwrap_or(&mut [])
    }

    fn intern_command(&mut self, tokens: &[Symbol]) -> Result<u16, CapacityError> {
        Capacity::TokensPerCommand.fits(tokens.len(), TOKENS_PER_COMMAND)?;
        let data = self.read();
        // Most sessions have their machine commands in the order of the last one.
        let commands = data.commands() as u16;
        let next = data.pairs().last().map_or(0, |pair| pair.command.saturating_add(1)).min(commands);
        match (next..commands).chain(0..next).find(|&command| data.command(command) == tokens) {
            Some(command) => Ok(command),
            None => self.add_command(tokens),
        }
    }

    /// Adds a machine command. Returns its position.
    pub(crate) fn add_command(&mut self, tokens: &[Symbol]) -> Result<u16, CapacityError> {
        let (spans, pool) = (&mut *self.memory.commands, &mut *self.memory.command_tokens);
        let capacities = [Capacity::Commands, Capacity::CommandTokens];
        add_span(spans, &mut self.used.commands, pool, &mut self.used.command_tokens, tokens, capacities)
    }
}

#[inline(never)]
fn span<'a>(spans: &[Span], pool: &'a [Symbol], position: usize, used: usize) -> &'a [Symbol] {
    let Some(span) = spans.get(position).filter(|_| position < used) else { return &[] };
    pool.get(span.start()..span.end()).unwrap_or(&[])
}

/// Removes one span of a table and its symbols from their pool; later ones move up.
fn remove_span(spans: &mut [Span], used: &mut usize, pool: &mut [Symbol], pool_used: &mut usize, position: usize) {
    let Some(spans) = spans.get_mut(position..*used) else { return };
    let Some(&mut removed) = spans.first_mut() else { return };
    let length = removed.len();
    if let Some(pool) = pool.get_mut(removed.start()..*pool_used).filter(|pool| pool.len() >= length) {
        close_gap(pool, length);
    }
    close_gap(spans, 1);
    for span in spans {
        *span = span.moved(span.start().saturating_sub(length));
    }
    *used = used.saturating_sub(1);
    *pool_used = pool_used.saturating_sub(length);
}

/// Adjusts a symbol after `removed` was taken out of its table; a marker is in no table.
pub(super) fn close_up(symbol: &mut Symbol, removed: Symbol) {
    if *symbol > removed && !is_marker(*symbol) {
        symbol.0 = symbol.0.saturating_sub(1);
    }
}

/// Adds a span to a table, and its symbols to their pool. Returns its position.
fn add_span(
    spans: &mut [Span],
    used: &mut usize,
    pool: &mut [Symbol],
    pool_used: &mut usize,
    symbols: &[Symbol],
    [of_spans, of_pool]: [Capacity; 2],
) -> Result<u16, CapacityError> {
    let (position, limit, start) = (*used, spans.len().min(usize::from(u16::MAX)), *pool_used);
    let entry = spans.get_mut(position).filter(|_| position < limit).ok_or(CapacityError::full(of_spans, limit))?;
    let end = start.saturating_add(symbols.len());
    let full = CapacityError::new(of_pool, pool.len().min(MOST_POOL), end);
    pool.get_mut(start..end).filter(|_| end <= MOST_POOL).ok_or(full)?.iter_mut().zip(symbols).for_each(|(slot, &symbol)| *slot = symbol);
    *entry = Span::new(start, symbols.len().min(Span::LENGTH as usize));
    (*used, *pool_used) = (position.saturating_add(1), end);
    Ok(position as u16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_meaning_counts_as_the_root_of_how_often_it_was_told() {
        let (mut commands, mut command_tokens) = ([Span::UNUSED; 2], [Symbol(0); 2]);
        let (mut sessions, mut pairs) = ([Span::UNUSED; 5], [Pair::UNUSED; 5]);
        let mut used = Extent::NONE;
        let memory = BitextTables {
            commands: &mut commands,
            command_tokens: &mut command_tokens,
            sessions: &mut sessions,
            sentence_words: &mut [],
            pairs: &mut pairs,
        };
        let mut bitext = Bitext::new(memory, &mut used);
        for meaning in [0, 0, 1, 0, 0] {
            bitext.add_session(&[]).unwrap();
            bitext.add_pair(&[Symbol(meaning)], 1.0).unwrap();
        }
        let weights: std::vec::Vec<f32> = bitext.read().pairs().iter().map(|pair| bitext.read().weight_of_meaning(pair)).collect();
        assert_eq!(weights, [0.5, 0.5, 1.0, 0.5, 0.5]);
    }
}
