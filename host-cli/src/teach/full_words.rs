//! The full forms of words. The robot keeps only the beginning of each word.

use goodbot::language::{for_each_word, word_form};
use std::collections::BTreeMap;

/// The full forms of the words that were said.
#[derive(Debug, Default)]
pub struct FullWords {
    letters: usize,
    full: BTreeMap<String, String>,
}

impl FullWords {
    /// No words yet, for a robot that keeps this many letters of a word; 0 for all.
    pub fn new(letters: usize) -> Self {
        Self { letters, full: BTreeMap::new() }
    }

    /// Adds the words of a command. The first full word for each beginning stays.
    pub fn hear(&mut self, command: &str) {
        let (letters, full) = (self.letters, &mut self.full);
        // The robot does not know a word that is too long for it.
        let _ = for_each_word(command, |word| {
            full.entry(word_form(word, letters).to_owned()).or_insert_with(|| word.to_owned());
            Ok(())
        });
    }

    /// The full form of a word; if only its beginning is known, the beginning with dots.
    pub fn of(&self, kept: &str) -> String {
        let cut = self.letters > 0 && kept.chars().count() >= self.letters;
        self.full.get(kept).cloned().unwrap_or_else(|| if cut { format!("{kept}…") } else { kept.to_owned() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_shown_as_they_were_said() {
        let mut words = FullWords::new(4);
        words.hear("Go to the yellow room");
        assert_eq!([words.of("yell"), words.of("go"), words.of("chai")], ["yellow", "go", "chai…"]);
    }
}
