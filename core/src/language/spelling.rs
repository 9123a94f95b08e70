//! Which words are variants of one: what begins alike, and slips of the pen.

use super::tokenizer::word_form;
use crate::symbols::{Symbol, SymbolsRef};

/// Shorter words have no slips: too many words differ by one letter.
const LEAST_LETTERS: usize = 5;

/// The known word that `word` counts as: itself, one that begins with the same `letters` letters (0 for none such), also where "ä" is written
/// "ae", or, for a word of five letters or more, the first of the `learned` words that differs by one letter left out, put in, exchanged with
/// its neighbour or taken for another.
pub(super) fn variant(words: SymbolsRef<'_>, learned: usize, word: &str, letters: usize) -> Option<Symbol> {
    if let Some(known) = words.find(word) {
        return Some(known);
    }
    // A Korean sign is a syllable, so two of them count as four letters: the rest is a particle or an ending.
    let letters = if word.starts_with(|first| matches!(first, '\u{ac00}'..='\u{d7a3}')) { letters.div_ceil(2) } else { letters };
    let form = word_form(word, letters);
    // A word of fewer letters is alike to itself alone.
    let has_form = letters > 0 && (form.len() < word.len() || form.chars().count() == letters);
    let begins_alike = |known: &str| has_form && known.starts_with(form);
    let find =
        |alike: &dyn Fn(&str) -> bool, most: usize| words.iter().take(most).find(|(_, known)| alike(known)).map(|(symbol, _)| symbol);
    let alike = find(&begins_alike, usize::MAX);
    #[cfg(feature = "marks")]
    let alike = alike.or_else(|| find(&|known| super::letters::is_spelled_alike(known, word, letters), usize::MAX));
    alike.or_else(|| find(&|known| is_slip(known, word), learned))
}

/// Whether two words, one of them of five letters or more, differ by one slip.
///
/// ```
/// use goodbot::language::is_slip;
/// assert!(is_slip("orange", "orage") && is_slip("orange", "ornage") && is_slip("purple", "qurple"));
/// assert!(!is_slip("take", "tale") && !is_slip("orange", "oarnges") && !is_slip("green", "green"));
/// ```
pub fn is_slip(one: &str, other: &str) -> bool {
    one.chars().count().min(other.chars().count()) >= LEAST_LETTERS && is_slip_of_any_length(one, other)
}

/// Whether two words differ by one slip.
pub(crate) fn is_slip_of_any_length(one: &str, other: &str) -> bool {
    let (a, b) = (one.chars().count(), other.chars().count());
    let (short, long) = if a <= b { (one, other) } else { (other, one) };
    if a.abs_diff(b) > 1 {
        return false;
    }
    let (mut shorter, mut longer) = (short.chars(), long.chars());
    loop {
        let rests = (shorter.as_str(), longer.as_str());
        match (shorter.next(), longer.next()) {
            (Some(x), Some(y)) if x == y => {}
            (None, None) => return false,
            (None, Some(_)) => return longer.as_str().is_empty(),
            (_, None) => return false,
            (Some(x), Some(y)) => {
                if a != b {
                    return rests.0 == longer.as_str();
                }
                if shorter.as_str() == longer.as_str() {
                    return true;
                }
                return shorter.next() == Some(y) && longer.next() == Some(x) && shorter.as_str() == longer.as_str();
            }
        }
    }
}
