//! A starter: sentences for a robot to begin with, beside its own sessions. The more own sessions, the fewer sentences.

use crate::memory::AgentMemory;
use crate::session::{Agent, Finished};
use core::ops::Range;

/// With this many own sessions, a robot learns from half of the sentences. After 4 instead of 32, people's sixteen lessons cost more words than they
/// taught (docs/appendix/language.md, *The starter*).
const HALF: usize = 32;

/// Whether to learn from the sentence at this position of `all`, beside this many own sessions. They are taken evenly from all.
pub fn is_beside(position: usize, all: usize, own: usize) -> bool {
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
        assert_eq!([left(0), left(4), left(32), left(400)], [124, 111, 62, 10]);
        assert!((0..10).filter(|&position| is_beside(position, 10, 32)).eq([0, 2, 4, 6, 8]));
        assert!(!is_beside(0, 0, 0));
    }
}
