//! The next lesson to teach, by the words that this robot has heard.

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
        let next = next_lesson(&lessons, &wanted, |word| times_heard(self.agent(), word)).map_err(Refusal::from)?;
        Ok(next.map(|next| {
            let known = next.is_known();
            NextLesson { lesson: next.lesson, word: next.word.to_owned(), needed: next.needed, heard: next.heard, known }
        }))
    }
}
