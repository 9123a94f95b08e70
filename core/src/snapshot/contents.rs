//! A model file that was checked, to look into without restoring it.

use super::error::{Part, RestoreError};
use super::record::{
    CHECK_BYTES, CommandRecord, HEADER_BYTES, LAYERED_VERSION, LEAST_BYTES, MAGIC, OLDEST_VERSION, OPTIONS_BYTES, OptionsRecord,
    PairRecord, RestsRecord, SessionRecord, Sizes, StrategyRecord, TrainerRecord,
};
use crate::capacity::{Capacities, NAME_BYTES, TOKENS_PER_COMMAND};
use crate::checksum::CHECK;
use crate::feedback::Strategy;
use crate::language::Model;
use crate::language::ibm2::lengths::SeenLengths;
use crate::language::roles::Layout;
use crate::language::settings::is_weight;
use crate::language::tokenizer::word_form;
use crate::session::Options;
use crate::symbols::Symbol;
use crate::task::role::is_marker;
use core::marker::PhantomData;
use serde::Deserialize;

/// A sequence of records of one kind, read as it is walked through.
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

impl<T> Section<'_, T> {
    const NONE: Self = Self { count: 0, bytes: &[], record: PhantomData };
}

impl<'a, T: Deserialize<'a>> Section<'a, T> {
    /// How many records.
    pub fn len(&self) -> usize {
        self.count as usize
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The records, in order.
    pub fn iter(&self) -> impl Iterator<Item = T> + Clone + use<'a, T> {
        let mut rest = self.bytes;
        (0..self.count).map_while(move |_| take(&mut rest))
    }
}

/// The start of every few records of a section, so that any record is found by reading few.
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
    /// The record at a position that the section has.
    pub(super) fn get(&self, position: usize) -> Option<T> {
        let mut rest = *self.marks.get(position.checked_div(self.stride)?)?;
        for _ in 0..position.checked_rem(self.stride)? {
            let _: T = take(&mut rest)?;
        }
        take(&mut rest)
    }
}

/// Reads one value off the front.
fn take<'a, T: Deserialize<'a>>(rest: &mut &'a [u8]) -> Option<T> {
    let (value, after) = postcard::take_from_bytes(rest).ok()?;
    *rest = after;
    Some(value)
}

/// Reads one section off the front; `check` says whether a record can be.
fn section<'a, T: Deserialize<'a>>(
    rest: &mut &'a [u8],
    part: Part,
    mut check: impl FnMut(&T) -> bool,
) -> Result<Section<'a, T>, RestoreError> {
    let wrong = RestoreError::Inconsistent(part);
    let count: u32 = take(rest).ok_or(wrong)?;
    let bytes = *rest;
    for _ in 0..count {
        let record: T = take(rest).ok_or(wrong)?;
        if !check(&record) {
            return Err(wrong);
        }
    }
    Ok(Section { count, bytes, record: PhantomData })
}

/// A model file that was checked: whole, undamaged, and every number in it in its range.
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
    /// The digest of the domain's vocabulary; 0 where the model was saved without a domain.
    pub vocabulary: u32,
    /// How large the tables were that it was saved from; 0 for those of a home or of one session.
    pub sizes: Capacities,
    /// How the robot learns.
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
    /// Whether the command of each session was heard more than once in the robot's life. Files of before this was kept have none.
    pub heard_again: Section<'a, bool>,
    /// How late each strategy's words come, and its probability before the trainer was met. Files of before this was kept have none: no
    /// word is late, and the trainer is met now.
    pub trainers: Section<'a, TrainerRecord>,
    /// How each strategy judges rests. Older files have none: rests are then judged like moves.
    pub rests: Section<'a, RestsRecord>,
    /// The descriptions of all tasks of the sessions, for the [layer](crate::language::layer).
    #[cfg(feature = "layer")]
    pub possible_commands: Section<'a, CommandRecord>,
    /// How many tasks each session has, of the first sessions.
    #[cfg(feature = "layer")]
    pub possible_counts: Section<'a, u32>,
    /// The tasks of all sessions, session by session, with the prior of each.
    #[cfg(feature = "layer")]
    pub possible: Section<'a, PairRecord>,
}

impl<'a> Contents<'a> {
    /// Reads and checks a model file.
    ///
    /// # Errors
    /// [`RestoreError`] where it is not one, or is damaged.
    pub fn read(bytes: &'a [u8]) -> Result<Self, RestoreError> {
        let (version, mut rest) = payload(bytes)?;
        let (is_layered, rest) = (version == LAYERED_VERSION, &mut rest);
        let head = RestoreError::Inconsistent(Part::Head);
        let vocabulary: u32 = take(rest).ok_or(head)?;
        let sizes = take::<Sizes>(rest).ok_or(head)?.capacities();
        #[cfg_attr(not(feature = "layer"), expect(unused_mut, reason = "as with the feature"))]
        let mut options = options(rest).ok_or(RestoreError::Inconsistent(Part::Options))?;
        #[cfg(feature = "layer")]
        {
            options.language.layer = is_layered;
        }
        let strategies: Section<'a, StrategyRecord> =
            section(rest, Part::Strategies, |record: &StrategyRecord| record.strategy().is_some())?;
        let sum: f32 = strategies.iter().map(|record| record.probability).sum();
        // An agent always has a strategy; a language model alone has none.
        if !strategies.is_empty() && sum <= 0.0 {
            return Err(RestoreError::Inconsistent(Part::Strategies));
        }
        // A longer word than the model keeps would be another one once it is heard.
        let letters = options.language.letters_kept();
        let words = section(rest, Part::Words, |text: &&str| text.len() <= NAME_BYTES && word_form(text, letters) == *text)?;
        let tokens = section(rest, Part::Tokens, |text: &&str| text.len() <= NAME_BYTES)?;
        let (word_count, token_count) = (words.len(), tokens.len());
        let below = |positions: &[u16], count: usize| positions.iter().all(|&position| usize::from(position) < count);
        let by_roles = options.language.model == Model::Roles;
        let sound = |&token: &u16| usize::from(token) < token_count || (by_roles && is_marker(Symbol(token)));
        let commands = section(rest, Part::Commands, |command: &CommandRecord| command.iter().all(sound))?;
        let mut wanted = 0_u64;
        let sessions = section(rest, Part::Sessions, |session: &SessionRecord| {
            wanted = wanted.saturating_add(u64::from(session.pairs));
            below(&session.words, word_count)
        })?;
        let command_count = commands.len();
        let sound = |pair: &PairRecord| usize::from(pair.command) < command_count && is_weight(pair.weight);
        let pairs = section(rest, Part::Pairs, sound)?;
        if pairs.len() as u64 != wanted {
            return Err(RestoreError::Inconsistent(Part::Pairs));
        }
        let session_count = sessions.len();
        let heard_again = if rest.is_empty() { Section::NONE } else { section(rest, Part::HeardAgain, |_: &bool| true)? };
        if !(heard_again.is_empty() || heard_again.len() == session_count) {
            return Err(RestoreError::Inconsistent(Part::HeardAgain));
        }
        let trainers =
            if rest.is_empty() { Section::NONE } else { section(rest, Part::Trainers, |record: &TrainerRecord| record.is_sound())? };
        if !(trainers.is_empty() || trainers.len() == strategies.len()) {
            return Err(RestoreError::Inconsistent(Part::Trainers));
        }
        let sound = |&rests: &RestsRecord| Strategy::UNUSED.with_rests(rests).is_ok();
        let rests = if rest.is_empty() { Section::NONE } else { section(rest, Part::Rests, sound)? };
        if !(rests.is_empty() || rests.len() == strategies.len()) {
            return Err(RestoreError::Inconsistent(Part::Rests));
        }
        #[cfg(feature = "layer")]
        let (possible_commands, possible_counts, possible) = match is_layered {
            true => tasks(rest, session_count, token_count)?,
            false => (Section::NONE, Section::NONE, Section::NONE),
        };
        // Without the layer, what a model has for it is not looked at.
        let is_left_over = cfg!(feature = "layer") || !is_layered;
        if is_left_over && !rest.is_empty() {
            return Err(RestoreError::Inconsistent(Part::Rests));
        }
        Ok(Self {
            vocabulary,
            sizes,
            options,
            strategies,
            words,
            tokens,
            commands,
            sessions,
            pairs,
            heard_again,
            trainers,
            rests,
            #[cfg(feature = "layer")]
            possible_commands,
            #[cfg(feature = "layer")]
            possible_counts,
            #[cfg(feature = "layer")]
            possible,
        })
    }
}

impl Contents<'_> {
    /// The strategies with their probabilities now, each with its probability before the trainer was met.
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

    /// The least capacities of memory that has room for all of it.
    pub fn needs(&self) -> Capacities {
        let (alignments, length_pairs) = match self.options.language.model {
            Model::Roles => (self.layout().cells(), 0),
            Model::Model2 => self.alignment_tables(),
        };
        Capacities {
            strategies: self.strategies.len(),
            words: self.words.len(),
            word_bytes: self.words.iter().map(str::len).sum(),
            tokens: self.tokens.len(),
            token_bytes: self.tokens.iter().map(str::len).sum(),
            commands: self.commands.len(),
            command_tokens: self.commands.iter().map(|command| command.len()).sum(),
            sessions: self.sessions.len(),
            sentence_words: self.sessions.iter().map(|session| session.words.len()).sum(),
            pairs: self.pairs.len(),
            translations: self.tokens.len().saturating_add(1).saturating_mul(self.words.len()),
            alignments,
            length_pairs,
            ..Capacities::NONE
        }
    }

    /// The role model's parameters.
    fn layout(&self) -> Layout {
        let mut layout = Layout::NONE;
        for record in self.commands.iter() {
            layout.see(&symbols(&record));
        }
        for session in self.sessions.iter() {
            layout.see_length(session.words.len());
        }
        layout.with(self.words.len(), self.tokens.len())
    }

    /// Cells of Model 2's alignment tables together, and how many tables there are.
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
        // As many as the record has, so they fit.
        let _ = symbols.push(Symbol(token));
    }
    symbols
}

/// The tasks of all sessions: their descriptions, how many each session has, and the tasks with their priors.
#[cfg(feature = "layer")]
type Tasks<'a> = (Section<'a, CommandRecord>, Section<'a, u32>, Section<'a, PairRecord>);

/// Reads the tasks that so many sessions could have meant, in so many machine tokens.
#[cfg(feature = "layer")]
fn tasks<'a>(rest: &mut &'a [u8], sessions: usize, tokens: usize) -> Result<Tasks<'a>, RestoreError> {
    let is_sound = |&token: &u16| usize::from(token) < tokens || is_marker(Symbol(token));
    let commands = section(rest, Part::Possible, |command: &CommandRecord| command.iter().all(is_sound))?;
    let mut wanted = 0_u64;
    let counts = section(rest, Part::Possible, |&count: &u32| {
        wanted = wanted.saturating_add(u64::from(count));
        true
    })?;
    let pairs = section(rest, Part::Possible, |pair: &PairRecord| usize::from(pair.command) < commands.len() && is_weight(pair.weight))?;
    let is_whole = rest.is_empty() && pairs.len() as u64 == wanted && counts.len() <= sessions;
    if is_whole { Ok((commands, counts, pairs)) } else { Err(RestoreError::Inconsistent(Part::Possible)) }
}

/// The format, and the bytes between the header and the check, if both are right.
fn payload(bytes: &[u8]) -> Result<(u16, &[u8]), RestoreError> {
    let mut rest = bytes.strip_prefix(&MAGIC).ok_or(RestoreError::NotAModel)?;
    let truncated = RestoreError::Length { stated: LEAST_BYTES as u32, given: bytes.len() };
    let found = u16::from_le_bytes(*split_array(&mut rest).ok_or(truncated)?);
    if !(OLDEST_VERSION..=LAYERED_VERSION).contains(&found) {
        return Err(RestoreError::Version { found });
    }
    let stated = u32::from_le_bytes(*split_array(&mut rest).ok_or(truncated)?);
    if usize::try_from(stated) != Ok(bytes.len()) || bytes.len() < LEAST_BYTES {
        return Err(RestoreError::Length { stated, given: bytes.len() });
    }
    let (checked, check) = bytes.split_last_chunk::<CHECK_BYTES>().ok_or(truncated)?;
    if CHECK.checksum(checked) != u32::from_le_bytes(*check) {
        return Err(RestoreError::Damaged);
    }
    Ok((found, checked.get(HEADER_BYTES..).ok_or(truncated)?))
}

fn split_array<'a, const N: usize>(rest: &mut &'a [u8]) -> Option<&'a [u8; N]> {
    let (array, after) = rest.split_first_chunk::<N>()?;
    *rest = after;
    Some(array)
}

/// The options: a record in a byte string of its own. Fields that later versions append to it are 0 where a file does not have them.
fn options(rest: &mut &[u8]) -> Option<Options> {
    let bytes: &[u8] = take(rest)?;
    let mut filled = [0; OPTIONS_BYTES];
    filled.get_mut(..bytes.len())?.copy_from_slice(bytes);
    let mut left = filled.as_slice();
    let record: OptionsRecord = take(&mut left)?;
    let read = OPTIONS_BYTES.saturating_sub(left.len());
    (bytes.len() <= read && record.is_sound()).then(|| record.options())
}
