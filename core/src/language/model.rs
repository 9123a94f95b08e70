//! The language model as a whole: vocabularies, training data and parameters.

use super::bitext::{Bitext, BitextMemory, Extent};
use super::em::Training;
use super::likelihood::{length_likelihood, likelihood};
use super::settings::{SettingError, Settings};
use super::tables::{TableMemory, Tables};
use super::tokenizer::{Sentence, for_each_word, word_form};
use crate::capacity::{Capacities, Capacity, CapacityError, WORDS_PER_COMMAND};
use crate::planning::Progress;
use crate::probability::Scaled;
use crate::symbols::{Symbol, Symbols};

/// Memory for a [`LanguageModel`].
#[derive(Debug)]
pub struct LanguageMemory<'m> {
    /// The English words end to end.
    pub word_bytes: &'m mut [u8],
    /// One entry an English word.
    pub word_ends: &'m mut [u16],
    /// The machine tokens end to end.
    pub token_bytes: &'m mut [u8],
    /// One entry a machine token.
    pub token_ends: &'m mut [u16],
    /// The training data.
    pub bitext: BitextMemory<'m>,
    /// The parameters.
    pub tables: TableMemory<'m>,
}

/// The language model: what was said and what it meant, and IBM Model 2 trained on that.
#[derive(Debug)]
pub struct LanguageModel<'m> {
    settings: Settings,
    pub(super) words: Symbols<'m>,
    pub(super) tokens: Symbols<'m>,
    pub(super) bitext: Bitext<'m>,
    pub(super) tables: Tables<'m>,
    training: Training,
    learned_words: usize,
    learned_tokens: usize,
}

impl<'m> LanguageModel<'m> {
    /// An untrained model.
    ///
    /// # Errors
    /// A [`SettingError`] where a setting is none to train with.
    pub fn new(memory: LanguageMemory<'m>, settings: Settings) -> Result<Self, SettingError> {
        settings.check()?;
        Ok(Self {
            settings,
            words: Symbols::new(memory.word_bytes, memory.word_ends, Capacity::Words, Capacity::WordBytes),
            tokens: Symbols::new(memory.token_bytes, memory.token_ends, Capacity::Tokens, Capacity::TokenBytes),
            bitext: Bitext::new(memory.bitext),
            tables: Tables::new(memory.tables),
            training: Training::default(),
            learned_words: 0,
            learned_tokens: 0,
        })
    }

    /// How it is trained.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The English words.
    pub fn words(&self) -> &Symbols<'m> {
        &self.words
    }

    /// The machine tokens.
    pub fn tokens(&self) -> &Symbols<'m> {
        &self.tokens
    }

    /// The machine tokens, to intern those of a new session's tasks in. They stay when the session is learned from.
    pub fn tokens_mut(&mut self) -> &mut Symbols<'m> {
        &mut self.tokens
    }

    /// The training data.
    pub fn bitext(&self) -> &Bitext<'m> {
        &self.bitext
    }

    /// The parameters of the last training.
    pub fn tables(&self) -> &Tables<'m> {
        &self.tables
    }

    /// Whether a training is under way. Until it is done, the parameters say nothing.
    pub fn is_training(&self) -> bool {
        !self.training.is_done()
    }

    /// The training under way.
    pub fn training(&self) -> &Training {
        &self.training
    }

    /// Forgets the words and machine tokens that came since the last session that was learned from.
    pub fn forget_unlearned(&mut self) {
        self.words.truncate(self.learned_words);
        self.tokens.truncate(self.learned_tokens);
    }

    /// The words of a command, new ones interned. Where the vocabulary is full, a new word is `None`: it says nothing, and is left out when
    /// the command is learned from.
    ///
    /// # Errors
    /// A [`CapacityError`] where the command or one of its words is too long.
    pub fn hear(&mut self, command: &str) -> Result<Sentence, CapacityError> {
        let mut sentence = Sentence::new();
        self.hear_into(command, &mut sentence)?;
        Ok(sentence)
    }

    /// Like [`hear`](Self::hear), into a sentence that is there already: it is large for a controller's stack.
    ///
    /// # Errors
    /// As [`hear`](Self::hear).
    pub fn hear_into(&mut self, command: &str, sentence: &mut Sentence) -> Result<(), CapacityError> {
        sentence.clear();
        let words = &mut self.words;
        let letters = usize::from(self.settings.word_letters);
        for_each_word(command, |word| {
            let word = word_form(word, letters);
            let full = CapacityError::full(Capacity::WordsPerCommand, WORDS_PER_COMMAND);
            sentence.push(words.intern(word).ok()).map_err(|_| full)
        })
    }

    /// Pr(e|m), times Pr(n|l) where [`Settings::length`] says so.
    pub fn likelihood(&self, sentence: &[Option<Symbol>], command: &[Symbol]) -> Scaled {
        let words = likelihood(&self.tables, sentence, command);
        if self.settings.length { words.scaled_by(length_likelihood(&self.tables, command.len(), sentence.len())) } else { words }
    }

    /// Adds one session to the training data: its English command with each of `pairs`, a machine command and its weight. A training must
    /// follow: [`begin_training`](Self::begin_training).
    ///
    /// # Errors
    /// A [`CapacityError`]; the model is then as before.
    pub fn add_session<'a>(
        &mut self,
        sentence: &[Option<Symbol>],
        pairs: impl Iterator<Item = (&'a [Symbol], f32)>,
    ) -> Result<(), CapacityError> {
        let (extent, length_pairs) = (self.bitext.extent(), self.tables.length_pairs);
        let result = self.try_add_session(sentence, pairs);
        match result {
            Ok(()) => {
                self.learned_words = self.words.len();
                self.learned_tokens = self.tokens.len();
            }
            Err(_) => {
                self.bitext.rewind(extent);
                self.tables.length_pairs = length_pairs;
            }
        }
        result
    }

    /// How much each table holds.
    pub(crate) fn rooms(&self) -> Capacities {
        let mut rooms = Capacities { ..Capacities::SMALL };
        (rooms.words, rooms.word_bytes) = self.words.room();
        (rooms.tokens, rooms.token_bytes) = self.tokens.room();
        self.bitext.room(&mut rooms);
        self.tables.room(&mut rooms);
        rooms
    }

    /// The English words of the sessions that were learned from.
    pub(crate) fn learned_words(&self) -> impl Iterator<Item = &str> {
        (0..self.learned_words).map(|position| self.words.text(Symbol(position as u16)))
    }

    /// The machine tokens of those sessions.
    pub(crate) fn learned_tokens(&self) -> impl Iterator<Item = &str> {
        (0..self.learned_tokens).map(|position| self.tokens.text(Symbol(position as u16)))
    }

    /// Forgets everything, and takes other settings.
    pub(crate) fn clear(&mut self, settings: Settings) {
        self.settings = settings;
        self.words.truncate(0);
        self.tokens.truncate(0);
        self.bitext.rewind(Extent::default());
        (self.learned_words, self.learned_tokens) = (0, 0);
    }

    pub(crate) fn words_mut(&mut self) -> &mut Symbols<'m> {
        &mut self.words
    }

    pub(crate) fn bitext_mut(&mut self) -> &mut Bitext<'m> {
        &mut self.bitext
    }

    /// Takes note that the training data are others now: all their words and tokens are learned ones, and there is a table for each of
    /// their pairs of lengths. A training must follow.
    ///
    /// # Errors
    /// A [`CapacityError`] where the tables have no room.
    pub(crate) fn data_replaced(&mut self) -> Result<(), CapacityError> {
        (self.learned_words, self.learned_tokens) = (self.words.len(), self.tokens.len());
        self.tables.fits(self.tokens.len(), self.words.len())?;
        self.rebuild_lengths()
    }

    /// Lays the alignment tables out anew for the pairs of lengths that the data have now. A training must follow.
    pub(super) fn rebuild_lengths(&mut self) -> Result<(), CapacityError> {
        self.tables.length_pairs = 0;
        for pair in self.bitext.pairs() {
            self.tables.add_lengths(self.bitext.command(pair.command).len(), self.bitext.sentence(pair.session).len())?;
        }
        Ok(())
    }

    fn try_add_session<'a>(
        &mut self,
        sentence: &[Option<Symbol>],
        pairs: impl Iterator<Item = (&'a [Symbol], f32)>,
    ) -> Result<(), CapacityError> {
        let mut words: heapless::Vec<Symbol, WORDS_PER_COMMAND> = heapless::Vec::new();
        for &word in sentence {
            let word = word.ok_or(self.no_room_for_a_word())?;
            words.push(word).map_err(|_| CapacityError::new(Capacity::WordsPerCommand, WORDS_PER_COMMAND, sentence.len()))?;
        }
        self.tables.fits(self.tokens.len(), self.words.len())?;
        self.bitext.add_session(&words)?;
        for (command, weight) in pairs {
            self.bitext.add_pair(command, weight)?;
            self.tables.add_lengths(command.len(), words.len())?;
        }
        Ok(())
    }

    /// Why a word that was heard is not in the vocabulary.
    pub(super) fn no_room_for_a_word(&self) -> CapacityError {
        let (words, bytes) = self.words.room();
        if self.words.len() < words { CapacityError::full(Capacity::WordBytes, bytes) } else { CapacityError::full(Capacity::Words, words) }
    }

    /// Begins training on all the data, from uniform parameters.
    pub fn begin_training(&mut self) {
        self.training = Training::begin(&mut self.tables, &self.bitext, self.learned_words, self.learned_tokens, &self.settings);
    }

    /// Gives the words of the expected counts away. Training needs them back: see [`take_workspace`](Self::take_workspace).
    pub(crate) fn lend_workspace(&mut self) -> &'m mut [u64] {
        self.tables.lend_counts()
    }

    /// Takes the words of the expected counts back.
    pub(crate) fn take_workspace(&mut self, words: &'m mut [u64]) {
        self.tables.take_counts(words);
    }

    /// Goes on with the training, with at most about `budget` table cells of work.
    pub fn train(&mut self, budget: u32) -> Progress {
        self.training.advance(&mut self.tables, &self.bitext, &self.settings, budget)
    }
}
