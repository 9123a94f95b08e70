//! Closed classes of words, from a file in the place of those that are built in.

use super::input;
use crate::outcome::Failure;
use clap::{Args, ValueHint};
use goodbot::talk::ClosedWords;
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

impl ClosedWordOptions {
    /// The table: that of the file, or the one that is built in.
    ///
    /// # Errors
    /// [`Failure::Input`] where the file cannot be read or is no such table.
    pub fn read(&self) -> Result<ClosedWords<'static>, Failure> {
        let Some(file) = &self.closed_words else { return Ok(CLOSED_WORDS) };
        kept_table(&input::text(file)?).map_err(|error| Fault::new(input::name(file), error).into())
    }
}
