//! Words that mean the same according to a table: colour names above all.
//!
//! The table belongs to a shell and is never learned: a robot links it, a program loads it. Learned words come first: a word that the model
//! knows, also by its beginning or with a slip of the pen, stays as it is. Any other word is replaced by the first word of its line that
//! the model has learned; if there is none, the word stays and is learned as a new one.

use super::model::LanguageRef;
use super::tokenizer::for_each_piece;
use crate::capacity::CapacityError;

/// A table of synonyms: each line holds words that mean the same, separated by blanks. A `#` starts a comment.
///
/// ```
/// use goodbot::language::Synonyms;
/// let colors = Synonyms::new("red crimson scarlet   # and more\nblue azure navy")?;
/// assert_eq!(colors.of("scarlet").collect::<Vec<_>>(), ["red", "crimson"]);
/// assert_eq!(colors.of("green").count(), 0);
/// # Ok::<(), goodbot::language::SynonymError<'static>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Synonyms<'t> {
    text: &'t str,
}

impl<'t> Synonyms<'t> {
    /// No synonyms.
    pub const NONE: Self = Self { text: "" };

    /// Reads the table from a text.
    ///
    /// # Errors
    /// A [`SynonymError`] if a word occurs twice, or is not written as the model hears words: in lower case, without punctuation.
    pub fn new(text: &'t str) -> Result<Self, SynonymError<'t>> {
        let table = Self { text };
        let words = || table.lines().enumerate().flat_map(|(line, words)| words.map(move |word| (line.saturating_add(1), word)));
        for (position, (line, word)) in words().enumerate() {
            let mut alone = false;
            let heard = for_each_piece(word, |piece| {
                alone = piece == word;
                Ok(())
            });
            if heard.is_err() || !alone {
                return Err(SynonymError::NotAWord { word, line });
            }
            if let Some((first, _)) = words().take(position).find(|&(_, other)| other == word) {
                return Err(SynonymError::Twice { word, lines: [first, line] });
            }
        }
        Ok(table)
    }

    fn lines(self) -> impl Iterator<Item = core::str::SplitWhitespace<'t>> {
        self.text.lines().map(|line| line.split('#').next().unwrap_or("").split_whitespace())
    }

    /// The other words on a word's line, in their order.
    pub fn of<'w>(self, word: &'w str) -> impl Iterator<Item = &'t str> + use<'t, 'w> {
        let line = self.lines().find(|words| words.clone().any(|other| other == word));
        line.into_iter().flatten().filter(move |&other| other != word)
    }

    /// Passes each word of a command to `take`, together with the word to be heard for it: a synonym that the model knows, or the word
    /// itself.
    ///
    /// # Errors
    /// As [`for_each_piece`].
    pub fn for_each_word(
        self,
        language: LanguageRef<'_>,
        command: &str,
        mut take: impl FnMut(&str, &str) -> Result<(), CapacityError>,
    ) -> Result<(), CapacityError> {
        for_each_piece(command, |word| {
            let known = if language.knows(word) { None } else { self.of(word).find(|other| language.knows(other)) };
            take(word, known.unwrap_or(word))
        })
    }

    /// The command with synonyms that the model knows, for [`Agent::hear`](crate::Agent::hear).
    ///
    /// ```
    /// # use goodbot::{Agent, Capacities, Options, home, memory::AgentHeap};
    /// # use goodbot::language::Synonyms;
    /// # let agent = Agent::new(AgentHeap::new(&Capacities::SMALL), &home::paper_tasks()?, Options::DEFAULT)?;
    /// let colors = Synonyms::new("red crimson scarlet").unwrap();
    /// // A robot that has not learned "red" learns "crimson" as any other word.
    /// assert_eq!(colors.in_known_words(agent.language(), "go to the Crimson room!")?, "go to the crimson room");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`for_each_piece`].
    #[cfg(feature = "alloc")]
    pub fn in_known_words(self, language: LanguageRef<'_>, command: &str) -> Result<alloc::string::String, CapacityError> {
        let mut known = alloc::string::String::new();
        self.for_each_word(language, command, |_, word| {
            if !known.is_empty() {
                known.push(' ');
            }
            known.push_str(word);
            Ok(())
        })?;
        Ok(known)
    }
}

/// Why a text is not a table of synonyms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SynonymError<'t> {
    /// A word is in the table twice.
    #[error("\"{word}\" is in line {} and in line {}: leave it in one of them", .lines[0], .lines[1])]
    Twice {
        /// The word.
        word: &'t str,
        /// Both line numbers, counted from 1.
        lines: [usize; 2],
    },
    /// This is not heard as one word in lower case.
    #[error("line {line}: \"{word}\" is not heard as one word; write one in lower case without punctuation, or leave it out")]
    NotAWord {
        /// The text.
        word: &'t str,
        /// Its line number, counted from 1.
        line: usize,
    },
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn a_word_in_two_lines_is_refused_with_both() {
        let error = Synonyms::new("red crimson\n\nblue azure red").unwrap_err();
        assert_eq!(error, SynonymError::Twice { word: "red", lines: [1, 3] });
        assert_eq!(error.to_string(), "\"red\" is in line 1 and in line 3: leave it in one of them");
        assert_eq!(Synonyms::new("red red").unwrap_err(), SynonymError::Twice { word: "red", lines: [1, 1] });
    }

    #[test]
    fn what_no_command_would_be_heard_as_is_refused() {
        for (text, word, line) in
            [("red Crimson", "Crimson", 1), ("# colors\nsky-blue", "sky-blue", 2), ("red, crimson", "red,", 1), ("=", "=", 1)]
        {
            assert_eq!(Synonyms::new(text).unwrap_err(), SynonymError::NotAWord { word, line });
        }
        let long = "a".repeat(300);
        assert_eq!(Synonyms::new(&long).unwrap_err(), SynonymError::NotAWord { word: &long, line: 1 });
    }

    #[test]
    fn comments_and_empty_lines_have_no_words() {
        let table = Synonyms::new("# red crimson\n\n   \nblue # azure\r\n").unwrap();
        assert_eq!(table.of("blue").count() + table.of("red").count() + table.of("#").count(), 0);
        assert_eq!(Synonyms::new(""), Ok(Synonyms::NONE));
    }
}
