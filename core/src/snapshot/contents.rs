//! A checked model file, to inspect without restoring it.

use super::checking::{COMMANDS, Checking, HEARD_AGAIN, PAIRS, RESTS, SESSIONS, STRATEGIES, TOKENS, TRAINERS, Tally, WORDS, options};
#[cfg(feature = "layer")]
use super::checking::{POSSIBLE, POSSIBLE_COMMANDS, POSSIBLE_COUNTS};
use super::error::{Part, RestoreError};
use super::record::{CommandRecord, HEADER_BYTES, PairRecord, RestsRecord, SessionRecord, Sizes, StrategyRecord, TrainerRecord};
use super::section::{Section, take};
use crate::capacity::Capacities;
use crate::feedback::Strategy;
use crate::language::Model;
use crate::language::ibm2::lengths::SeenLengths;
use crate::session::Options;

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
        Self::of(&checking)
    }

    /// The contents of the checked file.
    pub(super) fn of(checking: &Checking<'a>) -> Result<Self, RestoreError> {
        let wrong = RestoreError::Inconsistent(Part::Head);
        let mut rest = checking.bytes.get(HEADER_BYTES..).ok_or(wrong)?;
        let vocabulary = take(&mut rest).ok_or(wrong)?;
        let sizes = take::<Sizes>(&mut rest).ok_or(wrong)?.capacities();
        #[cfg_attr(not(feature = "layer"), expect(unused_mut, reason = "as with the feature"))]
        let mut options = options(&mut rest).ok_or(wrong)?;
        #[cfg(feature = "layer")]
        {
            options.language.layer = checking.is_layered();
        }
        Ok(Self {
            vocabulary,
            sizes,
            options,
            strategies: checking.section(STRATEGIES),
            words: checking.section(WORDS),
            tokens: checking.section(TOKENS),
            commands: checking.section(COMMANDS),
            sessions: checking.section(SESSIONS),
            pairs: checking.section(PAIRS),
            heard_again: checking.section(HEARD_AGAIN),
            trainers: checking.section(TRAINERS),
            rests: checking.section(RESTS),
            #[cfg(feature = "layer")]
            possible_commands: checking.section(POSSIBLE_COMMANDS),
            #[cfg(feature = "layer")]
            possible_counts: checking.section(POSSIBLE_COUNTS),
            #[cfg(feature = "layer")]
            possible: checking.section(POSSIBLE),
            tally: checking.tally,
        })
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

    /// Capacities for a robot that is restored from the file and goes on learning: at least `least`, and the sizes of the memory that it was
    /// saved from, but at most twice what the file holds and `least` beside it, because anyone can write any number into a file. No table gets
    /// more than `most` entries by the file's word.
    #[must_use]
    pub fn room(&self, least: Capacities, most: usize) -> Capacities {
        let needs = self.needs();
        least.at_least(self.sizes.at_most(needs.plus(needs).plus(least)).at_most(Capacities::of(|_| most)))
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
