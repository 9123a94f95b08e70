//! Which lesson next, for the words that this robot has heard.

use goodbot::language::{Model, for_each_piece, for_each_word};
use goodbot::symbols::Symbol;
use goodbot_course::next_lesson::next_lesson;

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
        let next = next_lesson(&lessons, &wanted, |word| self.times_heard(word)).map_err(Refusal::from)?;
        Ok(next.map(|next| NextLesson { lesson: next.lesson, word: next.word.to_owned(), needed: next.needed, heard: next.heard }))
    }

    /// In how many of the sessions that it has learned from the robot heard a word, or, where it keeps a word's first letters, one that
    /// begins so.
    fn times_heard(&self, word: &str) -> u32 {
        let language = self.agent().language();
        let mut pieces: Vec<Option<Symbol>> = Vec::new();
        let letters = self.agent().options().language.letters_kept();
        let take = |piece: &str| {
            pieces.push(language.words().find(goodbot::language::word_form(piece, letters)));
            Ok(())
        };
        let roles = self.agent().options().language.model == Model::Roles;
        if (if roles { for_each_piece(word, take) } else { for_each_word(word, take) }).is_err() {
            return 0;
        }
        let data = language.bitext();
        let has = |session: u16| pieces.iter().all(|piece| piece.is_some_and(|piece| data.sentence(session).contains(&piece)));
        let sessions = u16::try_from(data.sessions()).unwrap_or(u16::MAX);
        (0..sessions).filter(|&session| !pieces.is_empty() && has(session)).count() as u32
    }
}
