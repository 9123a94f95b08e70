//! Saving and restoring the language model.

use super::checking::Checking;
use super::contents::Contents;
use super::error::{RestoreError, SaveError};
use super::restoring::{AddedAttributes, Restoring, Stage};
use super::saving::Model;
use crate::capacity::Capacities;
#[cfg(feature = "layer")]
use crate::language::Settings;
use crate::language::{LanguageModel, LanguageMut, LanguageRef};
use crate::memory::AgentMemory;
use crate::session::Options;
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

    /// A model file on the heap, with the bytes that [`save`](Self::save) writes.
    ///
    /// # Errors
    /// [`SaveError`], as for [`save`](Self::save).
    #[cfg(feature = "alloc")]
    pub fn saved(&self) -> Result<Vec<u8>, SaveError> {
        let mut file = vec![0; self.read().saving(|model| model.bytes())?];
        let length = self.save(&mut file)?;
        file.truncate(length);
        Ok(file)
    }

    /// Replaces the training data and the settings by those of a model file, and begins training: call [`train`](LanguageMut::train) until
    /// it is done.
    ///
    /// # Errors
    /// [`RestoreError`]; the model is then unchanged.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), RestoreError> {
        let mut restoring = Restoring::of(bytes);
        while restoring.stage != Stage::Done {
            let (state, tables) = self.parts();
            restoring.step(state, tables.language, tables.workspace, &mut { u32::MAX })?;
        }
        Ok(())
    }

    /// Adds the sessions of a model file after its own, and begins training. See [`Agent::join`](crate::Agent::join).
    ///
    /// # Errors
    /// [`RestoreError`]; the training data are then unchanged.
    pub fn join(&mut self, bytes: &[u8]) -> Result<usize, RestoreError> {
        let contents = Contents::read(bytes)?;
        self.read().check_forms(&contents)?;
        Ok(self.lend().join_contents(&contents, 0)?)
    }
}

impl<'t> LanguageRef<'t> {
    /// Saves the training data and the settings, as [`LanguageModel::save`] does.
    ///
    /// # Errors
    /// [`SaveError`]; the buffer may then hold anything.
    pub fn save(self, buffer: &mut [u8]) -> Result<usize, SaveError> {
        self.saving(|model| model.write(buffer))
    }

    /// Calls `run` with the contents of a file of this language model alone.
    fn saving<R>(self, run: impl FnOnce(&Model<'_>) -> R) -> R {
        let options = Options { language: *self.settings(), ..Options::PAPER };
        run(&Model { vocabulary: 0, options: &options, language: self, strategies: None })
    }

    /// Checks that the tasks of a model's sessions fit here, if this memory has the layer.
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

    /// Checks that a model's training data fit here.
    pub(super) fn check_room(self, contents: &Contents<'_>) -> Result<(), RestoreError> {
        Capacities { strategies: 0, ..contents.needs() }.fits_in(&self.rooms())?;
        #[cfg(feature = "layer")]
        self.check_room_for_possible(contents)?;
        Ok(())
    }
}

impl LanguageMut<'_> {
    /// Takes over the tasks of all sessions, if this memory has the layer. Without them, a layer has no effect.
    #[cfg(feature = "layer")]
    fn take_over_possible(&mut self, contents: &Contents<'_>, added: AddedAttributes) {
        let Some(possible) = self.possible_mut() else { return };
        for record in contents.possible_commands.iter() {
            let _ = possible.add_command(&added.symbols(&record));
        }
        let mut pairs = contents.possible.iter();
        for count in contents.possible_counts.iter() {
            let _ = possible.add_session(&[]);
            for pair in pairs.by_ref().take(count as usize) {
                let _ = possible.add_pair_with(pair.command, pair.weight);
            }
        }
    }

    /// Forgets everything, and takes the settings of a model that was found to fit.
    pub(super) fn forget_for(&mut self, contents: &Contents<'_>) {
        let settings = contents.options.language;
        #[cfg(feature = "layer")]
        let settings = Settings { layer: settings.layer && self.possible_mut().is_some(), ..settings };
        self.clear(settings);
        // There is no training data yet.
        self.begin_training();
    }

    /// Completes the training data, and begins training.
    pub(super) fn complete(&mut self, checking: &Checking<'_>, added: AddedAttributes) -> Result<(), RestoreError> {
        #[cfg(feature = "layer")]
        self.take_over_possible(&Contents::of(checking)?, added);
        #[cfg(not(feature = "layer"))]
        let _ = (checking, added);
        let _ = self.data_replaced();
        self.begin_training();
        Ok(())
    }
}
