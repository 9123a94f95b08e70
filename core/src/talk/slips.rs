//! Slips of the pen: known words that new words may be slips for.

use crate::language::LanguageRef;
use crate::language::roles::talk::is_of_task;
use crate::language::spelling::is_slip_of_any_length;
use crate::symbols::Symbol;

/// The probability that a word is mistyped.
pub(super) const SLIP: f32 = 0.02;
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
        // The number of possible slips of a word: an exchange, a letter left out, inserted or replaced.
        let slips = if is_form { OTHER_ENDINGS } else { 54.0 * length as f32 + 25.0 };
        let probability = rate / slips / spelling;
        if best.is_none_or(|(_, most)| probability > most) {
            best = Some((symbol, probability));
        }
    }
    best
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
