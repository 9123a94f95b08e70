//! The language model as a whole: vocabularies, training data and parameters.

use super::bitext::{Bitext, BitextRef, Extent};
use super::forgetting::Unheard;
use super::hearing::Heard;
use super::layer::{Above, AboveRef};
#[cfg(feature = "layer")]
use super::layer::{CommandIndex, View};
use super::roles::explanation::{Explained, Explaining};
use super::roles::forward::{Reading, likelihood_on};
use super::roles::{Layout, Meaning};
use super::settings::{Model, SettingError, Settings, is_weight};
use super::spelling::variant;
use super::tables::{Tables, TablesRef, Trained, Wanted};
use super::tokenizer::{Sentence, word_form};
use super::training::Training;
use super::{ibm2, roles};
use crate::capacity::{Capacities, Capacity, CapacityError, WORDS_PER_COMMAND};
use crate::memory::AgentTables;
use crate::memory::{AgentMemory, LanguageTables, LanguageTablesRef};
use crate::planning::Progress;
use crate::probability::Scaled;
use crate::symbols::{Symbol, Symbols, SymbolsRef};

/// All of a language model that is not in its tables.
#[derive(Clone, Debug)]
pub(crate) struct LanguageState {
    settings: Settings,
    used: Used,
    trained: Trained,
    training: Training,
    learned_words: usize,
    learned_tokens: usize,
    /// Of the command heard last.
    unheard: Unheard,
}

/// The extent of the data in the tables: words, machine tokens and training data.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Used {
    words: usize,
    tokens: usize,
    data: Extent,
}

impl Used {
    /// No data.
    pub(crate) const NONE: Self = Self { words: 0, tokens: 0, data: Extent::NONE };

    /// No data, in the tables of an empty model.
    pub(crate) const fn after(language: &LanguageState) -> Self {
        Self { data: language.used.data, ..Self::NONE }
    }
}

impl LanguageState {
    /// An untrained model.
    pub(crate) const fn new(settings: Settings) -> Self {
        Self {
            settings,
            used: Used::NONE,
            trained: Trained::NONE,
            training: Training::DONE,
            learned_words: 0,
            learned_tokens: 0,
            unheard: Unheard::NONE,
        }
    }

    /// Whether a training is under way.
    pub(crate) fn is_training(&self) -> bool {
        !self.training.is_done()
    }

    /// Exchanges the extents of used data. Data written into the tables meanwhile do not count as learned.
    pub(crate) const fn exchange(&mut self, used: &mut Used) {
        core::mem::swap(&mut self.used, used);
    }

    /// The model in its tables; `counts` is memory for the expected counts.
    #[inline(always)]
    pub(crate) fn with<'t>(&'t mut self, tables: LanguageTables<'t>, counts: &'t mut [u64]) -> LanguageMut<'t> {
        LanguageMut {
            settings: &mut self.settings,
            words: Symbols::new(tables.word_bytes, tables.word_ends, &mut self.used.words, Capacity::Words, Capacity::WordBytes),
            tokens: Symbols::new(tables.token_bytes, tables.token_ends, &mut self.used.tokens, Capacity::Tokens, Capacity::TokenBytes),
            bitext: Bitext::new(tables.bitext, &mut self.used.data),
            layer: Above::new(tables.layer),
            tables: Tables::new(tables.parameters, counts, &mut self.trained),
            training: &mut self.training,
            learned_words: &mut self.learned_words,
            learned_tokens: &mut self.learned_tokens,
            unheard: &mut self.unheard,
        }
    }

    /// The same by a call, for rare steps: it takes less flash and more time.
    #[inline(never)]
    pub(crate) fn called_with<'t>(&'t mut self, tables: LanguageTables<'t>, counts: &'t mut [u64]) -> LanguageMut<'t> {
        self.with(tables, counts)
    }

    /// The model in its tables, read-only; `counts` is the number of words for the expected counts.
    pub(crate) fn read<'t>(&'t self, tables: LanguageTablesRef<'t>, counts: usize) -> LanguageRef<'t> {
        LanguageRef {
            settings: &self.settings,
            words: SymbolsRef::new(tables.word_bytes, tables.word_ends, self.used.words),
            tokens: SymbolsRef::new(tables.token_bytes, tables.token_ends, self.used.tokens),
            bitext: BitextRef::new(tables.bitext, self.used.data),
            layer: AboveRef::new(tables.layer),
            tables: TablesRef::new(tables.parameters, counts, &self.trained),
            training: self.training,
            learned_words: self.learned_words,
            learned_tokens: self.learned_tokens,
        }
    }
}

/// The language model, read-only: vocabularies, training data, and the model trained on them.
#[derive(Clone, Copy, Debug)]
pub struct LanguageRef<'t> {
    settings: &'t Settings,
    words: SymbolsRef<'t>,
    tokens: SymbolsRef<'t>,
    bitext: BitextRef<'t>,
    layer: Option<AboveRef<'t>>,
    tables: TablesRef<'t>,
    training: Training,
    learned_words: usize,
    learned_tokens: usize,
}

impl<'t> LanguageRef<'t> {
    /// The settings.
    pub const fn settings(self) -> &'t Settings {
        self.settings
    }

    /// The model.
    #[inline]
    pub(crate) const fn model(self) -> Model {
        self.settings.model.in_use()
    }

    /// The English words.
    pub const fn words(self) -> SymbolsRef<'t> {
        self.words
    }

    /// The machine tokens.
    pub const fn tokens(self) -> SymbolsRef<'t> {
        self.tokens
    }

    /// The training data.
    pub const fn bitext(self) -> BitextRef<'t> {
        self.bitext
    }

    /// The parameters of the last training.
    pub const fn tables(self) -> TablesRef<'t> {
        self.tables
    }

    /// Whether a training is under way. Until it is complete, the parameters are meaningless.
    pub fn is_training(self) -> bool {
        !self.training.is_done()
    }

    /// The training under way.
    pub const fn training(self) -> Training {
        self.training
    }

    /// Pr(e|m), times Pr(n|l) if [`Settings::length`] is set. For the role model, `command` is a [description](crate::task::description).
    pub fn likelihood(self, sentence: &[Option<Symbol>], command: &[Symbol]) -> Scaled {
        match self.model() {
            Model::Model2 => ibm2::likelihood::likelihood(self.tables, sentence, command, self.settings.length),
            Model::Roles if self.tables.words() == 0 => Scaled::ONE,
            Model::Roles => {
                let by_words = roles::forward::likelihood(self.tables.layout(), self.tables.cells(), sentence, command, |_, _| {});
                by_words.scaled_by(roles::whole::said_before(self.bitext, sentence, command))
            }
        }
    }

    /// Calls `tell` for each word of a command with its position and its probability after the previous words, if `description` is meant.
    /// It tells nothing for Model 2 and before anything is learned.
    pub fn word_by_word(self, sentence: &[Option<Symbol>], description: &[Symbol], tell: impl FnMut(usize, f32)) {
        match self.model() {
            Model::Model2 => {}
            Model::Roles => drop(roles::forward::likelihood(self.tables.layout(), self.tables.cells(), sentence, description, tell)),
        }
    }

    /// Weighs the kinds of task, for the role model: see [`roles::kind`]. `weights` are pi_t Pr(e|t) of each task, `form` returns the token
    /// of its lifted task and `prior` its pi_t. For Model 2 the weights stay.
    pub fn weigh_kinds(
        self,
        sentence: &[Option<Symbol>],
        form: impl Fn(usize) -> Symbol,
        prior: impl Fn(usize) -> f32,
        weights: &mut [Scaled],
    ) {
        match self.model() {
            Model::Model2 => {}
            Model::Roles => {
                roles::kind::weigh(self.tables, sentence, form, weights);
                roles::kind::dilute(self.tables, sentence, prior, weights);
            }
        }
    }

    /// Replaces the role model's weights of tasks by those of the [layer](super::layer), after [`weigh_kinds`](Self::weigh_kinds). `same`
    /// returns the first task with the same description, and `description` the description of that task.
    #[cfg(feature = "layer")]
    pub fn weigh_parts<'d>(
        self,
        sentence: &[Option<Symbol>],
        same: impl Fn(usize) -> usize,
        description: impl Fn(usize) -> &'d [Symbol],
        weights: &mut [Scaled],
    ) {
        if let Some(AboveRef { layer, possible }) = self.layer.filter(|_| self.settings.has_layer()) {
            let view = View { tables: self.tables, bitext: self.bitext, possible };
            layer.weigh(view, sentence, &same, &description, weights);
        }
    }

    /// The tasks of each session, for the [layer](super::layer), if there is memory for it: each pair's weight is the prior of the task.
    pub fn possible(self) -> Option<BitextRef<'t>> {
        self.layer.map(AboveRef::possible)
    }

    /// As [`TablesRef::unknown_share`].
    pub fn unknown_share(self, sentence: &[Option<Symbol>]) -> f32 {
        self.tables.unknown_share(sentence)
    }

    /// The size of each table.
    pub(crate) fn rooms(self) -> Capacities {
        let mut rooms = Capacities::NONE;
        (rooms.words, rooms.word_bytes) = self.words.room();
        (rooms.tokens, rooms.token_bytes) = self.tokens.room();
        self.bitext.room(&mut rooms);
        self.tables.room(&mut rooms);
        rooms
    }

    /// The used part of each table.
    pub(crate) fn usage(self, used: &mut Capacities) {
        (used.words, used.word_bytes) = (self.words.len(), self.words.byte_len());
        (used.tokens, used.token_bytes) = (self.tokens.len(), self.tokens.byte_len());
        self.bitext.usage(used);
        self.tables.usage(used);
    }

    /// The number of machine tokens, and their bytes.
    pub(crate) fn usage_of_tokens(self) -> (usize, usize) {
        (self.tokens.len(), self.tokens.byte_len())
    }

    /// Whether a word, as [`for_each_piece`](super::for_each_piece) passes it, counts as a learned one.
    pub fn knows(self, word: &str) -> bool {
        self.known_as(word).is_some()
    }

    /// The learned word that a word counts as, for example "take" for "takes", or "grandma" for "grandpa".
    pub fn known_as(self, word: &str) -> Option<&'t str> {
        let known = self.word_like(word, self.learned_words).filter(|known| known.index() < self.learned_words)?;
        Some(self.words.text(known))
    }

    /// The word here that `word` counts as. Only the first `learned` words can be meant by a slip.
    pub(crate) fn word_like(self, word: &str, learned: usize) -> Option<Symbol> {
        let letters = usize::from(self.settings.word_letters);
        match self.model() {
            Model::Model2 => self.words.find(word_form(word, letters)),
            Model::Roles => variant(self.words, learned, word, letters),
        }
    }

    /// The number of English words in the learned sessions.
    pub(crate) const fn learned_words(self) -> usize {
        self.learned_words
    }

    /// The number of machine tokens in the learned sessions.
    pub(crate) const fn learned_tokens(self) -> usize {
        self.learned_tokens
    }

    /// The reason why a heard word is not in the vocabulary.
    pub(super) fn no_room_for_a_word(self) -> CapacityError {
        let (words, bytes) = self.words.room();
        if self.words.len() < words { CapacityError::full(Capacity::WordBytes, bytes) } else { CapacityError::full(Capacity::Words, words) }
    }
}

/// The language model, for one call that changes it.
#[derive(Debug)]
#[doc(hidden)]
pub struct LanguageMut<'t> {
    settings: &'t mut Settings,
    pub(crate) words: Symbols<'t>,
    pub(super) tokens: Symbols<'t>,
    pub(crate) bitext: Bitext<'t>,
    pub(super) layer: Above<'t>,
    pub(super) tables: Tables<'t>,
    pub(crate) training: &'t mut Training,
    learned_words: &'t mut usize,
    learned_tokens: &'t mut usize,
    pub(super) unheard: &'t mut Unheard,
}

impl<'t> LanguageMut<'t> {
    /// The model, read-only.
    pub const fn read(&self) -> LanguageRef<'_> {
        LanguageRef {
            settings: self.settings,
            words: self.words.read(),
            tokens: self.tokens.read(),
            bitext: self.bitext.read(),
            layer: self.layer.read(),
            tables: self.tables.read(),
            training: *self.training,
            learned_words: *self.learned_words,
            learned_tokens: *self.learned_tokens,
        }
    }

    /// The settings.
    pub(super) const fn settings(&self) -> &Settings {
        self.settings
    }

    /// The number of English words in the learned sessions.
    pub(super) const fn learned_words(&self) -> usize {
        *self.learned_words
    }

    /// The machine tokens, to intern those of a new session's tasks. They stay if the session is learned from.
    pub fn tokens_mut(&mut self) -> &mut Symbols<'t> {
        &mut self.tokens
    }

    /// Forgets the words and machine tokens that came after the last learned session.
    pub fn forget_unlearned(&mut self) {
        self.words.truncate(*self.learned_words);
        self.tokens.truncate(*self.learned_tokens);
    }

    /// The words of a command; new ones are interned. If the vocabulary is full, a new word is `None`: it is no evidence, and is left out
    /// when the command is learned from.
    ///
    /// # Errors
    /// A [`CapacityError`] if the command or one of its words is too long.
    pub fn hear(&mut self, command: &str) -> Result<Sentence, CapacityError> {
        let mut sentence = Sentence::new();
        self.hear_into(command, &mut sentence)?;
        Ok(sentence)
    }

    /// Like [`hear`](Self::hear), into an existing sentence: one is large for a controller's stack.
    ///
    /// # Errors
    /// As [`hear`](Self::hear).
    pub fn hear_into(&mut self, command: &str, sentence: &mut Sentence) -> Result<(), CapacityError> {
        sentence.clear();
        *self.unheard = Unheard::NONE;
        if self.model() == Model::Roles {
            return self.hear_on(command, &mut { Heard::START }, sentence, &mut { u32::MAX }).map(|_| ());
        }
        let (model, learned) = (self.model(), *self.learned_words);
        let take = |word: &str| {
            let symbol = self.take_word(word, learned).ok();
            if symbol.is_none() {
                self.note_unheard(word);
            }
            sentence.push(symbol).map_err(|_| CapacityError::full(Capacity::WordsPerCommand, WORDS_PER_COMMAND))
        };
        model.for_each_word(command, take)
    }

    /// Adds one session to the training data: its English command with each of `pairs`, a machine command and its weight. A weight that is
    /// not a number from 0 to 1,000,000 counts as 0. A training must follow: [`begin_training`](Self::begin_training).
    ///
    /// # Errors
    /// A [`CapacityError`]; the model is then unchanged.
    pub fn add_session<'a>(
        &mut self,
        sentence: &[Option<Symbol>],
        pairs: impl Iterator<Item = (&'a [Symbol], f32)>,
    ) -> Result<(), CapacityError> {
        let (extent, wanted) = (self.bitext.extent(), self.tables.trained.wanted);
        let result = self.try_add_session(sentence, pairs);
        match result {
            Ok(()) => {
                *self.learned_words = self.words.len();
                *self.learned_tokens = self.tokens.len();
            }
            Err(_) => {
                self.bitext.rewind(extent);
                self.tables.trained.wanted = wanted;
            }
        }
        result
    }

    /// Gives the [layer](super::layer) all possible tasks of the last session, each description once, with the prior of each. Without this
    /// the layer learns nothing from the session. It does nothing if the layer is off, or has no memory.
    ///
    /// # Errors
    /// A [`CapacityError`] if the layer's tables are full, or those of machine tokens; it then learns nothing from the session.
    #[cfg(feature = "layer")]
    pub fn add_possible<'a>(&mut self, tasks: impl Iterator<Item = (&'a [Symbol], f32)>) -> Result<(), CapacityError> {
        let is_on = self.settings.has_layer();
        let Some(possible) = self.layer.possible_mut().filter(|_| is_on) else { return Ok(()) };
        while possible.sessions() < self.bitext.sessions() {
            possible.add_session(&[])?;
        }
        let extent = possible.extent();
        let mut known = CommandIndex::of(possible.read());
        let mut added = self.tables.fits_rows(self.tokens.len(), self.words.len());
        for (description, prior) in tasks {
            let weight = if is_weight(prior) { prior } else { 0.0 };
            added = added.and_then(|()| known.add_pair(possible, description, weight));
        }
        match added {
            // A task that was not meant may have tokens that are in no pair.
            Ok(()) => *self.learned_tokens = self.tokens.len(),
            Err(_) => possible.rewind(extent),
        }
        added
    }

    /// Forgets the tasks of all sessions: another model may have used the layer's memory before.
    pub(crate) fn forget_tasks(&mut self) {
        self.layer.clear();
    }

    /// Forgets a session and its pairs. Later ones move up by one.
    pub(crate) fn remove_session(&mut self, session: u16) {
        self.begin_removal(session);
        self.complete_removal();
    }

    /// Begins to forget a session and its pairs; the training data are forgotten in parts.
    pub(super) fn begin_removal(&mut self, session: u16) {
        self.bitext.begin_removal(session);
        if let Some(possible) = self.layer.possible_mut() {
            possible.remove_session(session);
        }
    }

    /// Completes a removal, if one has begun.
    pub(crate) fn complete_removal(&mut self) {
        while !self.bitext.remove_on() {}
    }

    pub(crate) fn possible_mut(&mut self) -> Option<&mut Bitext<'t>> {
        self.layer.possible_mut()
    }

    /// Forgets everything, and takes other settings.
    pub(crate) fn clear(&mut self, settings: Settings) {
        *self.settings = settings;
        self.words.truncate(0);
        self.tokens.truncate(0);
        self.bitext.clear();
        self.layer.clear();
        (*self.learned_words, *self.learned_tokens) = (0, 0);
        self.tables.trained.wanted = Wanted::NONE;
    }

    /// Replaces everything by a role model from another robot: its words, its machine tokens and its parameters. There are no training data
    /// with them.
    pub(crate) fn take_over<'a>(
        &mut self,
        settings: Settings,
        (words, tokens): (impl Iterator<Item = &'a str>, impl Iterator<Item = &'a str>),
        layout: Layout,
        cells: impl Iterator<Item = f32>,
    ) {
        self.clear(settings);
        // The room for all was checked.
        for word in words {
            let _ = self.words.intern(word);
        }
        for token in tokens {
            let _ = self.tokens.intern(token);
        }
        (*self.learned_words, *self.learned_tokens) = (self.words.len(), self.tokens.len());
        self.tables.take_over(layout, cells);
        *self.training = Training::DONE;
    }

    /// The symbol of a word: that of the word here that it counts as, or a new one. Only the first `learned` words can be meant by a slip.
    pub(crate) fn take_word(&mut self, word: &str, learned: usize) -> Result<Symbol, CapacityError> {
        match self.read().word_like(word, learned) {
            Some(known) => Ok(known),
            None => self.words.intern(word_form(word, self.settings.letters_kept())),
        }
    }

    /// Notes a word that found no room.
    pub(super) fn note_unheard(&mut self, word: &str) {
        let bytes = word_form(word, self.settings.letters_kept()).len();
        self.unheard.note(bytes);
    }

    /// Adapts to new training data: all their words and tokens count as learned, and there is a table for each of their pairs of lengths. A
    /// training must follow.
    ///
    /// # Errors
    /// A [`CapacityError`] if the tables have no room.
    pub(crate) fn data_replaced(&mut self) -> Result<(), CapacityError> {
        (*self.learned_words, *self.learned_tokens) = (self.words.len(), self.tokens.len());
        self.tables.fits_rows(self.tokens.len(), self.words.len())?;
        self.rebuild_wanted()?;
        match self.model() {
            Model::Model2 => Ok(()),
            Model::Roles => self.tables.fits(&self.tables.trained.wanted.layout),
        }
    }

    /// Determines anew which parameters the data need. A training must follow.
    ///
    /// # Errors
    /// A [`CapacityError`] if Model 2's tables have no room. The role model's are not checked: a session may still give way for them.
    pub(super) fn rebuild_wanted(&mut self) -> Result<(), CapacityError> {
        self.tables.trained.wanted = Wanted::NONE;
        match self.model() {
            Model::Model2 => ibm2::data::rebuild(&mut self.tables, self.bitext.read()),
            Model::Roles => {
                self.tables.trained.wanted.layout = self.layout_of_data();
                Ok(())
            }
        }
    }

    /// The layout of the role model's parameters for all training data.
    fn layout_of_data(&self) -> Layout {
        Layout::of(self.bitext.read(), self.words.len(), self.tokens.len())
    }

    /// Checks that the tables have room for the parameters of all data.
    pub(super) fn parameters_fit(&self) -> Result<(), CapacityError> {
        match self.model() {
            Model::Model2 => self.tables.fits_rows(self.tokens.len(), self.words.len()),
            Model::Roles => self.tables.fits(&self.layout_of_data()),
        }
    }

    /// Reserves the parameters for one more machine command of a command of this many words.
    ///
    /// # Errors
    /// A [`CapacityError`] if the tables have no room.
    fn want(&mut self, command: &[Symbol], words: usize) -> Result<(), CapacityError> {
        match self.model() {
            Model::Model2 => self.tables.add_lengths(command.len(), words),
            Model::Roles => self.tables.add_description(command, words, self.words.len(), self.tokens.len()),
        }
    }

    /// Continues the role model's Pr(e|t), with at most about `left` table cells of work and at least one word. Returns whether all words
    /// are read. Between calls its state is stored after the parameters in the tables.
    pub(crate) fn likelihood_on(
        &mut self,
        sentence: &[Option<Symbol>],
        description: &[Symbol],
        reading: &mut Reading,
        left: &mut u32,
    ) -> bool {
        let layout = &self.tables.trained.layout;
        if layout.words() == 0 {
            return true;
        }
        let cells_of_word = description.len().saturating_mul(4).max(1) as u32;
        let most = left.div_ceil(cells_of_word).max(1) as usize;
        let before = reading.words;
        let memory = &mut self.tables.memory;
        let done = likelihood_on(layout, memory.translations, memory.alignments, sentence, description, reading, most);
        *left = left.saturating_sub(u32::from(reading.words.saturating_sub(before)).max(1).saturating_mul(cells_of_word));
        if done {
            reading.probability = reading.probability.scaled_by(roles::whole::said_before(self.bitext.read(), sentence, description));
        }
        done
    }

    /// The model.
    #[inline]
    pub(crate) const fn model(&self) -> Model {
        self.settings.model.in_use()
    }

    /// Continues to read a command for [`explain_word`](Self::explain_word), if `description` is meant, with at most about `budget` table
    /// cells of work. Between calls its state is stored after the parameters in the tables, where the next command is heard, too.
    ///
    /// # Errors
    /// A [`CapacityError`] if the command is too long for the room after the parameters in the tables.
    pub(crate) fn explain_on(
        &mut self,
        sentence: &[Option<Symbol>],
        description: &[Symbol],
        budget: u32,
    ) -> Result<Progress, CapacityError> {
        let layout = self.tables.trained.layout;
        let mut wanted = layout;
        wanted.see_length(sentence.len().min(WORDS_PER_COMMAND));
        self.tables.fits(&wanted)?;
        let words = roles::explanation::heard(&layout, sentence);
        let Some(explained) = self.training.explained() else { return Ok(Progress::Done) };
        let memory = &mut self.tables.memory;
        let Some((parameters, trellis)) = memory.alignments.split_at_mut_checked(layout.trellis_start()) else { return Ok(Progress::Done) };
        let command = Explaining { layout: &layout, translations: memory.translations, parameters, sentence: &words, description };
        command.read_on(explained, trellis, budget.max(1) as usize);
        Ok(if matches!(explained, Explained::Reading(..)) { Progress::Working } else { Progress::Done })
    }

    /// Calls `tell` with each meaning that a word of a command may have if `description` is meant, and its probability. Returns
    /// false, and tells nothing, until [`explain_on`](Self::explain_on) is done.
    pub(crate) fn explain_word(
        &mut self,
        sentence: &[Option<Symbol>],
        description: &[Symbol],
        position: usize,
        tell: impl FnMut(Meaning, f32),
    ) -> bool {
        let layout = self.tables.trained.layout;
        let words = roles::explanation::heard(&layout, sentence);
        let explained = self.training.explained();
        let Some((parameters, trellis)) = self.tables.memory.alignments.split_at_checked(layout.trellis_start()) else { return true };
        match explained {
            None | Some(Explained::Reading(..)) => return false,
            Some(Explained::Impossible) => return true,
            Some(Explained::Read) => {}
        }
        let translations = &*self.tables.memory.translations;
        let command = Explaining { layout: &layout, translations, parameters, sentence: &words, description };
        command.tell(trellis, position, tell);
        true
    }

    fn try_add_session<'a>(
        &mut self,
        sentence: &[Option<Symbol>],
        pairs: impl Iterator<Item = (&'a [Symbol], f32)>,
    ) -> Result<(), CapacityError> {
        let mut words: heapless::Vec<Symbol, WORDS_PER_COMMAND> = heapless::Vec::new();
        for &word in sentence {
            let word = word.ok_or(self.read().no_room_for_a_word())?;
            words.push(word).map_err(|_| CapacityError::new(Capacity::WordsPerCommand, WORDS_PER_COMMAND, sentence.len()))?;
        }
        self.tables.fits_rows(self.tokens.len(), self.words.len())?;
        if self.model() == Model::Roles {
            // Its words need room even if no machine command is left for them.
            self.want(&[], words.len())?;
        }
        self.bitext.add_session(&words)?;
        for (command, weight) in pairs {
            self.bitext.add_pair(command, if is_weight(weight) { weight } else { 0.0 })?;
            self.want(command, words.len())?;
        }
        Ok(())
    }

    /// Begins training on all the data, from scratch.
    pub fn begin_training(&mut self) {
        let (words, tokens) = (*self.learned_words, *self.learned_tokens);
        *self.training = Training::begin(&mut self.tables, self.bitext.read(), &mut self.layer, words, tokens, self.settings);
    }

    /// Continues the training, with at most about `budget` table cells of work.
    pub fn train(&mut self, budget: u32) -> Progress {
        self.training.advance(&mut self.tables, self.bitext.read(), &mut self.layer, self.settings, budget)
    }
}

/// A language model by itself, in memory that it owns or borrows. An [`Agent`](crate::Agent) has one of its own.
#[derive(Debug)]
pub struct LanguageModel<M> {
    memory: M,
    state: LanguageState,
}

impl<M: AgentMemory> LanguageModel<M> {
    /// An untrained model.
    ///
    /// # Errors
    /// A [`SettingError`] if a setting is out of range.
    pub fn new(memory: M, settings: Settings) -> Result<Self, SettingError> {
        settings.check()?;
        let mut model = Self { memory, state: LanguageState::new(settings) };
        model.lend().forget_tasks();
        Ok(model)
    }

    /// The model for one call that changes it.
    pub fn lend(&mut self) -> LanguageMut<'_> {
        let tables = self.memory.lend();
        self.state.with(tables.language, tables.workspace)
    }

    /// The model and its tables.
    pub(crate) fn parts(&mut self) -> (&mut LanguageState, AgentTables<'_>) {
        (&mut self.state, self.memory.lend())
    }

    /// The model, read-only.
    pub fn read(&self) -> LanguageRef<'_> {
        let tables = self.memory.read();
        self.state.read(tables.language, tables.workspace.len())
    }

    /// Returns the memory, for other use.
    pub fn into_memory(self) -> M {
        self.memory
    }
}
