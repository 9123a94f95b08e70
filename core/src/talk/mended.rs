//! A synonym of the noun that lessons put beside names: "chamber" for "room".

use super::classes::Class;
use super::heard::{Utterance, count};
use crate::language::LanguageRef;
use crate::language::roles::talk::{is_name, is_of_task};
use crate::symbols::Symbol;

/// In tenths: the least number of mentions of the noun per lesson, and the least share of mentions beside a name.
const MOST: usize = 8;
/// The likelihood ratio of a new word as such a synonym, against a word of another meaning.
pub(super) const RENAMED: f32 = 0.1;

/// The lessons' noun that a new word may replace, if a name is beside it on the same side, and the utterance does not have the noun.
pub(super) fn renamed(language: LanguageRef<'_>, words: &Utterance, at: usize) -> Option<Symbol> {
    let bitext = language.bitext();
    let sessions = bitext.sessions();
    // "I want a new blue car" has no act word.
    if words.iter().any(|word| word.classes.contains(Class::Wish)) {
        return None;
    }
    for (beside, is_behind) in [(at.wrapping_sub(1), true), (at.wrapping_add(1), false)] {
        if words.get(beside).is_none_or(|word| !word.is_name) {
            continue;
        }
        for symbol in (0..language.tables().words()).map(|word| Symbol(word as u16)) {
            let mentions = count(bitext, symbol);
            let is_said = words.iter().any(|word| word.said.symbol == Some(symbol));
            if is_said || mentions.saturating_mul(10) < sessions.saturating_mul(MOST) || is_name(language.tables(), Some(symbol)) {
                continue;
            }
            let mut with_name = 0_usize;
            for session in 0..sessions as u16 {
                for pair in bitext.sentence(session).windows(2) {
                    let &[before, behind] = pair else { continue };
                    let (name, word) = if is_behind { (before, behind) } else { (behind, before) };
                    with_name = with_name.saturating_add(usize::from(word == symbol && is_name(language.tables(), Some(name))));
                }
            }
            if with_name.saturating_mul(10) >= mentions.saturating_mul(MOST) && mentions > 0 && !is_of_task(language.tables(), Some(symbol))
            {
                return Some(symbol);
            }
        }
    }
    None
}
