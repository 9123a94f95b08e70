//! Saving and restoring the language model.

use super::contents::Contents;
use super::error::{Part, RestoreError, SaveError};
use super::record::Sizes;
use super::writing::Writing;
use crate::capacity::{Capacity, CapacityError, TOKENS_PER_COMMAND, WORDS_PER_COMMAND};
use crate::language::LanguageModel;
use crate::language::lengths::SeenLengths;
use crate::session::Options;
use crate::symbols::Symbol;
use heapless::Vec;

impl LanguageModel<'_> {
    /// Saves the training data and the settings to the front of the buffer, as a model file of no domain. Gives its length.
    ///
    /// # Errors
    /// [`SaveError`]; the buffer may then hold anything.
    pub fn save(&self, buffer: &mut [u8]) -> Result<usize, SaveError> {
        let options = Options { language: *self.settings(), ..Options::PAPER };
        Writing { vocabulary: 0, options, language: self, strategies: None, sizes: self.sizes(0) }.write(buffer)
    }

    /// Takes the training data and the settings of a model file, in place of its own, and begins training: call
    /// [`train`](Self::train) until it is done.
    ///
    /// # Errors
    /// [`RestoreError`]; the model is then as before.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), RestoreError> {
        let contents = Contents::read(bytes)?;
        self.check_room(&contents)?;
        self.take_over(&contents);
        Ok(())
    }

    pub(super) fn sizes(&self, strategies: usize) -> Sizes {
        let rooms = self.rooms();
        let size = |count: usize| u32::try_from(count).unwrap_or(u32::MAX);
        Sizes {
            strategies: size(strategies),
            words: size(rooms.words),
            word_bytes: size(rooms.word_bytes),
            tokens: size(rooms.tokens),
            token_bytes: size(rooms.token_bytes),
            commands: size(rooms.commands),
            command_tokens: size(rooms.command_tokens),
            sessions: size(rooms.sessions),
            sentence_words: size(rooms.sentence_words),
            pairs: size(rooms.pairs),
            translations: size(rooms.translations),
            alignments: size(rooms.alignments),
            length_pairs: size(rooms.length_pairs),
        }
    }

    /// Whether a model's training data fit here, and whether no word or token stands twice.
    pub(super) fn check_room(&self, contents: &Contents<'_>) -> Result<(), RestoreError> {
        let rooms = self.rooms();
        let fits = |capacity, limit: usize, given: usize| {
            if given > limit { Err(CapacityError::new(capacity, limit, given)) } else { Ok(()) }
        };
        fits(Capacity::Words, rooms.words, contents.words.len())?;
        fits(Capacity::WordBytes, rooms.word_bytes, contents.words.iter().map(str::len).sum())?;
        fits(Capacity::Tokens, rooms.tokens, contents.tokens.len())?;
        fits(Capacity::TokenBytes, rooms.token_bytes, contents.tokens.iter().map(str::len).sum())?;
        fits(Capacity::Commands, rooms.commands, contents.commands.len())?;
        fits(Capacity::CommandTokens, rooms.command_tokens, contents.commands.iter().map(|command| command.len()).sum())?;
        fits(Capacity::Sessions, rooms.sessions, contents.sessions.len())?;
        fits(Capacity::SentenceWords, rooms.sentence_words, contents.sessions.iter().map(|session| session.words.len()).sum())?;
        fits(Capacity::Pairs, rooms.pairs, contents.pairs.len())?;
        let cells = contents.tokens.len().saturating_add(1).saturating_mul(contents.words.len());
        fits(Capacity::Translations, rooms.translations, cells)?;
        let distinct = |texts: super::contents::Section<'_, &str>| {
            texts.iter().enumerate().all(|(position, text)| texts.iter().take(position).all(|other| other != text))
        };
        if !distinct(contents.words) {
            return Err(RestoreError::Inconsistent(Part::Words));
        }
        if !distinct(contents.tokens) {
            return Err(RestoreError::Inconsistent(Part::Tokens));
        }
        let mut lengths = SeenLengths::new();
        for_each_length(contents, |machine, english| lengths.see(machine, english));
        fits(Capacity::LengthPairs, rooms.length_pairs, lengths.pairs)?;
        fits(Capacity::Alignments, rooms.alignments, lengths.cells)?;
        Ok(())
    }

    /// Takes the training data over, which were found to fit, and begins training.
    pub(super) fn take_over(&mut self, contents: &Contents<'_>) {
        self.clear(contents.options.language);
        // Nothing here fails: the room was checked.
        for word in contents.words.iter() {
            let _ = self.words_mut().intern(word);
        }
        for token in contents.tokens.iter() {
            let _ = self.tokens_mut().intern(token);
        }
        for record in contents.commands.iter() {
            let mut command: Vec<Symbol, TOKENS_PER_COMMAND> = Vec::new();
            for &token in record.iter() {
                let _ = command.push(Symbol(token));
            }
            let _ = self.bitext_mut().add_command(&command);
        }
        let mut pairs = contents.pairs.iter();
        for session in contents.sessions.iter() {
            let mut words: Vec<Symbol, WORDS_PER_COMMAND> = Vec::new();
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
        let _ = self.data_replaced();
        self.begin_training();
    }
}

fn for_each_length(contents: &Contents<'_>, mut see: impl FnMut(usize, usize)) {
    let commands = contents.commands.index();
    let mut pairs = contents.pairs.iter();
    for session in contents.sessions.iter() {
        for pair in pairs.by_ref().take(session.pairs as usize) {
            if let Some(command) = commands.get(usize::from(pair.command)) {
                see(command.len(), session.words.len());
            }
        }
    }
}
