//! The descriptions that the layer has already, found without going through all of them: a world may have thousands of tasks, and each session
//! there tells them all.

use crate::capacity::{Capacity, CapacityError, TOKENS_PER_COMMAND};
use crate::language::bitext::{Bitext, BitextRef};
use crate::symbols::Symbol;
use alloc::collections::BTreeSet;

/// The machine commands of training data, by their hashes.
#[derive(Debug)]
pub(in crate::language) struct Known {
    commands: BTreeSet<(u32, u16)>,
}

impl Known {
    /// All commands of the data.
    pub fn of(data: BitextRef<'_>) -> Self {
        Self { commands: (0..data.commands() as u16).map(|command| (hash(data.command(command)), command)).collect() }
    }

    /// Adds a pair of the last session and a machine command, which is kept once, as [`Bitext::add_pair`] does.
    ///
    /// # Errors
    /// A [`CapacityError`]; the pair is not added then.
    pub fn add_pair(&mut self, data: &mut Bitext<'_>, tokens: &[Symbol], weight: f32) -> Result<(), CapacityError> {
        if tokens.len() > TOKENS_PER_COMMAND {
            return Err(CapacityError::new(Capacity::TokensPerCommand, TOKENS_PER_COMMAND, tokens.len()));
        }
        let hash = hash(tokens);
        let mut alike = self.commands.range((hash, 0)..=(hash, u16::MAX)).map(|&(_, command)| command);
        let command = match alike.find(|&command| data.read().command(command) == tokens) {
            Some(command) => command,
            None => {
                let command = data.add_command(tokens)?;
                self.commands.insert((hash, command));
                command
            }
        };
        data.add_pair_with(command, weight)
    }
}

/// FNV-1a, symbol by symbol.
fn hash(tokens: &[Symbol]) -> u32 {
    tokens.iter().fold(0x811c_9dc5, |hash, token| (hash ^ u32::from(token.0)).wrapping_mul(0x0100_0193))
}
