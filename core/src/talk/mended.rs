//! New words taken for known ones: slips of the pen, and a synonym of the noun that lessons put beside names, "chamber" for "room".

use super::classes::{Class, Classes, ClosedWords};
use super::heard::{Utterance, count, elided};
use super::slips::{SLIP, is_plural, slip_for};
use crate::capacity::CapacityError;
use crate::language::roles::talk::{is_name, is_of_task};
use crate::language::{LanguageRef, for_each_piece};
use crate::symbols::Symbol;

/// The probability that a word is mistyped beside another mistyped word.
const ANOTHER_SLIP: f32 = 0.15;
/// In tenths: the least number of mentions of the noun per lesson, and the least share of mentions beside a name.
const MOST: usize = 8;
/// The likelihood ratio of a new word as such a synonym, against a word of another meaning.
const RENAMED: f32 = 0.1;

/// Mends slips of the pen; returns whether there are any. Hasty typing affects a whole sentence.
pub(super) fn mend(
    language: LanguageRef<'_>,
    closed: ClosedWords<'_>,
    utterance: &str,
    words: &Utterance,
    mended: &mut Utterance,
) -> Result<bool, CapacityError> {
    let mut slips = 0_usize;
    mended.clone_from(words);
    for rate in [SLIP, ANOTHER_SLIP] {
        let mut position = 0_usize;
        // The first word is no slip for the name of a thing.
        let first = words.iter().position(|word| word.classes == Classes::NONE || word.classes.contains(Class::All));
        for_each_piece(utterance, |piece| {
            let piece = elided(language, closed, piece).map_or(piece, |(_, word)| word);
            let at = words.iter().position(|word| usize::from(word.piece) == position && word.is_new);
            let word = at.and_then(|at| words.get(at));
            if let (Some(word), Some(slot)) = (word, at.and_then(|at| mended.get_mut(at)))
                && let Some((symbol, slip)) = slip_for(language, piece, rate)
                && (rate == SLIP || slips > 1)
                && !(at == first && is_name(language.tables(), Some(symbol)))
                && !closed.of(piece).contains(Class::Act)
            {
                slips = slips.saturating_add(usize::from(rate == SLIP));
                *slot = word.mended(language, symbol, slip);
                slot.is_plural = slot.is_name && is_plural(piece, language.words().text(symbol));
            }
            position = position.saturating_add(1);
            Ok(())
        })?;
    }
    for at in 0..mended.len() {
        if let Some(word) = mended.get(at).filter(|word| word.is_new)
            && let Some(symbol) = renamed(language, mended, at)
        {
            let word = word.mended(language, symbol, RENAMED);
            mended.iter_mut().skip(at).take(1).for_each(|slot| *slot = word);
            slips = slips.saturating_add(1);
        }
    }
    for word in mended.iter_mut() {
        if let Some(usual) = word.as_usual_way(language, closed) {
            *word = usual;
            slips = slips.saturating_add(1);
        }
    }
    Ok(slips > 0)
}

/// The lessons' noun that a new word may replace, if a name is beside it on the same side, and the utterance does not have the noun.
fn renamed(language: LanguageRef<'_>, words: &Utterance, at: usize) -> Option<Symbol> {
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
