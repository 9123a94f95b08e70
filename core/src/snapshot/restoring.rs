//! Restoring a model in parts, record by record.

use super::checking::{COMMANDS, Checking, HEARD_AGAIN, PAIRS, SESSIONS, TOKENS, WORDS};
use super::contents::Contents;
use super::error::{Part, RestoreError};
use super::record::{CommandRecord, HEADER_BYTES, PairRecord, SessionRecord, symbols};
use super::section::take;
use crate::capacity::{TOKENS_PER_COMMAND, WORDS_PER_COMMAND};
use crate::language::model::{LanguageState, Used};
use crate::language::{LanguageMut, LanguageRef};
use crate::memory::LanguageTables;
use crate::oomdp::{Schema, vocabulary};
use crate::planning::Progress;
use crate::symbols::{Symbol, listed};
use crate::task::role::{Marker, VALUE_SORTS};
use heapless::Vec;

/// A model that is being restored in parts: [`Agent::restore_on`](crate::Agent::restore_on).
#[derive(Clone, Debug)]
pub struct Restoring<'a> {
    pub(super) checking: Checking<'a>,
    pub(super) stage: Stage,
    /// The unread records of this stage.
    rest: &'a [u8],
    /// The unread pairs, and how many of them belong to the last session.
    pairs: &'a [u8],
    of_session: u32,
    unlearned: Used,
    /// Identifies this restoring and its progress, to detect another one.
    pub(super) mark: u32,
    /// A vocabulary, and the earlier version of it that the model has; 0 if none is known.
    pub(super) continued: (u32, u32),
    added: AddedAttributes,
}

/// The next step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stage {
    Check,
    /// Checks that the robot's memory has room.
    Room,
    /// Checks that the text at this position of a section differs from each earlier one.
    Distinct(u8, u32),
    /// Makes the robot forget everything.
    Begin,
    /// Takes over the record at this position of a section.
    Take(u8, u32),
    /// Marks the records taken over as learned.
    Commit,
    Done,
}

/// The attributes of an earlier version of a vocabulary, and how many were added after them.
#[derive(Clone, Copy, Debug)]
pub(super) struct AddedAttributes {
    before: usize,
    added: usize,
}

impl AddedAttributes {
    /// The same vocabulary.
    const NONE: Self = Self { before: 0, added: 0 };

    /// A machine command of the earlier version. Its derived facts move behind the added attributes: they come after all attributes.
    pub(super) fn symbols(self, record: &CommandRecord) -> Vec<Symbol, TOKENS_PER_COMMAND> {
        if self.added == 0 {
            return symbols(record);
        }
        let mut has_room = true;
        listed(record.iter().filter_map(|&token| {
            let mut symbol = Symbol(token);
            if let Some(marker) = Marker::of(symbol) {
                let is_derived = usize::from(marker.sort >> 1) >= self.before;
                let sort = usize::from(marker.sort).saturating_add(if is_derived { self.added << 1 } else { 0 });
                has_room = sort < VALUE_SORTS;
                symbol = Marker { sort: sort as u8, ..marker }.symbol();
            }
            has_room.then_some(symbol)
        }))
    }
}

impl<'a> Restoring<'a> {
    /// A model file of which nothing is read yet.
    pub fn of(model: &'a [u8]) -> Self {
        Self {
            checking: Checking::of(model),
            stage: Stage::Check,
            rest: &[],
            pairs: &[],
            of_session: 0,
            unlearned: Used::NONE,
            mark: 0,
            continued: (0, 0),
            added: AddedAttributes::NONE,
        }
    }

    /// Also takes the model if it was learned with an earlier version of the domain's vocabulary: with fewer propositional functions or
    /// attributes at the end of their lists. Nothing of it is lost then, but derived facts beside four attributes. Call it before the first
    /// part; again it does nothing.
    pub fn continue_vocabulary(&mut self, schema: &Schema<'_>) {
        if self.continued.0 == 0 {
            let mut rest = self.checking.bytes.get(HEADER_BYTES..).unwrap_or(&[]);
            let known = take(&mut rest).and_then(|earlier| Some((earlier, vocabulary::continued(schema, earlier)?)));
            let (earlier, before) = known.unwrap_or((0, schema.attributes.len()));
            self.added = AddedAttributes { before, added: schema.attributes.len().saturating_sub(before) };
            self.continued = (vocabulary::digest(schema), earlier);
        }
    }

    /// Whether records are being taken over: the robot has forgotten its earlier training data, and these are not learned yet.
    pub(super) const fn is_taking(&self) -> bool {
        matches!(self.stage, Stage::Take(..) | Stage::Commit)
    }

    /// Continues the stage, for a language model in its tables, with about `left` units of work: at least one record.
    pub(super) fn step(
        &mut self,
        language: &mut LanguageState,
        tables: LanguageTables<'_>,
        workspace: &mut [u64],
        left: &mut u32,
    ) -> Result<(), RestoreError> {
        match self.stage {
            Stage::Done => {}
            Stage::Check => {
                if self.checking.on(left)? == Progress::Done {
                    self.stage = Stage::Room;
                }
            }
            Stage::Room => {
                self.check_room(language.read(tables.read(), workspace.len()))?;
                self.stage = Stage::Distinct(WORDS, 0);
                *left = left.saturating_sub(1);
            }
            Stage::Distinct(section, at) => *left = left.saturating_sub(self.distinct(section, at)?),
            Stage::Begin => {
                self.forget(&mut language.with(tables, workspace))?;
                self.begin(language);
                *left = left.saturating_sub(1);
            }
            Stage::Commit => {
                language.exchange(&mut self.unlearned);
                language.with(tables, workspace).complete(&self.checking, self.added)?;
                self.stage = Stage::Done;
                *left = left.saturating_sub(1);
            }
            Stage::Take(..) => self.take(language, tables, workspace, left),
        }
        Ok(())
    }

    /// A separate function, like the next one: the file's contents take a few hundred bytes of stack.
    #[inline(never)]
    fn check_room(&self, language: LanguageRef<'_>) -> Result<(), RestoreError> {
        language.check_room(&Contents::of(&self.checking)?)
    }

    #[inline(never)]
    fn forget(&self, language: &mut LanguageMut<'_>) -> Result<(), RestoreError> {
        language.forget_for(&Contents::of(&self.checking)?);
        Ok(())
    }

    /// Continues to check that no text occurs twice. Returns the work.
    fn distinct(&mut self, section: u8, at: u32) -> Result<u32, RestoreError> {
        let texts = self.checking.section::<&[u8]>(section);
        if at == 0 {
            self.rest = texts.bytes();
        }
        if at as usize >= texts.len() {
            self.stage = if section == WORDS { Stage::Distinct(TOKENS, 0) } else { Stage::Begin };
            return Ok(1);
        }
        let wrong = RestoreError::Inconsistent(if section == WORDS { Part::Words } else { Part::Tokens });
        let text: &[u8] = take(&mut self.rest).ok_or(wrong)?;
        if texts.iter().take(at as usize).any(|other| other == text) {
            return Err(wrong);
        }
        let next = at.saturating_add(1);
        self.stage = Stage::Distinct(section, next);
        Ok(next)
    }

    /// Begins to take records over, into empty tables.
    fn begin(&mut self, language: &LanguageState) {
        self.unlearned = Used::after(language);
        self.stage = Stage::Take(WORDS, 0);
        self.rest = self.checking.section::<&str>(WORDS).bytes();
        self.pairs = self.checking.section::<PairRecord>(PAIRS).bytes();
        self.of_session = 0;
    }

    /// Takes over some records, with about `left` units of work. They count as learned only when all are there.
    #[inline(never)]
    fn take(&mut self, language: &mut LanguageState, tables: LanguageTables<'_>, workspace: &mut [u64], left: &mut u32) {
        language.exchange(&mut self.unlearned);
        let mut model = language.with(tables, workspace);
        while let (1.., Stage::Take(section, at)) = (*left, self.stage) {
            // The file was checked, so every record can be read.
            let work = self.record(section, at, &mut model).unwrap_or(0);
            *left = left.saturating_sub((work as u32).saturating_add(1));
        }
        language.exchange(&mut self.unlearned);
    }

    /// Takes over one record; returns the number of its entries. Nothing here fails: `check_room` has found room for all records and
    /// parameters.
    fn record(&mut self, section: u8, at: u32, language: &mut LanguageMut<'_>) -> Option<usize> {
        if self.of_session > 0 {
            self.of_session = self.of_session.saturating_sub(1);
            let pair: PairRecord = take(&mut self.pairs)?;
            let _ = language.bitext.add_pair_with(pair.command, pair.weight);
            return Some(0);
        }
        if at as usize >= self.checking.count(section) {
            // The pairs between the sessions and these were taken with the sessions.
            let next = if section == SESSIONS { HEARD_AGAIN } else { section.saturating_add(1) };
            self.stage = if section == HEARD_AGAIN { Stage::Commit } else { Stage::Take(next, 0) };
            self.rest = self.checking.section::<&str>(next).bytes();
            return Some(0);
        }
        self.stage = Stage::Take(section, at.saturating_add(1));
        match section {
            WORDS | TOKENS => {
                let symbols = if section == WORDS { &mut language.words } else { language.tokens_mut() };
                let _ = symbols.intern(take(&mut self.rest)?);
                // `intern` compares a text with all earlier ones.
                Some(at as usize)
            }
            COMMANDS => {
                let record: CommandRecord = take(&mut self.rest)?;
                let _ = language.bitext.add_command(&self.added.symbols(&record));
                Some(record.len())
            }
            SESSIONS => {
                let session: SessionRecord = take(&mut self.rest)?;
                let words: Vec<Symbol, WORDS_PER_COMMAND> = listed(session.words.iter().map(|&word| Symbol(word)));
                let _ = language.bitext.add_session(&words);
                self.of_session = session.pairs;
                Some(words.len())
            }
            _ => {
                if take(&mut self.rest)? {
                    language.bitext.set_heard_again(at as u16);
                }
                Some(0)
            }
        }
    }
}
