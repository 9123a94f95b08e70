//! Finds the descriptions that the layer has already, without a search through all: a world may have thousands of tasks, and each session
//! there adds them all.

use crate::capacity::{Capacity, CapacityError, TOKENS_PER_COMMAND};
use crate::checksum::fnv;
use crate::language::bitext::{Bitext, BitextRef};
use crate::symbols::Symbol;
use alloc::collections::BTreeSet;

/// The machine commands of training data, by their hashes.
#[derive(Debug)]
pub(in crate::language) struct CommandIndex {
    commands: BTreeSet<(u32, u16)>,
}

impl CommandIndex {
    /// The index of all commands in the data.
    pub fn of(data: BitextRef<'_>) -> Self {
        Self { commands: (0..data.commands() as u16).map(|command| (hash(data.command(command)), command)).collect() }
    }

    /// Adds a pair of the last session and a machine command, as [`Bitext::add_pair`] does; equal commands are stored once.
    ///
    /// # Errors
    /// A [`CapacityError`]; the pair is then not added.
    pub fn add_pair(&mut self, data: &mut Bitext<'_>, tokens: &[Symbol], weight: f32) -> Result<(), CapacityError> {
        Capacity::TokensPerCommand.fits(tokens.len(), TOKENS_PER_COMMAND)?;
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

/// The hash of a description.
pub fn hash(tokens: &[Symbol]) -> u32 {
    fnv(tokens.iter().map(|token| u32::from(token.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::bitext::{Extent, Pair, Span};
    use crate::memory::BitextTables;
    use alloc::collections::BTreeMap;

    /// Two descriptions with the same hash.
    fn alike() -> [[Symbol; 2]; 2] {
        let high = |first: u16| hash(&[Symbol(first)]) >> 16;
        let mut firsts = BTreeMap::new();
        let (one, other) = (0..u16::MAX).find_map(|first| Some((firsts.insert(high(first), first)?, first))).unwrap();
        // After the first symbols, the hashes differ in no more bits than a second symbol has.
        let second = hash(&[Symbol(one)]) ^ hash(&[Symbol(other)]);
        [[Symbol(one), Symbol(0)], [Symbol(other), Symbol(second as u16)]]
    }

    #[test]
    fn each_description_is_kept_once_and_two_of_one_hash_stay_apart() {
        let (mut commands, mut command_tokens) = ([Span::UNUSED; 2], [Symbol(0); 4]);
        let (mut sessions, mut pairs) = ([Span::UNUSED; 2], [Pair::UNUSED; 4]);
        let mut used = Extent::NONE;
        let memory = BitextTables {
            commands: &mut commands,
            command_tokens: &mut command_tokens,
            sessions: &mut sessions,
            sentence_words: &mut [],
            pairs: &mut pairs,
        };
        let mut data = Bitext::new(memory, &mut used);
        let alike = alike();
        assert_eq!(hash(&alike[0]), hash(&alike[1]));
        for order in [[0, 1], [1, 0]] {
            data.add_session(&[]).unwrap();
            let mut known = CommandIndex::of(data.read());
            order.iter().for_each(|&description| known.add_pair(&mut data, &alike[description], 0.5).unwrap());
        }
        let commands: std::vec::Vec<u16> = data.read().pairs().iter().map(|pair| pair.command).collect();
        assert_eq!((data.read().commands(), commands.as_slice()), (2, &[0, 1, 1, 0][..]));
        assert_eq!(data.read().command(1), &alike[1]);
    }
}
