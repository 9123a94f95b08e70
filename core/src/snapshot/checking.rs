//! Checking a model file record by record, in parts.

use super::error::{Part, RestoreError};
use super::record::{
    CHECK_BYTES, CommandRecord, HEADER_BYTES, KINDS_MAGIC, LAYERED_VERSION, LEAST_BYTES, MAGIC, OLDEST_VERSION, OPTIONS_BYTES,
    OptionsRecord, PairRecord, RestsRecord, SessionRecord, Sizes, StrategyRecord, TrainerRecord, chunk, symbols,
};
use super::section::{Place, Section, take};
use crate::capacity::NAME_BYTES;
use crate::checksum::Running;
use crate::feedback::Strategy;
use crate::language::Model;
use crate::language::roles::Layout;
use crate::language::settings::is_weight;
use crate::language::tokenizer::word_form;
use crate::planning::Progress;
use crate::session::Options;
use crate::symbols::Symbol;
use crate::task::role::is_marker;
use serde::Deserialize;

/// The sections of a file, in their order. The layer's three come last.
const SECTIONS: [Part; SECTION_COUNT] = [
    Part::Strategies,
    Part::Words,
    Part::Tokens,
    Part::Commands,
    Part::Sessions,
    Part::Pairs,
    Part::HeardAgain,
    Part::Trainers,
    Part::Rests,
    #[cfg(feature = "layer")]
    Part::Possible,
    #[cfg(feature = "layer")]
    Part::Possible,
    #[cfg(feature = "layer")]
    Part::Possible,
];
const SECTION_COUNT: usize = if cfg!(feature = "layer") { 12 } else { 9 };

pub(super) const STRATEGIES: u8 = 0;
pub(super) const WORDS: u8 = 1;
pub(super) const TOKENS: u8 = 2;
pub(super) const COMMANDS: u8 = 3;
pub(super) const SESSIONS: u8 = 4;
pub(super) const PAIRS: u8 = 5;
pub(super) const HEARD_AGAIN: u8 = 6;
pub(super) const TRAINERS: u8 = 7;
pub(super) const RESTS: u8 = 8;
pub(super) const POSSIBLE_COMMANDS: u8 = 9;
pub(super) const POSSIBLE_COUNTS: u8 = 10;
pub(super) const POSSIBLE: u8 = 11;

/// Bytes checked for one cell of budget.
pub(super) const BYTES_PER_CELL: usize = 8;

/// The totals over a file's records.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tally {
    pub word_bytes: usize,
    pub token_bytes: usize,
    pub command_tokens: usize,
    pub sentence_words: usize,
    /// The layout of the role model's parameters, except for the numbers of words and tokens.
    pub layout: Layout,
}

/// The next part of the file to check.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// The first bytes.
    Header,
    /// The checksum of all bytes, read up to this one.
    Bytes(usize),
    Head,
    /// A section, and the number of its unread records.
    Section(u8, u32),
    Done,
}

/// A model file, and how far it is checked.
#[derive(Clone, Debug)]
pub(super) struct Checking<'a> {
    pub bytes: &'a [u8],
    stage: Stage,
    running: Running,
    version: u16,
    /// The unread bytes.
    rest: &'a [u8],
    places: [Place; SECTION_COUNT],
    letters: usize,
    by_roles: bool,
    /// The sum of the strategies' probabilities.
    believed: f32,
    /// The number of pairs that the sessions state; then, for the layer, the number of tasks.
    pairs_wanted: u32,
    pub tally: Tally,
}

impl<'a> Checking<'a> {
    /// Nothing is checked yet.
    pub fn of(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            stage: Stage::Header,
            running: Running::new(),
            version: 0,
            rest: &[],
            places: [Place::NONE; SECTION_COUNT],
            letters: 0,
            by_roles: false,
            believed: 0.0,
            pairs_wanted: 0,
            tally: Tally { word_bytes: 0, token_bytes: 0, command_tokens: 0, sentence_words: 0, layout: Layout::NONE },
        }
    }

    /// Checks the whole file.
    pub fn all(&mut self) -> Result<(), RestoreError> {
        while self.on(&mut { u32::MAX })? == Progress::Working {}
        Ok(())
    }

    /// Continues, with about `left` units of work: at least one record.
    pub fn on(&mut self, left: &mut u32) -> Result<Progress, RestoreError> {
        loop {
            let work = match self.stage {
                Stage::Done => return Ok(Progress::Done),
                _ if *left == 0 => return Ok(Progress::Working),
                Stage::Header => {
                    (self.version, self.bytes) = version(self.bytes)?;
                    self.stage = Stage::Bytes(0);
                    1
                }
                Stage::Bytes(from) => self.check_bytes(from, *left)?,
                Stage::Head => {
                    self.head()?;
                    self.begin(STRATEGIES)?;
                    1
                }
                Stage::Section(section, 0) => {
                    self.end(section)?;
                    self.begin(section.saturating_add(1))?;
                    1
                }
                Stage::Section(section, records) => {
                    self.stage = Stage::Section(section, records.saturating_sub(1));
                    self.record(section)?.saturating_add(1)
                }
            };
            *left = left.saturating_sub(work as u32);
        }
    }

    fn check_bytes(&mut self, from: usize, left: u32) -> Result<usize, RestoreError> {
        let truncated = RestoreError::Length { stated: LEAST_BYTES as u32, given: self.bytes.len() };
        let (checked, check) = self.bytes.split_last_chunk::<CHECK_BYTES>().ok_or(truncated)?;
        let to = from.saturating_add((left as usize).saturating_mul(BYTES_PER_CELL)).min(checked.len());
        self.running.update(checked.get(from..to).unwrap_or(&[]));
        self.stage = Stage::Bytes(to);
        if to == checked.len() {
            if self.running.value() != u32::from_le_bytes(*check) {
                return Err(RestoreError::Damaged);
            }
            self.rest = checked.get(HEADER_BYTES..).ok_or(truncated)?;
            self.stage = Stage::Head;
        }
        Ok(to.saturating_sub(from).div_ceil(BYTES_PER_CELL))
    }

    #[inline(never)]
    fn head(&mut self) -> Result<(), RestoreError> {
        let wrong = RestoreError::Inconsistent(Part::Head);
        let _: u32 = take(&mut self.rest).ok_or(wrong)?;
        let _: Sizes = take(&mut self.rest).ok_or(wrong)?;
        let language = options(&mut self.rest).ok_or(RestoreError::Inconsistent(Part::Options))?.language;
        (self.letters, self.by_roles) = (language.letters_kept(), language.model == Model::Roles);
        Ok(())
    }

    /// Begins a section. Older files lack the last sections.
    fn begin(&mut self, section: u8) -> Result<(), RestoreError> {
        let is_layered = self.is_layered();
        let Some(&part) = SECTIONS.get(usize::from(section)).filter(|_| section <= RESTS || is_layered) else {
            // A core without the layer ignores its sections.
            let is_left_over = (cfg!(feature = "layer") || !is_layered) && !self.rest.is_empty();
            let last = if is_layered { Part::Possible } else { Part::Rests };
            self.stage = Stage::Done;
            return if is_left_over { Err(RestoreError::Inconsistent(last)) } else { Ok(()) };
        };
        let is_missing = (HEARD_AGAIN..=RESTS).contains(&section) && self.rest.is_empty();
        let count = if is_missing { 0 } else { take(&mut self.rest).ok_or(RestoreError::Inconsistent(part))? };
        let from = self.bytes.len().saturating_sub(CHECK_BYTES).saturating_sub(self.rest.len());
        if let Some(place) = self.places.get_mut(usize::from(section)) {
            *place = Place { count, from: from as u32 };
        }
        #[cfg(feature = "layer")]
        if section == POSSIBLE_COUNTS {
            self.pairs_wanted = 0;
        }
        self.stage = Stage::Section(section, count);
        Ok(())
    }

    pub fn count(&self, section: u8) -> usize {
        self.place(section).count as usize
    }

    fn place(&self, section: u8) -> Place {
        self.places.get(usize::from(section)).copied().unwrap_or(Place::NONE)
    }

    /// Checks that a section agrees with the earlier ones, once all its records are read.
    fn end(&self, section: u8) -> Result<(), RestoreError> {
        let count = self.count(section);
        let agrees = |with: u8| count == 0 || count == self.count(with);
        let is_sound = match section {
            // An agent always has a strategy; a language model alone has none.
            STRATEGIES => count == 0 || self.believed > 0.0,
            PAIRS => count == self.pairs_wanted as usize,
            HEARD_AGAIN => agrees(SESSIONS),
            TRAINERS | RESTS => agrees(STRATEGIES),
            #[cfg(feature = "layer")]
            POSSIBLE_COUNTS => count <= self.count(SESSIONS),
            #[cfg(feature = "layer")]
            POSSIBLE => count == self.pairs_wanted as usize,
            _ => true,
        };
        let part = SECTIONS.get(usize::from(section)).copied().unwrap_or(Part::Rests);
        if is_sound { Ok(()) } else { Err(RestoreError::Inconsistent(part)) }
    }

    /// Checks one record. Returns the number of its entries.
    fn record(&mut self, section: u8) -> Result<usize, RestoreError> {
        let part = SECTIONS.get(usize::from(section)).copied().unwrap_or(Part::Rests);
        self.sound_record(section).ok_or(RestoreError::Inconsistent(part))
    }

    fn sound_record(&mut self, section: u8) -> Option<usize> {
        let rest = &mut self.rest;
        match section {
            STRATEGIES => {
                let record: StrategyRecord = take(rest)?;
                let _ = record.strategy()?;
                self.believed += record.probability;
                Some(4)
            }
            WORDS => {
                let text: &str = take(rest)?;
                self.tally.word_bytes = self.tally.word_bytes.saturating_add(text.len());
                // A word with more letters than the model keeps would never match a heard word.
                (text.len() <= NAME_BYTES && word_form(text, self.letters) == text).then_some(text.len())
            }
            TOKENS => {
                let text: &str = take(rest)?;
                self.tally.token_bytes = self.tally.token_bytes.saturating_add(text.len());
                (text.len() <= NAME_BYTES).then_some(text.len())
            }
            COMMANDS => self.command(),
            SESSIONS => {
                let session: SessionRecord = take(rest)?;
                let (known, words) = (self.count(WORDS), session.words.len());
                self.pairs_wanted = self.pairs_wanted.saturating_add(session.pairs);
                self.tally.sentence_words = self.tally.sentence_words.saturating_add(words);
                self.tally.layout.see_length(words);
                session.words.iter().all(|&word| usize::from(word) < known).then_some(words)
            }
            PAIRS => {
                let pair: PairRecord = take(rest)?;
                (usize::from(pair.command) < self.count(COMMANDS) && is_weight(pair.weight)).then_some(0)
            }
            HEARD_AGAIN => take::<bool>(rest).map(|_| 0),
            TRAINERS => take::<TrainerRecord>(rest)?.is_sound().then_some(4),
            RESTS => {
                let rests: RestsRecord = take(rest)?;
                Strategy::UNUSED.with_rests(rests).is_ok().then_some(4)
            }
            #[cfg(feature = "layer")]
            POSSIBLE_COMMANDS => {
                let (record, tokens): (CommandRecord, _) = (take(rest)?, self.count(TOKENS));
                record.iter().all(|&token| usize::from(token) < tokens || is_marker(Symbol(token))).then_some(record.len())
            }
            #[cfg(feature = "layer")]
            POSSIBLE_COUNTS => {
                let count: u32 = take(rest)?;
                self.pairs_wanted = self.pairs_wanted.saturating_add(count);
                Some(0)
            }
            #[cfg(feature = "layer")]
            POSSIBLE => {
                let pair: PairRecord = take(rest)?;
                (usize::from(pair.command) < self.count(POSSIBLE_COMMANDS) && is_weight(pair.weight)).then_some(0)
            }
            _ => None,
        }
    }

    #[inline(never)]
    fn command(&mut self) -> Option<usize> {
        let (record, tokens): (CommandRecord, _) = (take(&mut self.rest)?, self.count(TOKENS));
        let is_sound = |&token: &u16| usize::from(token) < tokens || (self.by_roles && is_marker(Symbol(token)));
        if !record.iter().all(is_sound) {
            return None;
        }
        self.tally.command_tokens = self.tally.command_tokens.saturating_add(record.len());
        if self.by_roles {
            self.tally.layout.see(&symbols(&record));
        }
        Some(record.len())
    }

    /// Whether the file has the layer's sections.
    pub const fn is_layered(&self) -> bool {
        self.version == LAYERED_VERSION
    }

    /// A number that identifies the file: its checksum.
    pub fn mark(&self) -> u32 {
        self.running.value()
    }

    /// The records of a checked section.
    pub fn section<T: Deserialize<'a>>(&self, section: u8) -> Section<'a, T> {
        Section::at(self.bytes, self.place(section))
    }
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

/// Checks the first bytes and the length. Returns the format, and the model without the record that a host may have written after it.
fn version(bytes: &[u8]) -> Result<(u16, &[u8]), RestoreError> {
    let mut rest = bytes.strip_prefix(&MAGIC).ok_or(RestoreError::NotAModel)?;
    let truncated = RestoreError::Length { stated: LEAST_BYTES as u32, given: bytes.len() };
    let found = u16::from_le_bytes(chunk(&mut rest).ok_or(truncated)?);
    if !(OLDEST_VERSION..=LAYERED_VERSION).contains(&found) {
        return Err(RestoreError::Version { found });
    }
    let stated = u32::from_le_bytes(chunk(&mut rest).ok_or(truncated)?);
    match bytes.split_at_checked(stated as usize) {
        Some((model, after)) if model.len() >= LEAST_BYTES && (after.is_empty() || after.starts_with(&KINDS_MAGIC)) => Ok((found, model)),
        _ => Err(RestoreError::Length { stated, given: bytes.len() }),
    }
}
