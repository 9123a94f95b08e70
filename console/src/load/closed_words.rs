//! Closed classes of words, from a file in the place of those that are built in.

use super::input;
use crate::outcome::Failure;
use clap::{Args, ValueHint};
use goodbot::talk::{ClosedWords, ClosedWordsError};
use goodbot_lesson::Fault;
use goodbot_lesson::listening::{CLOSED_WORDS, kept_table};

/// Where the table is.
#[derive(Debug, Args)]
pub struct ClosedWordOptions {
    /// A table of words such as "not", "and", "please" in the place of the one that is built in (goodbot example closed-words prints that); an
    /// empty file has none
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    closed_words: Option<String>,
}

/// The file of a table, which [`ClosedWordFile::table`] reads.
#[derive(Debug)]
pub struct ClosedWordFile {
    read: Option<(String, Vec<u8>)>,
}

impl ClosedWordOptions {
    /// Reads the file, if there is one.
    ///
    /// # Errors
    /// [`Failure::Input`] where it cannot be read.
    pub fn read(&self) -> Result<ClosedWordFile, Failure> {
        let Some(file) = &self.closed_words else { return Ok(ClosedWordFile { read: None }) };
        let bytes = input::bytes(file).map_err(|fault| Failure::Input(fault.to_string()))?;
        Ok(ClosedWordFile { read: Some((input::name(file).to_owned(), bytes)) })
    }
}

impl ClosedWordFile {
    /// The table: that of the file, or the one that is built in.
    ///
    /// # Errors
    /// [`Failure::Input`] where the file is no such table.
    pub fn table(&self) -> Result<ClosedWords<'_>, Failure> {
        self.read_by(ClosedWords::new)
    }

    /// The same, for as long as the program runs.
    ///
    /// # Errors
    /// As [`table`](Self::table).
    pub fn kept(&self) -> Result<ClosedWords<'static>, Failure> {
        self.read_by(kept_table)
    }

    fn read_by<'t, 'k>(
        &'t self,
        read: impl Fn(&'t str) -> Result<ClosedWords<'k>, ClosedWordsError<'t>>,
    ) -> Result<ClosedWords<'k>, Failure> {
        let Some((name, bytes)) = &self.read else { return Ok(CLOSED_WORDS) };
        let fault = |message: String| Failure::Input(Fault::new(name, message).to_string());
        let text = str::from_utf8(bytes).map_err(|_| fault("is not UTF-8; write words in UTF-8".to_owned()))?;
        read(text).map_err(|error| fault(error.to_string()))
    }
}
