//! How commands are worded, as far as lessons tell.

use super::classes::{Class, ClosedWords};
use super::heard::count;
use crate::language::LanguageRef;
use crate::language::roles::talk::{Coverage, Senses};
use crate::session::AgentError;
use crate::symbols::Symbol;

/// How much more probable a task must be after few lessons, times their number.
const SURE_OF_FEW: f32 = 2.4;

/// The least share of new words in a command.
const OF_OTHERS: f32 = 0.02;

/// What the caller does between two parts of the work; `false` stops it.
pub(super) type Pause<'p> = &'p dyn Fn() -> bool;

pub(super) fn rest(pause: Pause<'_>) -> Result<(), AgentError> {
    if pause() { Ok(()) } else { Err(AgentError::Stopped) }
}

/// How commands are worded, as far as was learned.
pub(super) struct Wording<'c> {
    pub closed: ClosedWords<'c>,
    pub pause: Pause<'c>,
    pub coverage: Coverage,
    /// How probable a new word is in a command.
    pub new: f32,
    /// One by one more than the words of a command, on average: how probable its end is after each word.
    pub end: f32,
    /// How probable the most likely task must be.
    pub sure: f32,
    /// The sort of derived facts in descriptions.
    pub facts: u8,
}

impl<'c> Wording<'c> {
    pub fn of(language: LanguageRef<'_>, closed: ClosedWords<'c>, facts: u8, pause: Pause<'c>) -> Self {
        let (bitext, words) = (language.bitext(), language.tables().words());
        let is_plain = |word| is_plain(language, closed, word);
        let coverage = Coverage::of(&mut Senses::new(language.tables(), bitext, &is_plain, facts));
        let sessions = bitext.sessions();
        let sentences = || (0..sessions as u16).map(|session| bitext.sentence(session));
        let all = sentences().map(<[Symbol]>::len).sum::<usize>() as f32;
        let count = |word: usize| count(bitext, Symbol(word as u16));
        let once = (0..words).filter(|&word| count(word) == 1).count() as f32;
        let sessions = sessions.max(1) as f32;
        Self {
            closed,
            pause,
            coverage,
            // Good and Turing's estimate; at first every word is new. Other people have other words than the lessons.
            new: ((once + 2.0) / (all + 2.0)).max(OF_OTHERS),
            end: 1.0 / (1.0 + all / sessions),
            // 0.7 after 24 lessons, 0.62 after 120.
            sure: (0.6 + SURE_OF_FEW / sessions).min(0.95),
            facts,
        }
    }
}

/// Whether a word speaks of no task, whatever lessons say.
pub(super) fn is_plain(language: LanguageRef<'_>, closed: ClosedWords<'_>, word: Symbol) -> bool {
    closed.of(language.words().text(word)).contains_any(&[Class::Polite, Class::Connective, Class::All])
}
