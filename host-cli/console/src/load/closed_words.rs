//! Closed classes of words from a file, in place of the built-in ones.

use super::input::{self, InputFile};
use crate::outcome::Failure;
use clap::{Args, ValueHint};
use goodbot::talk::ClosedWords;
use goodbot_lesson::Fault;
use goodbot_lesson::closed_words::{CLOSED_WORDS, kept_table};

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
