//! A starter: sentences for a robot to begin with, beside its own sessions. The more of these have a sentence's words, the sooner it goes.

use crate::language::LanguageRef;
use crate::memory::AgentMemory;
use crate::session::{Agent, Finished};
use crate::symbols::Symbol;
use core::ops::Range;

/// With this many sessions that teach the same, a robot learns from half of the sentences.
const HALF: usize = 4;

/// What takes the place of a sentence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fading {
    /// The sessions so far that have its rarest word, own ones and those of sentences before it, but no more than there are own ones. So a
    /// word that no own session has is still known after many.
    ByWord,
    /// All own sessions. Fewer sentences are left, so they need less room.
    ByNumber,
}

impl LanguageRef<'_> {
    /// Whether to learn from the sentence at this position of a starter's `all`, with these words, beside `own` sessions. The sentences
    /// before it that are learned from are already sessions here.
    pub fn learns_beside(self, own: usize, position: usize, all: usize, words: impl Iterator<Item = Option<Symbol>>) -> bool {
        is_beside(position, all, if own == 0 { 0 } else { self.sessions_with_rarest(words).min(own) })
    }

    /// The number of sessions that have the rarest of these words.
    fn sessions_with_rarest(self, words: impl Iterator<Item = Option<Symbol>>) -> usize {
        let (bitext, sessions) = (self.bitext(), self.bitext().sessions() as u16);
        let with = |word: Symbol| (0..sessions).filter(|&session| bitext.sentence(session).contains(&word)).count();
        words.map(|word| word.map_or(0, with)).min().unwrap_or(0)
    }
}

/// The sentences of a starter that are learned from, by their positions. Those beyond the table count as learned from, but no starter has
/// so many.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Chosen([u32; 8]);

impl Chosen {
    pub(super) fn add(&mut self, position: usize) {
        if let Some(part) = self.0.get_mut(position / 32) {
            *part |= 1 << (position % 32);
        }
    }

    pub(super) fn has(&self, position: usize) -> bool {
        self.0.get(position / 32).is_none_or(|part| part >> (position % 32) & 1 == 1)
    }
}

/// Whether to learn from the sentence at this position of `all`, beside this many sessions that teach the same. They are taken evenly from
/// all.
pub(super) fn is_beside(position: usize, all: usize, own: usize) -> bool {
    let left = all.saturating_mul(HALF).div_ceil(HALF.saturating_add(own)).min(all);
    // Sentence `nth` of those left is at position `nth * all / left`, rounded down.
    let nth = position.saturating_mul(left).div_ceil(all.max(1));
    nth.saturating_mul(all) < position.saturating_add(1).saturating_mul(left)
}

/// The places of a starter's sentences in an agent's training data.
#[derive(Clone, Debug, Default)]
pub struct Places(Range<u16>);

impl Places {
    /// The last sessions of an agent, this many.
    pub fn last(agent: &Agent<impl AgentMemory>, count: usize) -> Self {
        let sessions = agent.language().bitext().sessions();
        Self(sessions.saturating_sub(count) as u16..sessions as u16)
    }

    /// The number of sentences.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Removes the sentences from the agent's training data.
    pub fn leave(&mut self, agent: &mut Agent<impl AgentMemory>) {
        for place in core::mem::take(&mut self.0).rev() {
            agent.unlearn(place);
        }
    }

    /// Finds the sentences after the agent has learned from a session of its own. Older sessions may have given way. `false` if there are
    /// too many of these to tell: the sentences that are left then stay, as sessions like all others.
    pub fn find_after(&mut self, finished: &Finished) -> bool {
        let gone = finished.gave_way.positions();
        let now = |place: u16| place.saturating_sub(gone.partition_point(|&gone| gone < place) as u16);
        let are_known = gone.len() == finished.gave_way.count();
        self.0 = if are_known { now(self.0.start)..now(self.0.end) } else { 0..0 };
        are_known
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn own_sessions_take_the_sentences_place_evenly() {
        let left = |own| (0..124).filter(|&position| is_beside(position, 124, own)).count();
        assert_eq!([left(0), left(4), left(28), left(400)], [124, 62, 16, 2]);
        assert!((0..10).filter(|&position| is_beside(position, 10, 4)).eq([0, 2, 4, 6, 8]));
        assert!(!is_beside(0, 0, 0));
    }
}
