//! Saving and restoring the language model.

use super::contents::{Contents, symbols};
use super::error::{Part, RestoreError, SaveError};
use super::record::Sizes;
use super::writing::Writing;
use crate::capacity::{Capacities, WORDS_PER_COMMAND};
#[cfg(feature = "layer")]
use crate::language::Settings;
use crate::language::{LanguageModel, LanguageMut, LanguageRef};
use crate::memory::AgentMemory;
use crate::session::Options;
use crate::symbols::Symbol;
#[cfg(feature = "alloc")]
use alloc::{vec, vec::Vec};

impl<M: AgentMemory> LanguageModel<M> {
    /// Saves the training data and the settings to the front of the buffer, as a model file of no domain. Returns its length.
    ///
    /// # Errors
    /// [`SaveError`]; the buffer may then hold anything.
    pub fn save(&self, buffer: &mut [u8]) -> Result<usize, SaveError> {
        self.read().save(buffer)
    }

    /// A model file on the heap, with what [`save`](Self::save) writes.
    ///
    /// # Errors
    /// [`SaveError`], as for [`save`](Self::save).
    #[cfg(feature = "alloc")]
    pub fn saved(&self) -> Result<Vec<u8>, SaveError> {
        let mut file = vec![0; self.read().writing().bytes()?];
        let length = self.save(&mut file)?;
        file.truncate(length);
        Ok(file)
    }

    /// Takes the training data and the settings of a model file, in place of its own, and begins training: call
    /// [`train`](LanguageMut::train) until it is done.
    ///
    /// # Errors
    /// [`RestoreError`]; the model is then as before.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), RestoreError> {
        let contents = Contents::read(bytes)?;
        self.read().check_room(&contents)?;
        self.lend().take_over(&contents);
        Ok(())
    }

    /// Adds the sessions of a model file after its own, and begins training. See [`Agent::join`](crate::Agent::join).
    ///
    /// # Errors
    /// [`RestoreError`]; the training data are then as before.
    pub fn join(&mut self, bytes: &[u8]) -> Result<usize, RestoreError> {
        let contents = Contents::read(bytes)?;
        self.read().check_forms(&contents)?;
        Ok(self.lend().join_contents(&contents)?)
    }
}

impl<'t> LanguageRef<'t> {
    /// Saves the training data and the settings, as [`LanguageModel::save`] does.
    ///
    /// # Errors
    /// [`SaveError`]; the buffer may then hold anything.
    pub fn save(self, buffer: &mut [u8]) -> Result<usize, SaveError> {
        self.writing().write(buffer)
    }

    fn writing(self) -> Writing<'t> {
        let options = Options { language: *self.settings(), ..Options::PAPER };
        Writing { vocabulary: 0, options, language: self, strategies: None, sizes: self.sizes(0) }
    }

    /// How large the tables are that a model file tells of.
    pub(super) fn sizes(self, strategies: usize) -> Sizes {
        Sizes::new(&Capacities { strategies, ..self.rooms() })
    }

    /// Whether the tasks of a model's sessions fit here, where there is any room for such.
    #[cfg(feature = "layer")]
    fn check_room_for_possible(self, contents: &Contents<'_>) -> Result<(), RestoreError> {
        let mut rooms = Capacities::NONE;
        let Some(possible) = self.possible() else { return Ok(()) };
        possible.room(&mut rooms);
        let commands = contents.possible_commands;
        let needs = Capacities {
            commands: commands.len(),
            command_tokens: commands.iter().map(|command| command.len()).sum(),
            sessions: contents.possible_counts.len(),
            pairs: contents.possible.len(),
            ..Capacities::NONE
        };
        Ok(needs.fits_in(&rooms)?)
    }

    /// Checks that a model's training data fit here, and that no word or token occurs twice.
    pub(super) fn check_room(self, contents: &Contents<'_>) -> Result<(), RestoreError> {
        Capacities { strategies: 0, ..contents.needs() }.fits_in(&self.rooms())?;
        #[cfg(feature = "layer")]
        self.check_room_for_possible(contents)?;
        let distinct = |texts: super::contents::Section<'_, &str>| {
            texts.iter().enumerate().all(|(position, text)| texts.iter().take(position).all(|other| other != text))
        };
        if !distinct(contents.words) {
            return Err(RestoreError::Inconsistent(Part::Words));
        }
        if !distinct(contents.tokens) {
            return Err(RestoreError::Inconsistent(Part::Tokens));
        }
        Ok(())
    }
}

impl LanguageMut<'_> {
    /// Takes over the tasks of all sessions, where there is room for them: memory without any is that of a layer that is silent.
    #[cfg(feature = "layer")]
    fn take_over_possible(&mut self, contents: &Contents<'_>) {
        let Some(possible) = self.possible_mut() else { return };
        for record in contents.possible_commands.iter() {
            let _ = possible.add_command(&symbols(&record));
        }
        let mut pairs = contents.possible.iter();
        for count in contents.possible_counts.iter() {
            let _ = possible.add_session(&[]);
            for pair in pairs.by_ref().take(count as usize) {
                let _ = possible.add_pair_with(pair.command, pair.weight);
            }
        }
    }

    /// Takes the training data over, which were found to fit, and begins training.
    pub(super) fn take_over(&mut self, contents: &Contents<'_>) {
        let settings = contents.options.language;
        #[cfg(feature = "layer")]
        let settings = Settings { layer: settings.layer && self.possible_mut().is_some(), ..settings };
        self.clear(settings);
        // Nothing here fails: `check_room` counted the entries of each table, and the parameters by the model that has them.
        for word in contents.words.iter() {
            let _ = self.words_mut().intern(word);
        }
        for token in contents.tokens.iter() {
            let _ = self.tokens_mut().intern(token);
        }
        for record in contents.commands.iter() {
            let _ = self.bitext_mut().add_command(&symbols(&record));
        }
        let mut pairs = contents.pairs.iter();
        for session in contents.sessions.iter() {
            let mut words: heapless::Vec<Symbol, WORDS_PER_COMMAND> = heapless::Vec::new();
            for &word in session.words.iter() {
                let _ = words.push(Symbol(word));
            }
            let _ = self.bitext_mut().add_session(&words);
            for pair in pairs.by_ref().take(session.pairs as usize) {
                let _ = self.bitext_mut().add_pair_with(pair.command, pair.weight);
            }
        }
        for (session, _) in contents.heard_again.iter().enumerate().filter(|&(_, again)| again) {
            self.bitext_mut().set_heard_again(session as u16);
        }
        #[cfg(feature = "layer")]
        self.take_over_possible(contents);
        let _ = self.data_replaced();
        self.begin_training();
    }
}
