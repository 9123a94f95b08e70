//! Slips of the pen: known words that new words may be slips for.

use super::classes::{Class, Classes, ClosedWords};
use super::heard::{Utterance, elided};
use super::renamed::{RENAMED, renamed};
use crate::capacity::CapacityError;
use crate::language::roles::talk::{is_name, is_of_task};
use crate::language::spelling::is_slip_of_any_length;
use crate::language::{LanguageRef, for_each_piece};
use crate::symbols::Symbol;

/// The probability that a word is mistyped, alone and beside another mistyped word.
pub(super) const SLIP: f32 = 0.02;
const ANOTHER_SLIP: f32 = 0.15;
/// The probability of each letter of a new word, and of a new word before its letters.
const LETTER: f32 = 1.0 / 12.0;
const NEW_SPELLING: f32 = 0.2;
/// The number of other endings that a word may have, and the fewest letters before them.
const OTHER_ENDINGS: f32 = 25.0;
const LEAST_BEFORE_ENDING: usize = 3;
/// The most letters that a plural adds.
const LONGEST_ENDING: usize = 2;
/// The most letters of a verb's ending.
const LONGEST_FORM: usize = 4;

/// The most probable known word that a new word is a slip for, and the probability of its spelling then, against that of a new word.
pub(super) fn slip_for(language: LanguageRef<'_>, piece: &str, rate: f32) -> Option<(Symbol, f32)> {
    let letters = piece.chars().count();
    let spelling = (0..letters).fold(NEW_SPELLING, |product, _| product * LETTER);
    let mut best: Option<(Symbol, f32)> = None;
    for position in 0..language.tables().words() {
        let (symbol, known) = (Symbol(position as u16), language.words().text(Symbol(position as u16)));
        let length = known.chars().count();
        let is_form = is_other_form(piece, known) && is_of_task(language.tables(), Some(symbol));
        if length < 2 || !(is_form || is_slip_of_any_length(piece, known) || ending_of_plural(piece, known).is_some()) {
            continue;
        }
        // The number of possible slips of a word: an exchange, a letter left out, inserted or replaced. Or another ending: "roja", "rojo".
        let slips = if is_form || has_other_ending(piece, known) { OTHER_ENDINGS } else { 54.0 * length as f32 + 25.0 };
        let probability = rate / slips / spelling;
        if best.is_none_or(|(_, most)| probability > most) {
            best = Some((symbol, probability));
        }
    }
    best
}

/// Whether two words differ in the last letter alone.
fn has_other_ending(one: &str, other: &str) -> bool {
    let (mut one, mut other) = (one.chars(), other.chars());
    let (last, known) = (one.next_back(), other.next_back());
    last.is_some() && known.is_some() && one.as_str() == other.as_str() && one.count() >= LEAST_BEFORE_ENDING
}

/// Whether a word may be another form of a verb: "taking", "lleves". An accent marks another tense: "llevé".
fn is_other_form(piece: &str, known: &str) -> bool {
    let alike = piece.bytes().zip(known.bytes()).take_while(|(one, other)| one == other).count();
    let ending = |word: &str| word.get(alike..).filter(|ending| ending.is_ascii()).map_or(usize::MAX, str::len);
    alike >= LEAST_BEFORE_ENDING && ending(known) <= 1 && ending(piece) <= LONGEST_FORM
}

/// The ending that makes a word the plural of another: chairs; as in German, Stühle, Stuhl. It may be empty; `None` if there is none.
#[inline(never)]
fn ending_of_plural<'p>(piece: &'p str, known: &str) -> Option<&'p str> {
    let plain = |letter: char| match letter {
        'ä' => 'a',
        'ö' => 'o',
        'ü' => 'u',
        other => other,
    };
    let mut rest = piece.chars();
    let is_begun = known.chars().map(plain).all(|letter| rest.next().map(plain) == Some(letter));
    Some(rest.as_str()).filter(|ending| is_begun && ending.len() <= LONGEST_ENDING)
}

/// Whether a word is the plural of another, in the languages of the tables.
pub(super) fn is_plural(piece: &str, known: &str) -> bool {
    let is_of_plural = |letter| matches!(letter, b'e' | b's' | b'n' | b'r' | b'x');
    ending_of_plural(piece, known).is_some_and(|ending| !ending.is_empty() && ending.bytes().all(is_of_plural))
}

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
