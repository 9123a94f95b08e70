//! Joining what two robots learned.

use super::contents::Contents;
use super::error::RestoreError;
use crate::capacity::{CapacityError, TOKENS_PER_COMMAND, WORDS_PER_COMMAND};
use crate::language::LanguageModel;
use crate::session::Agent;
use crate::symbols::Symbol;
use heapless::Vec;

impl Agent<'_> {
    /// Adds the sessions of a model file after those learned here, words and machine tokens matched by their text, and begins training: call
    /// [`learn`](Self::learn) until it is done. Sessions at the beginning that both have, from a common past, are kept once. The options and
    /// what is believed of the trainers stay those of here. A session under way ends unlearned. Gives how many sessions were added.
    ///
    /// # Errors
    /// [`RestoreError`]; what was learned is then as before.
    pub fn join(&mut self, bytes: &[u8]) -> Result<usize, RestoreError> {
        let contents = Contents::read(bytes)?;
        if contents.vocabulary != 0 && contents.vocabulary != self.vocabulary() {
            return Err(RestoreError::OtherDomain);
        }
        self.end_session();
        self.workspace_to_training();
        Ok(self.language.join_contents(&contents)?)
    }
}

impl LanguageModel<'_> {
    /// Adds the sessions of a model file after its own, and begins training. See [`Agent::join`].
    ///
    /// # Errors
    /// [`RestoreError`]; the training data are then as before.
    pub fn join(&mut self, bytes: &[u8]) -> Result<usize, RestoreError> {
        Ok(self.join_contents(&Contents::read(bytes)?)?)
    }

    fn join_contents(&mut self, contents: &Contents<'_>) -> Result<usize, CapacityError> {
        self.forget_unlearned();
        let (words, tokens, extent) = (self.words().len(), self.tokens().len(), self.bitext().extent());
        let added = self.add_contents(contents).and_then(|added| self.data_replaced().map(|()| added));
        if added.is_err() {
            self.bitext_mut().rewind(extent);
            self.words_mut().truncate(words);
            self.tokens_mut().truncate(tokens);
            // This is what it was before, so it fits.
            let _ = self.data_replaced();
        }
        self.begin_training();
        added
    }

    fn add_contents(&mut self, contents: &Contents<'_>) -> Result<usize, CapacityError> {
        let (words, tokens, commands) = (contents.words.index(), contents.tokens.index(), contents.commands.index());
        let mut pairs = contents.pairs.iter();
        let (mut common, mut added) = (true, 0_usize);
        for (position, session) in contents.sessions.iter().enumerate() {
            let mut sentence: Vec<Symbol, WORDS_PER_COMMAND> = Vec::new();
            for &word in &session.words {
                let word = self.words_mut().intern(words.get(usize::from(word)).unwrap_or(""))?;
                // As many as the record has, so they fit.
                let _ = sentence.push(word);
            }
            let extent = self.bitext().extent();
            self.bitext_mut().add_session(&sentence)?;
            for pair in pairs.by_ref().take(session.pairs as usize) {
                let mut command: Vec<Symbol, TOKENS_PER_COMMAND> = Vec::new();
                for &token in &commands.get(usize::from(pair.command)).unwrap_or_default() {
                    let _ = command.push(self.tokens_mut().intern(tokens.get(usize::from(token)).unwrap_or(""))?);
                }
                self.bitext_mut().add_pair(&command, pair.weight)?;
            }
            common = common && self.last_repeats(position);
            if common {
                self.bitext_mut().rewind(extent);
            } else {
                added = added.saturating_add(1);
            }
        }
        Ok(added)
    }

    /// Whether the last session is the same, pair by pair, as the one at `position`.
    fn last_repeats(&self, position: usize) -> bool {
        let bitext = self.bitext();
        let last = bitext.sessions().saturating_sub(1);
        let (one, other) = (position as u16, last as u16);
        let same_pairs = || {
            let (ones, others) = (bitext.pairs_of(one), bitext.pairs_of(other));
            let equal = |(a, b): (&crate::language::bitext::Pair, &crate::language::bitext::Pair)| {
                a.command == b.command && a.weight.to_bits() == b.weight.to_bits()
            };
            ones.len() == others.len() && ones.iter().zip(others).all(equal)
        };
        position < last && bitext.sentence(one) == bitext.sentence(other) && same_pairs()
    }
}
