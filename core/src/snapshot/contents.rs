//! A checked model file, to inspect without restoring it.

use super::checking::{Checking, Tally};
use super::error::RestoreError;
use super::record::{CommandRecord, OPTIONS_BYTES, OptionsRecord, PairRecord, RestsRecord, SessionRecord, StrategyRecord, TrainerRecord};
use crate::capacity::{Capacities, TOKENS_PER_COMMAND};
use crate::feedback::Strategy;
use crate::language::Model;
use crate::language::ibm2::lengths::SeenLengths;
use crate::session::Options;
use crate::symbols::Symbol;
use core::marker::PhantomData;
use serde::Deserialize;

/// A sequence of records of one kind, read while iterating.
#[derive(Debug)]
pub struct Section<'a, T> {
    count: u32,
    bytes: &'a [u8],
    record: PhantomData<T>,
}

impl<T> Clone for Section<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Section<'_, T> {}

/// The place of a section's records in a file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub count: u32,
    pub from: u32,
}

impl Place {
    /// No record.
    pub const NONE: Self = Self { count: 0, from: 0 };
}

impl<'a, T> Section<'a, T> {
    /// The records at a place of a file.
    pub(super) fn at(file: &'a [u8], place: Place) -> Self {
        Self { count: place.count, bytes: file.get(place.from as usize..).unwrap_or(&[]), record: PhantomData }
    }

    /// The bytes from its first record on.
    pub(super) const fn bytes(&self) -> &'a [u8] {
        self.bytes
    }
}

impl<'a, T: Deserialize<'a>> Section<'a, T> {
    /// The number of records.
    pub fn len(&self) -> usize {
        self.count as usize
    }

    /// Whether there are no records.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The records, in order.
    pub fn iter(&self) -> impl Iterator<Item = T> + Clone + use<'a, T> {
        let mut rest = self.bytes;
        (0..self.count).map_while(move |_| take(&mut rest))
    }
}

/// The starts of records at regular distances in a section, so that few records are read to find any one.
pub(super) struct Index<'a, T> {
    marks: [&'a [u8]; MARKS],
    stride: usize,
    record: PhantomData<T>,
}

const MARKS: usize = 32;

impl<'a, T: Deserialize<'a>> Section<'a, T> {
    pub(super) fn index(&self) -> Index<'a, T> {
        let stride = self.len().div_ceil(MARKS).max(1);
        let mut marks: [&[u8]; MARKS] = [&[]; MARKS];
        let mut rest = self.bytes;
        for mark in &mut marks {
            *mark = rest;
            for _ in 0..stride {
                let _: Option<T> = take(&mut rest);
            }
        }
        Index { marks, stride, record: PhantomData }
    }
}

impl<'a, T: Deserialize<'a>> Index<'a, T> {
    /// The record at a position within the section.
    pub(super) fn get(&self, position: usize) -> Option<T> {
        let mut rest = *self.marks.get(position.checked_div(self.stride)?)?;
        for _ in 0..position.checked_rem(self.stride)? {
            let _: T = take(&mut rest)?;
        }
        take(&mut rest)
    }
}

/// Reads one value from the front.
pub(super) fn take<'a, T: Deserialize<'a>>(rest: &mut &'a [u8]) -> Option<T> {
    let (value, after) = postcard::take_from_bytes(rest).ok()?;
    *rest = after;
    Some(value)
}

/// A checked model file: complete, undamaged, and with every number in its range.
///
/// ```
/// use goodbot::{Agent, Options, home, snapshot::Contents};
/// goodbot::memory! { struct Memory = goodbot::Capacities::SMALL; }
/// let mut memory = Memory::new();
/// let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks()?, Options::PAPER)?;
/// let mut buffer = [0; 4_096];
/// let saved = agent.save(&mut buffer)?;
/// let contents = Contents::read(&buffer[..saved])?;
/// assert_eq!(contents.sessions.len(), 0);
/// agent.restore(&buffer[..saved])?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Contents<'a> {
    /// The digest of the domain's vocabulary; 0 if the model was saved without a domain.
    pub vocabulary: u32,
    /// The table sizes of the memory that it was saved from; 0 for the tables of a home or of one session.
    pub sizes: Capacities,
    /// The options.
    pub options: Options,
    /// The trainer strategies and their probabilities.
    pub strategies: Section<'a, StrategyRecord>,
    /// The English words.
    pub words: Section<'a, &'a str>,
    /// The machine tokens.
    pub tokens: Section<'a, &'a str>,
    /// The machine commands.
    pub commands: Section<'a, CommandRecord>,
    /// The sessions.
    pub sessions: Section<'a, SessionRecord>,
    /// The pairs of all sessions, session by session.
    pub pairs: Section<'a, PairRecord>,
    /// Whether the command of each session was heard more than once in the robot's life. Older files have none.
    pub heard_again: Section<'a, bool>,
    /// The lags of each strategy, and its probability before the trainer was met. Older files have none: no word is then late, and the
    /// present probability is the prior.
    pub trainers: Section<'a, TrainerRecord>,
    /// How each strategy judges rests. Older files have none: rests are then judged like moves.
    pub rests: Section<'a, RestsRecord>,
    /// The descriptions of all tasks of the sessions, for the [layer](crate::language::layer).
    #[cfg(feature = "layer")]
    pub possible_commands: Section<'a, CommandRecord>,
    /// The number of tasks of each session; the last sessions may be missing.
    #[cfg(feature = "layer")]
    pub possible_counts: Section<'a, u32>,
    /// The tasks of all sessions, session by session, each with its prior.
    #[cfg(feature = "layer")]
    pub possible: Section<'a, PairRecord>,
    pub(super) tally: Tally,
}

impl<'a> Contents<'a> {
    /// Reads and checks a model file.
    ///
    /// # Errors
    /// [`RestoreError`] if it is no model file, or is damaged.
    pub fn read(bytes: &'a [u8]) -> Result<Self, RestoreError> {
        let mut checking = Checking::of(bytes);
        checking.all()?;
        checking.contents()
    }
}

impl Contents<'_> {
    /// The strategies with their present probabilities, each with its probability before the trainer was met.
    pub(crate) fn believed(&self) -> impl Iterator<Item = ((Strategy, f32), f32)> {
        let (mut trainers, mut rests) = (self.trainers.iter(), self.rests.iter());
        self.strategies.iter().filter_map(move |record| {
            let (mut strategy, probability) = record.strategy()?;
            if let Some(rests) = rests.next() {
                strategy = strategy.with_rests(rests).ok()?;
            }
            let Some(trainer) = trainers.next() else { return Some(((strategy, probability), probability)) };
            Some(((strategy.with_lags(trainer.lags).ok()?, probability), trainer.expected))
        })
    }

    /// The least capacities that have room for all of it.
    pub fn needs(&self) -> Capacities {
        let (alignments, length_pairs) = match self.options.language.model {
            Model::Roles => (self.tally.layout.with(self.words.len(), self.tokens.len()).cells(), 0),
            Model::Model2 => self.alignment_tables(),
        };
        Capacities {
            strategies: self.strategies.len(),
            words: self.words.len(),
            word_bytes: self.tally.word_bytes,
            tokens: self.tokens.len(),
            token_bytes: self.tally.token_bytes,
            commands: self.commands.len(),
            command_tokens: self.tally.command_tokens,
            sessions: self.sessions.len(),
            sentence_words: self.tally.sentence_words,
            pairs: self.pairs.len(),
            translations: self.tokens.len().saturating_add(1).saturating_mul(self.words.len()),
            alignments,
            length_pairs,
            ..Capacities::NONE
        }
    }

    /// The cells of Model 2's alignment tables together, and the number of tables.
    fn alignment_tables(&self) -> (usize, usize) {
        let (commands, mut pairs) = (self.commands.index(), self.pairs.iter());
        let mut lengths = SeenLengths::new();
        for session in self.sessions.iter() {
            for pair in pairs.by_ref().take(session.pairs as usize) {
                if let Some(command) = commands.get(usize::from(pair.command)) {
                    lengths.see(command.len(), session.words.len());
                }
            }
        }
        (lengths.cells, lengths.pairs)
    }
}

/// The tokens of a machine command.
pub(super) fn symbols(record: &CommandRecord) -> heapless::Vec<Symbol, TOKENS_PER_COMMAND> {
    let mut symbols = heapless::Vec::new();
    for &token in record {
        // There are no more tokens than the record has, so they fit.
        let _ = symbols.push(Symbol(token));
    }
    symbols
}

/// The options: a record in a byte string of its own. Later versions append fields, which are 0 if a file does not have them.
pub(super) fn options(rest: &mut &[u8]) -> Option<Options> {
    let bytes: &[u8] = take(rest)?;
    let mut filled = [0; OPTIONS_BYTES];
    filled.get_mut(..bytes.len())?.copy_from_slice(bytes);
    let mut left = filled.as_slice();
    let record: OptionsRecord = take(&mut left)?;
    let read = OPTIONS_BYTES.saturating_sub(left.len());
    (bytes.len() <= read && record.is_sound()).then(|| record.options())
}
