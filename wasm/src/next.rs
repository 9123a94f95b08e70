//! Which lesson next, for the words that this robot has heard.

use goodbot_course::next_lesson::{next_lesson, times_heard};

use crate::view::NextLesson;
use crate::world::{Refusal, World};

impl World {
    /// The lesson to teach next: of `lessons`, a command on each line, the one that teaches most of the commands in `wanted`, on a line each
    /// too. Of equal ones it is the first. `None` where no lesson has a word that is wanted.
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
