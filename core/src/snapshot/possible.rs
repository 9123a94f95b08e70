//! The tasks that a model file has for the [layer](crate::language::layer), while they join another model. A world has thousands of them,
//! so each description and each token of the file is looked up once.

use super::contents::Contents;
use super::record::{CommandRecord, PairRecord, marker, symbols};
use super::section::take;
use crate::capacity::{CapacityError, TOKENS_PER_COMMAND};
use crate::language::LanguageMut;
use crate::symbols::Symbol;
use alloc::vec;
use alloc::vec::Vec;

/// The tasks of a file, from one session on.
pub(super) struct Possible<'a> {
    /// The unread tasks.
    rest: &'a [u8],
    /// The bytes from each description on.
    descriptions: Vec<&'a [u8]>,
    tokens: Vec<&'a str>,
    /// The symbol here of each token met so far.
    here: Vec<Option<Symbol>>,
}

impl<'a> Possible<'a> {
    /// The tasks of all sessions of a file.
    pub fn of(contents: &Contents<'a>) -> Self {
        let (mut rest, mut descriptions) = (contents.possible_commands.bytes(), Vec::new());
        for _ in 0..contents.possible_commands.len() {
            descriptions.push(rest);
            let _: Option<CommandRecord> = take(&mut rest);
        }
        let here = vec![None; contents.tokens.len()];
        Self { rest: contents.possible.bytes(), descriptions, tokens: contents.tokens.iter().collect(), here }
    }

    /// Skips the next `tasks` tasks.
    pub fn pass(&mut self, tasks: usize) {
        for _ in 0..tasks {
            let _: Option<PairRecord> = take(&mut self.rest);
        }
    }

    /// Adds the next `tasks` tasks to the last session there.
    ///
    /// # Errors
    /// A [`CapacityError`].
    pub fn add_next(&mut self, language: &mut LanguageMut<'_>, tasks: usize) -> Result<(), CapacityError> {
        if !language.read().settings().layer {
            self.pass(tasks);
            return Ok(());
        }
        let mut added: Vec<(heapless::Vec<Symbol, TOKENS_PER_COMMAND>, f32)> = Vec::new();
        for _ in 0..tasks {
            let Some(pair): Option<PairRecord> = take(&mut self.rest) else { break };
            let mut record = self.descriptions.get(usize::from(pair.command)).copied().unwrap_or(&[]);
            let mut description = symbols(&take(&mut record).unwrap_or_default());
            for token in &mut description {
                *token = self.symbol_here(language, *token)?;
            }
            language.read().put_in_order(&mut description);
            added.push((description, pair.weight));
        }
        language.add_possible(added.iter().map(|(description, prior)| (description.as_slice(), *prior)))
    }

    /// The symbol here for a token of the file.
    fn symbol_here(&mut self, language: &mut LanguageMut<'_>, token: Symbol) -> Result<Symbol, CapacityError> {
        let known = marker(token.0).or_else(|| self.here.get(token.index()).copied().flatten());
        if let Some(known) = known {
            return Ok(known);
        }
        let symbol = language.tokens_mut().intern(self.tokens.get(token.index()).copied().unwrap_or(""))?;
        if let Some(slot) = self.here.get_mut(token.index()) {
            *slot = Some(symbol);
        }
        Ok(symbol)
    }
}
