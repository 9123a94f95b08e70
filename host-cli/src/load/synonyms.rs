//! Tables of synonyms.

use super::{Fault, input};
use crate::outcome::Failure;
use crate::refusal;
use clap::{Args, ValueHint};
use goodbot::language::{LanguageRef, Synonyms};

/// Where the table is.
#[derive(Debug, Args)]
pub struct SynonymOptions {
    /// A table of words that mean the same: what was not learned is heard as a word of its line that was (goodbot example synonyms prints one)
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    synonyms: Option<String>,
}

/// The text of a table that was checked; empty without one.
#[derive(Debug, Default)]
pub struct SynonymText(String);

impl SynonymOptions {
    /// Whether a table is given.
    pub const fn is_given(&self) -> bool {
        self.synonyms.is_some()
    }

    /// Reads the table.
    ///
    /// # Errors
    /// [`Failure::Input`] where the file cannot be read, or is no such table.
    pub fn read(&self) -> Result<SynonymText, Failure> {
        let Some(file) = &self.synonyms else { return Ok(SynonymText::default()) };
        let fault = |message: String| Failure::Input(Fault::new(input::name(file), message).to_string());
        let bytes = input::bytes(file).map_err(|fault| Failure::Input(fault.to_string()))?;
        let text = String::from_utf8(bytes).map_err(|_| fault("is not UTF-8; write words in UTF-8".to_owned()))?;
        Synonyms::new(&text).map_err(|error| fault(error.to_string()))?;
        Ok(SynonymText(text))
    }
}

impl SynonymText {
    /// The command in words that a model knows, as far as the table has them.
    ///
    /// # Errors
    /// [`Failure::Input`] where the command is too long.
    pub fn in_known_words(&self, language: LanguageRef<'_>, command: &str) -> Result<String, Failure> {
        if self.0.is_empty() {
            return Ok(command.to_owned());
        }
        let table = Synonyms::new(&self.0).unwrap_or_default();
        table.in_known_words(language, command).map_err(|error| Failure::Input(refusal::in_words(&error.into())))
    }
}
