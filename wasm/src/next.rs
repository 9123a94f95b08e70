//! The next lesson to teach, by the words that this robot has heard.

use std::cell::RefCell;
use std::collections::BTreeMap;

use goodbot_course::next_lesson::{next_lesson, times_heard};

use crate::view::NextLesson;
use crate::world::{Refusal, World};

impl World {
    /// The next lesson to teach: of `lessons`, one command a line, the one that teaches most of the commands in `wanted`, also one a
    /// line. Of equal ones it is the first. `None` if no lesson has a wanted word.
    ///
    /// # Errors
    /// Where a command has too many words, or one that is too long.
    pub fn next_lesson(&self, lessons: &str, wanted: &str) -> Result<Option<NextLesson>, Refusal> {
        let [lessons, wanted]: [Vec<&str>; 2] = [lessons, wanted].map(|text| text.lines().collect());
        // Each word is asked for often, and counting it goes through all that the robot has heard.
        let counted = RefCell::new(BTreeMap::new());
        let heard = |word: &str| {
            let known = counted.borrow().get(word).copied();
            known.unwrap_or_else(|| {
                let count = times_heard(self.agent(), word);
                counted.borrow_mut().insert(word.to_owned(), count);
                count
            })
        };
        let next = next_lesson(&lessons, &wanted, heard).map_err(Refusal::from)?;
        Ok(next.map(|next| {
            let known = next.is_known();
            NextLesson { lesson: next.lesson, word: next.word.to_owned(), needed: next.needed, heard: next.heard, known }
        }))
    }
}
