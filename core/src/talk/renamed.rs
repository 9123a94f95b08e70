//! Another word for the one that lessons have beside the names of places: "chamber" for "room".

use super::heard::{Heard, Utterance, count};
use crate::language::LanguageRef;
use crate::language::roles::talk::{is_name, is_of_task};
use crate::symbols::Symbol;

/// So many of 10 lessons have the word, and as many of its mentions stand beside a name.
const MOST: usize = 8;
/// How probable a word is that was never heard as another word for that one, against a word that means something else.
pub(super) const RENAMED: f32 = 0.1;

/// The word of the lessons that a new one stands for, if a name stands beside it on the same side, and the utterance has no such word.
pub(super) fn renamed(language: LanguageRef<'_>, words: &Utterance, at: usize) -> Option<Symbol> {
    let names = |at: Option<usize>| at.and_then(|at| words.get(at)).is_some_and(|word: &Heard| word.is_name);
    let sides = [names(at.checked_sub(1)), names(at.checked_add(1))];
    let sessions = language.bitext().sessions();
    let is_said = |symbol: Symbol| words.iter().any(|word| word.said.symbol == Some(symbol));
    let is_beside = |symbol: Symbol| {
        let mentions = count(language.bitext(), symbol);
        let is_common = mentions * 10 >= sessions * MOST;
        is_common && !is_name(language.tables(), Some(symbol)) && !is_of_task(language.tables(), Some(symbol)) && {
            let beside = |side: usize| {
                let sentences = (0..sessions as u16).map(|session| language.bitext().sentence(session));
                let pairs = sentences.flat_map(|sentence| sentence.windows(2));
                pairs.filter(|pair| pair.get(1 - side) == Some(&symbol) && is_name(language.tables(), pair.get(side).copied())).count()
            };
            (0..2).any(|side| sides.get(side) == Some(&true) && beside(side) * 10 >= mentions * MOST)
        }
    };
    let any = sides.contains(&true) && sessions > 0;
    (0..language.tables().words()).map(|word| Symbol(word as u16)).find(|&word| any && !is_said(word) && is_beside(word))
}
