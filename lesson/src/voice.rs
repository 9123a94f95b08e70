//! Words said along with the feedback buttons. They count as praise or blame until the program ends.

use goodbot::AgentError;
use goodbot::feedback::Feedback;
use goodbot::talk::{ClosedWords, for_each_open_word};

/// The words said along with the feedback buttons: how often each came with "good" and with "bad".
#[derive(Clone, Debug, Default)]
pub struct Voice {
    said: Vec<(String, [u32; 2])>,
}

impl Voice {
    /// Counts the words said along with a button. Silence teaches nothing, nor do words of closed classes.
    ///
    /// # Errors
    /// A [`goodbot::capacity::CapacityError`] if there are too many words, or one is too long.
    pub fn learn(&mut self, words: &str, feedback: Feedback, closed: ClosedWords<'_>) -> Result<(), AgentError> {
        let side = match feedback {
            Feedback::Reward => 0,
            Feedback::Punish => 1,
            Feedback::Neutral => return Ok(()),
        };
        for_each_open_word(words, closed, |word| {
            let known = self.said.iter().position(|(known, _)| known == word).unwrap_or_else(|| {
                self.said.push((word.to_owned(), [0; 2]));
                self.said.len() - 1
            });
            let counts = &mut self.said[known].1;
            counts[side] = counts[side].saturating_add(1);
        })
    }

    /// How often a word came with "good" and with "bad"; `None` if it never did.
    pub fn count(&self, word: &str) -> Option<[u32; 2]> {
        self.said.iter().find(|(known, _)| known == word).map(|(_, counts)| *counts)
    }
}
