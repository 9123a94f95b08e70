//! The machine commands that the tasks of one session can be expressed by.
//!
//! Different tasks and constraints often give the same tokens ("go to the room" for every room); each distinct machine command stands
//! once, with its likelihood Pr(e|m) and, at the end of the session, its weight.

use crate::capacity::{Capacity, CapacityError};
use crate::probability::Scaled;
use crate::symbols::Symbol;

/// One distinct machine command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    start: u32,
    len: u8,
    check: u16,
    /// Pr(e|m).
    pub likelihood: Scaled,
    /// How much of the session's posterior it has.
    pub weight: Scaled,
}

impl Candidate {
    /// What unused memory holds.
    pub const UNUSED: Self = Self { start: 0, len: 0, check: 0, likelihood: Scaled::ZERO, weight: Scaled::ZERO };
}

/// Memory for [`Candidates`].
#[derive(Debug)]
pub struct CandidateMemory<'m> {
    /// One entry a distinct machine command.
    pub entries: &'m mut [Candidate],
    /// Their tokens.
    pub tokens: &'m mut [Symbol],
}

/// The distinct machine commands of one session.
#[derive(Debug)]
pub struct Candidates<'m> {
    memory: CandidateMemory<'m>,
    len: usize,
    used: usize,
}

impl<'m> Candidates<'m> {
    /// None yet.
    pub fn new(memory: CandidateMemory<'m>) -> Self {
        Self { memory, len: 0, used: 0 }
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        (self.len, self.used) = (0, 0);
    }

    /// All, in the order in which they first came.
    pub fn entries(&self) -> &[Candidate] {
        self.memory.entries.get(..self.len).unwrap_or(&[])
    }

    pub(super) fn entry_mut(&mut self, position: usize) -> Option<&mut Candidate> {
        self.memory.entries.get_mut(..self.len)?.get_mut(position)
    }

    /// The tokens of one.
    pub fn tokens(&self, candidate: &Candidate) -> &[Symbol] {
        let start = candidate.start as usize;
        self.memory.tokens.get(start..start.saturating_add(usize::from(candidate.len))).unwrap_or(&[])
    }

    /// The tokens of all.
    pub(super) fn all_tokens(&self) -> &[Symbol] {
        self.memory.tokens.get(..self.used).unwrap_or(&[])
    }

    /// The tokens of all, to be renamed.
    pub(super) fn all_tokens_mut(&mut self) -> &mut [Symbol] {
        self.memory.tokens.get_mut(..self.used).unwrap_or(&mut [])
    }

    /// Takes note that the tokens were renamed.
    pub(super) fn renamed(&mut self) {
        for position in 0..self.len {
            let Some(entry) = self.entries().get(position) else { continue };
            let renewed = check(self.tokens(entry));
            if let Some(entry) = self.entry_mut(position) {
                entry.check = renewed;
            }
        }
    }

    /// The position of the machine command with these tokens, if it is among them.
    pub fn find(&self, tokens: &[Symbol]) -> Option<usize> {
        let check = check(tokens);
        self.entries().iter().position(|entry| entry.check == check && self.tokens(entry) == tokens)
    }

    /// Adds a machine command that is not among them, with its likelihood. Gives its position.
    ///
    /// # Errors
    /// A [`CapacityError`].
    pub fn add(&mut self, tokens: &[Symbol], likelihood: Scaled) -> Result<usize, CapacityError> {
        let limit = self.memory.entries.len();
        let end = self.used.saturating_add(tokens.len());
        let full = CapacityError::new(Capacity::CandidateTokens, self.memory.tokens.len(), end);
        let Some(entry) = self.memory.entries.get_mut(self.len) else {
            return Err(CapacityError::full(Capacity::Candidates, limit));
        };
        self.memory.tokens.get_mut(self.used..end).ok_or(full)?.iter_mut().zip(tokens).for_each(|(slot, &token)| *slot = token);
        *entry = Candidate { start: self.used as u32, len: tokens.len() as u8, check: check(tokens), likelihood, weight: Scaled::ZERO };
        let position = self.len;
        (self.len, self.used) = (self.len.saturating_add(1), end);
        Ok(position)
    }
}

/// A short digest, so that most unequal commands are told apart by one comparison.
fn check(tokens: &[Symbol]) -> u16 {
    tokens.iter().fold(0, |sum, token| sum.rotate_left(5) ^ token.0.wrapping_mul(0x9e37))
}
