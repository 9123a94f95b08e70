//! Tables of synonyms.

use super::input;
use crate::outcome::Failure;
use crate::refusal;
use clap::{Args, ValueHint};
use goodbot::capacity::CapacityError;
use goodbot::language::{LanguageRef, Synonyms};
use goodbot_lesson::Fault;
use std::borrow::Cow;

/// Where the table is.
#[derive(Debug, Args)]
pub struct SynonymOptions {
    /// A table of synonyms: an unknown word is heard as a known word of its line (goodbot example synonyms prints one)
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    synonyms: Option<String>,
}

/// The file of a table, which [`SynonymFile::table`] reads.
#[derive(Debug, Default)]
pub struct SynonymFile {
    name: String,
    bytes: Vec<u8>,
}

impl SynonymOptions {
    /// Whether a table is given.
    pub const fn is_given(&self) -> bool {
        self.synonyms.is_some()
    }

    /// Reads the file; without one, it is empty.
    ///
    /// # Errors
    /// [`Failure::Input`] where it cannot be read.
    pub fn read(&self) -> Result<SynonymFile, Failure> {
        let Some(file) = &self.synonyms else { return Ok(SynonymFile::default()) };
        let bytes = input::bytes(file).map_err(|fault| Failure::Input(fault.to_string()))?;
        Ok(SynonymFile { name: input::name(file).to_owned(), bytes })
    }
}

impl SynonymFile {
    /// The table.
    ///
    /// # Errors
    /// [`Failure::Input`] where the file is no such table.
    pub fn table(&self) -> Result<Synonyms<'_>, Failure> {
        let fault = |message: String| Failure::Input(Fault::new(&self.name, message).to_string());
        let text = str::from_utf8(&self.bytes).map_err(|_| fault("is not UTF-8; write words in UTF-8".to_owned()))?;
        Synonyms::new(text).map_err(|error| fault(error.to_string()))
    }

    /// The same, for as long as the program runs.
    ///
    /// # Errors
    /// As [`table`](Self::table).
    pub fn kept(self) -> Result<Synonyms<'static>, Failure> {
        // A program reads one table.
        Box::leak(Box::new(self)).table()
    }
}

/// What was said, with unknown words replaced by known synonyms. Where there are none it stays as it is, with its punctuation: a robot that
/// listens reads that.
///
/// # Errors
/// A [`CapacityError`] where a word is too long.
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
/// [`Failure::Input`] where the command is too long.
pub fn in_known_words(synonyms: Synonyms<'_>, language: LanguageRef<'_>, command: &str) -> Result<String, Failure> {
    synonyms.in_known_words(language, command).map_err(|error| Failure::Input(refusal::in_words(&error.into())))
}
