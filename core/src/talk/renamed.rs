//! Another word for the one that lessons have beside the names of places: "chamber" for "room".

use super::classes::Class;
use super::heard::{Utterance, count};
use crate::language::LanguageRef;
use crate::language::roles::talk::{is_name, is_of_task};
use crate::symbols::Symbol;

/// Of ten lessons so many have the word, and of ten of its mentions so many are beside a name.
const MOST: usize = 8;
/// How probable a word is that was never heard as another word for that one, against a word that means something else.
pub(super) const RENAMED: f32 = 0.1;

/// The word of the lessons that a new one stands for, if a name stands beside it on the same side, and the utterance has no such word.
pub(super) fn renamed(language: LanguageRef<'_>, words: &Utterance, at: usize) -> Option<Symbol> {
    let bitext = language.bitext();
    let sessions = bitext.sessions();
    // "I want a new blue car" has no word for what to do.
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
