//! Hearing the words of a command in parts: a new word is compared with every known one, which takes a controller far longer than a control
//! loop may wait.

use super::LanguageMut;
use super::forgetting::Unheard;
use super::spelling::{Search, variant_on};
use super::tokenizer::{Sentence, composed_word, pieces, word_form};
use crate::capacity::{Capacity, CapacityError, WORDS_PER_COMMAND};

/// How far a command is heard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Heard {
    /// Bytes of the command up to the next word.
    at: u32,
    /// The search for the known word that the next word counts as.
    search: Search,
}

impl Heard {
    /// Nothing is heard yet.
    pub(crate) const START: Self = Self { at: 0, search: Search::START };
}

impl LanguageMut<'_> {
    /// Hears on, in at most about `left` comparisons with known words. New words are interned; if the vocabulary is full, a new word is
    /// `None`: it is no evidence, and is left out when the command is learned from. Returns whether the command is heard to its end. The
    /// sentence does not depend on the parts.
    ///
    /// # Errors
    /// A [`CapacityError`] if the command or one of its words is too long.
    pub(crate) fn hear_on(
        &mut self,
        command: &str,
        heard: &mut Heard,
        sentence: &mut Sentence,
        left: &mut u32,
    ) -> Result<bool, CapacityError> {
        let letters = usize::from(self.settings().word_letters);
        let learned = self.learned_words();
        if heard.at == 0 {
            *self.unheard = Unheard::NONE;
        }
        let mut rest = pieces(command.get(heard.at as usize..).unwrap_or(""));
        while *left > 0 {
            let Some(piece) = rest.next() else { return Ok(true) };
            if sentence.is_full() {
                let count = WORDS_PER_COMMAND.saturating_add(1).saturating_add(rest.count());
                return Err(CapacityError::new(Capacity::WordsPerCommand, WORDS_PER_COMMAND, count));
            }
            let word = composed_word(piece)?;
            let Some(known) = variant_on(self.words.read(), learned, &word, letters, &mut heard.search, left) else { return Ok(false) };
            let symbol = known.or_else(|| self.words.intern(word_form(&word, self.settings().letters_kept())).ok());
            if symbol.is_none() {
                self.note_unheard(&word);
            }
            let _ = sentence.push(symbol);
            *heard = Heard { at: command.len().saturating_sub(rest.left()) as u32, search: Search::START };
        }
        Ok(false)
    }
}
