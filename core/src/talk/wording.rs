//! How commands are worded in the lessons.

use super::heard::count;
use super::verdict::Reading;
use crate::language::LanguageRef;
use crate::language::roles::talk::{Coverage, MOST_WORDS, Senses};
use crate::session::AgentError;
use crate::symbols::Symbol;
use crate::voice::classes::{Class, Classes, ClosedWords};

/// The least probability of a new word in a command.
const OF_OTHERS: f32 = 0.02;

/// The caller's work between two parts; `false` stops the listening.
pub(super) type Pause<'p> = &'p dyn Fn() -> bool;

/// Is shown each reading of an utterance, also those that are said with words of which nobody has heard.
pub(super) type Observe<'o> = Option<&'o dyn Fn(&Reading<'_>)>;

/// Lets the caller do its work.
pub(super) fn take_pause(pause: Pause<'_>) -> Result<(), AgentError> {
    if pause() { Ok(()) } else { Err(AgentError::Stopped) }
}

/// Statistics of the lessons' wording.
pub(super) struct Wording<'c> {
    pub closed: ClosedWords<'c>,
    pub pause: Pause<'c>,
    pub coverage: Coverage,
    /// The probability of a new word in a command.
    pub new: f32,
    /// The probability that a command ends after a word: 1 / (1 + the mean number of words).
    pub end: f32,
    /// Is shown each reading that is weighed.
    pub observe: Observe<'c>,
    /// The sort of derived facts in descriptions.
    pub facts: u8,
    /// The words of lessons that are never the sign of a task, whatever the lessons suggest, and those that lead to a place.
    plain: Marks,
    toward: Marks,
}

/// A mark for each of the first [`MOST_WORDS`] words of lessons, one bit each. The table of closed words is a text, so each word is looked up
/// once.
type Marks = [u64; MOST_WORDS / 64];

const _: () = assert!(MOST_WORDS.is_multiple_of(64));

impl<'c> Wording<'c> {
    pub fn of(language: LanguageRef<'_>, closed: ClosedWords<'c>, facts: u8, (pause, observe): (Pause<'c>, Observe<'c>)) -> Self {
        let (bitext, words) = (language.bitext(), language.tables().words());
        let (mut plain, mut toward) = (Marks::default(), Marks::default());
        for word in 0..language.words().len().min(MOST_WORDS) {
            let classes = closed.of(language.words().text(Symbol(word as u16)));
            for (marks, holds) in [(&mut plain, is_plain(classes)), (&mut toward, classes.contains(Class::Toward))] {
                marks.iter_mut().skip(word / 64).take(1).for_each(|marks| *marks |= u64::from(holds) << (word % 64));
            }
        }
        let is_plain = |word| has(plain, word).unwrap_or_else(|| is_plain(closed.of(language.words().text(word))));
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
            // The Good-Turing estimate; at first every word is new. The floor allows for people who use other words than the lessons.
            new: ((once + 2.0) / (all + 2.0)).max(OF_OTHERS),
            end: 1.0 / (1.0 + all / sessions),
            observe,
            facts,
            plain,
            toward,
        }
    }

    /// Whether a word of lessons is never the sign of a task, whatever the lessons suggest.
    pub fn is_plain(&self, language: LanguageRef<'_>, word: Symbol) -> bool {
        has(self.plain, word).unwrap_or_else(|| is_plain(self.closed.of(language.words().text(word))))
    }

    /// Whether a word of lessons leads to a place.
    pub fn is_toward(&self, language: LanguageRef<'_>, word: Symbol) -> bool {
        has(self.toward, word).unwrap_or_else(|| self.closed.of(language.words().text(word)).contains(Class::Toward))
    }
}

fn is_plain(classes: Classes) -> bool {
    classes.contains_any(&[Class::Polite, Class::Connective, Class::All])
}

/// Whether a word is marked; `None` beyond the first [`MOST_WORDS`].
fn has(marks: Marks, word: Symbol) -> Option<bool> {
    marks.get(word.index() / 64).map(|marks| marks >> (word.index() % 64) & 1 == 1)
}
