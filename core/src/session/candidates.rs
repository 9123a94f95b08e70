//! The machine commands that express the tasks of one session.
//!
//! Different tasks and constraints often give the same tokens ("go to the room" for every room). Each distinct machine command is kept once,
//! with its likelihood Pr(e|m) and, at the end of the session, its weight.

use crate::capacity::{Capacity, CapacityError};
use crate::memory::{CandidateTables, CandidateTablesRef};
use crate::probability::Scaled;
use crate::symbols::Symbol;

/// One distinct machine command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    start: u32,
    /// The first task that it expresses.
    task: u8,
    len: u8,
    check: u16,
    /// Pr(e|m).
    pub likelihood: Scaled,
    /// Its share of the session's posterior, unnormalised.
    pub weight: Scaled,
}

impl Candidate {
    /// The number of its tokens.
    pub(super) fn length(&self) -> usize {
        usize::from(self.len)
    }

    /// The value of unused memory.
    pub const UNUSED: Self = Self { start: 0, task: 0, len: 0, check: 0, likelihood: Scaled::ZERO, weight: Scaled::ZERO };
}

/// The number of used entries.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct CandidateCount {
    len: usize,
    used: usize,
}

impl CandidateCount {
    /// None.
    pub(crate) const NONE: Self = Self { len: 0, used: 0 };
}

/// The distinct machine commands of one session.
#[derive(Debug)]
pub(crate) struct Candidates<'t> {
    memory: CandidateTables<'t>,
    count: &'t mut CandidateCount,
}

/// The distinct machine commands of one session, read-only.
#[derive(Clone, Copy, Debug)]
pub struct CandidatesRef<'t> {
    memory: CandidateTablesRef<'t>,
    count: CandidateCount,
}

impl<'t> CandidatesRef<'t> {
    pub(super) const fn new(memory: CandidateTablesRef<'t>, count: CandidateCount) -> Self {
        Self { memory, count }
    }

    /// All candidates, in order of their first occurrence.
    pub fn entries(self) -> &'t [Candidate] {
        self.memory.candidates.get(..self.count.len).unwrap_or(&[])
    }

    /// The tokens of a candidate.
    pub fn tokens(self, candidate: &Candidate) -> &'t [Symbol] {
        let start = candidate.start as usize;
        self.memory.candidate_tokens.get(start..start.saturating_add(usize::from(candidate.len))).unwrap_or(&[])
    }

    /// The tokens of all candidates.
    pub(super) fn all_tokens(self) -> &'t [Symbol] {
        self.memory.candidate_tokens.get(..self.count.used).unwrap_or(&[])
    }

    /// The position of the candidate with these tokens, if there is one.
    pub fn find(self, tokens: &[Symbol]) -> Option<usize> {
        let check = check(tokens);
        self.entries().iter().position(|entry| entry.check == check && self.tokens(entry) == tokens)
    }

    /// The description of a task, for the role model: the tasks of a session have one each, and at most as many as a byte counts.
    pub(crate) fn of_task(self, task: usize) -> Option<usize> {
        self.memory.described.get(task).map(|&position| usize::from(position))
    }

    /// The last candidate that was added for a task, if any.
    pub(crate) fn added_for(self, task: usize) -> Option<usize> {
        self.entries().iter().rposition(|entry| usize::from(entry.task) == task)
    }
}

impl<'t> Candidates<'t> {
    pub(super) const fn new(memory: CandidateTables<'t>, count: &'t mut CandidateCount) -> Self {
        Self { memory, count }
    }

    /// The candidates, read-only.
    pub const fn read(&self) -> CandidatesRef<'_> {
        CandidatesRef { memory: self.memory.read(), count: *self.count }
    }

    /// The candidates, read-only from now on.
    pub(super) fn into_read(self) -> CandidatesRef<'t> {
        let CandidateTables { candidates, candidate_tokens, described } = self.memory;
        CandidatesRef { memory: CandidateTablesRef { candidates, candidate_tokens, described }, count: *self.count }
    }

    pub(super) fn entry_mut(&mut self, position: usize) -> Option<&mut Candidate> {
        self.memory.candidates.get_mut(..self.count.len)?.get_mut(position)
    }

    /// Notes which candidate is the description of a task.
    pub(super) fn describes(&mut self, position: usize, task: usize) {
        if let Some(slot) = self.memory.described.get_mut(task) {
            *slot = position as u8;
        }
    }

    /// The tokens of all candidates, to be renamed.
    pub(super) fn all_tokens_mut(&mut self) -> &mut [Symbol] {
        self.memory.candidate_tokens.get_mut(..self.count.used).unwrap_or(&mut [])
    }

    /// Updates the digests after the tokens were renamed.
    pub(super) fn renamed(&mut self) {
        for position in 0..self.count.len {
            let Some(entry) = self.read().entries().get(position) else { continue };
            let renewed = check(self.read().tokens(entry));
            if let Some(entry) = self.entry_mut(position) {
                entry.check = renewed;
            }
        }
    }

    /// Adds a new machine command of a task, with its likelihood. Returns its position.
    ///
    /// # Errors
    /// A [`CapacityError`].
    pub fn add(&mut self, task: usize, tokens: &[Symbol], likelihood: Scaled) -> Result<usize, CapacityError> {
        let limit = self.memory.candidates.len();
        let end = self.count.used + tokens.len();
        let full = CapacityError::new(Capacity::CandidateTokens, self.memory.candidate_tokens.len(), end);
        let Some(entry) = self.memory.candidates.get_mut(self.count.len) else {
            return Err(CapacityError::full(Capacity::Candidates, limit));
        };
        self.memory
            .candidate_tokens
            .get_mut(self.count.used..end)
            .ok_or(full)?
            .iter_mut()
            .zip(tokens)
            .for_each(|(slot, &token)| *slot = token);
        let (start, len) = (self.count.used as u32, tokens.len() as u8);
        *entry = Candidate { start, task: task as u8, len, check: check(tokens), likelihood, weight: Scaled::ZERO };
        let position = self.count.len;
        (self.count.len, self.count.used) = (self.count.len + 1, end);
        Ok(position)
    }
}

/// A short digest, so that one comparison tells most unequal commands apart.
fn check(tokens: &[Symbol]) -> u16 {
    tokens.iter().fold(0, |sum, token| sum.rotate_left(5) ^ token.0.wrapping_mul(0x9e37))
}
