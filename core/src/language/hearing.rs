//! Hearing the words of a command in parts: a new word is compared with every known one, which takes a controller far longer than a control
//! loop may wait.

use super::LanguageMut;
use super::forgetting::Unheard;
use super::spelling::{Search, variant_on};
use super::tokenizer::{LETTERS_AT_ONCE, Look, Pieces, Sentence, composed_word, word_form};
use crate::capacity::{Capacity, CapacityError, WORDS_PER_COMMAND};

/// How far a command is heard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Heard {
    /// How far it is looked at for the next word, after the last word that was heard.
    look: Look,
    /// The words so far.
    words: u16,
    /// The search for the known word that the next word counts as.
    search: Search,
}

impl Heard {
    /// Nothing is heard yet.
    pub(crate) const START: Self = Self { look: Look::START, words: 0, search: Search::START };
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
        if *heard == Heard::START {
            *self.unheard = Unheard::NONE;
        }
        while *left > 0 {
            let mut pieces = Pieces::from(command, heard.look);
            let Some(piece) = pieces.look_on(LETTERS_AT_ONCE.max(*left)) else {
                heard.look = pieces.look;
                return Ok(false);
            };
            let Some(piece) = piece else {
                // Those without room are only counted.
                let (most, count) = (WORDS_PER_COMMAND, usize::from(heard.words));
                return if count > most { Err(CapacityError::new(Capacity::WordsPerCommand, most, count)) } else { Ok(true) };
            };
            if sentence.is_full() {
                *left = left.saturating_sub(1);
            } else {
                let word = composed_word(piece)?;
                let Some(known) = variant_on(self.words.read(), learned, &word, letters, &mut heard.search, left) else { return Ok(false) };
                let symbol = known.or_else(|| self.words.intern(word_form(&word, self.settings().letters_kept())).ok());
                if symbol.is_none() {
                    self.note_unheard(&word);
                }
                let _ = sentence.push(symbol);
            }
            *heard = Heard { look: pieces.look, words: heard.words.saturating_add(1), search: Search::START };
        }
        Ok(false)
    }
}
