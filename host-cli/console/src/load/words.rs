//! Tables of words: synonyms, and closed classes in place of the built-in ones.

use super::input;
use super::input::InputFile;
use crate::outcome::Failure;
use clap::{Args, ValueHint};
use goodbot::capacity::CapacityError;
use goodbot::language::{LanguageRef, Synonyms};
use goodbot::talk::ClosedWords;
use goodbot_lesson::Fault;
use goodbot_lesson::closed_words::{CLOSED_WORDS, kept_table};
use std::borrow::Cow;

/// The option for the table.
#[derive(Debug, Args)]
pub struct ClosedWordOptions {
    /// A table of closed words such as "not", "and" and "please", in place of the built-in one (goodbot example closed-words prints it); an
    /// empty file has none
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    closed_words: Option<InputFile>,
}

impl ClosedWordOptions {
    /// The table in the file, or the built-in one.
    ///
    /// # Errors
    /// [`Failure::Input`] if the file cannot be read or is no such table.
    pub fn read(&self) -> Result<ClosedWords<'static>, Failure> {
        let Some(file) = &self.closed_words else { return Ok(CLOSED_WORDS) };
        kept_table(&input::text(file)?).map_err(|error| Fault::new(input::name(file), error).into())
    }
}

/// The option for the table.
#[derive(Debug, Args)]
pub struct SynonymOptions {
    /// A table of synonyms: an unknown word is heard as a known word of its line (goodbot example synonyms prints one)
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    synonyms: Option<InputFile>,
}

impl SynonymOptions {
    /// Whether a table is given.
    pub const fn is_given(&self) -> bool {
        self.synonyms.is_some()
    }

    /// The table; empty without a file.
    ///
    /// # Errors
    /// [`Failure::Input`] if the file cannot be read or is no such table.
    pub fn read(&self) -> Result<Synonyms<'static>, Failure> {
        let Some(file) = &self.synonyms else { return Ok(Synonyms::NONE) };
        // A program reads one table, and uses it until it ends.
        let text: &'static str = Box::leak(input::text(file)?.into());
        Synonyms::new(text).map_err(|error| Fault::new(input::name(file), error).into())
    }
}

/// The words, with unknown words replaced by known synonyms. If none is replaced, the text keeps its punctuation, which a listening robot
/// reads.
///
/// # Errors
/// A [`CapacityError`] if a word is too long.
pub fn said_in_known_words<'w>(synonyms: Synonyms<'_>, language: LanguageRef<'_>, words: &'w str) -> Result<Cow<'w, str>, CapacityError> {
    let mut is_other = false;
    synonyms.for_each_word(language, words, |said, heard| {
        is_other |= said != heard;
        Ok(())
    })?;
    if !is_other {
        return Ok(Cow::Borrowed(words));
    }
    let mark = if words.trim_end().ends_with(['?', '？']) { "?" } else { "" };
    Ok(Cow::Owned(synonyms.in_known_words(language, words)? + mark))
}

/// A command with unknown words replaced by known synonyms, if a table has them.
///
/// # Errors
/// [`Failure::Input`] if the command is too long.
pub fn in_known_words(synonyms: Synonyms<'_>, language: LanguageRef<'_>, command: &str) -> Result<String, Failure> {
    Ok(synonyms.in_known_words(language, command)?)
}
