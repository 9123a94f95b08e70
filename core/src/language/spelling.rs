//! Which words count as variants of one: words that begin alike, and slips of the pen.

use super::tokenizer::word_form;
use crate::symbols::{Symbol, SymbolsRef};

/// For shorter words no slip is assumed: too many words differ by one letter.
const LEAST_LETTERS: usize = 5;

/// How many known words are compared at least in one part of a search.
const AT_ONCE: usize = 32;

/// How far a search for the known word that another counts as has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Search {
    alike: Alike,
    /// The next known word.
    known: u16,
}

impl Search {
    /// Nothing is compared yet.
    pub(super) const START: Self = Self { alike: Alike::Begins, known: 0 };
}

/// In what a known word may be like the word: one after another, each for all known words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Alike {
    /// It begins alike.
    Begins,
    /// It is spelled alike.
    #[cfg(all(feature = "alloc", feature = "unicode"))]
    Spelled,
    /// It differs by a slip.
    Slip,
}

impl Alike {
    const fn next(self) -> Option<Self> {
        match self {
            #[cfg(all(feature = "alloc", feature = "unicode"))]
            Self::Begins => Some(Self::Spelled),
            #[cfg(all(feature = "alloc", feature = "unicode"))]
            Self::Spelled => Some(Self::Slip),
            #[cfg(not(all(feature = "alloc", feature = "unicode")))]
            Self::Begins => Some(Self::Slip),
            Self::Slip => None,
        }
    }
}

/// The known word that `word` counts as: itself; one that begins with the same `letters` letters (0 turns this off), also if "ä" is written
/// "ae"; or, for a word of five letters or more, the first of the `learned` words that differs by one letter left out, added or replaced,
/// or by two neighbours exchanged. A word with a digit counts as itself alone: `bay12` and `bay13` are two places.
pub(super) fn variant(words: SymbolsRef<'_>, learned: usize, word: &str, letters: usize) -> Option<Symbol> {
    variant_on(words, learned, word, letters, &mut { Search::START }, &mut { u32::MAX }).flatten()
}

/// The same in parts: at most about `left` known words are compared. `None` if the search is to go on, with the same words.
pub(super) fn variant_on(
    words: SymbolsRef<'_>,
    learned: usize,
    word: &str,
    letters: usize,
    search: &mut Search,
    left: &mut u32,
) -> Option<Option<Symbol>> {
    if *search == Search::START
        && let Some(known) = words.find(word)
    {
        *left = left.saturating_sub(1);
        return Some(Some(known));
    }
    if has_digit(word) {
        *left = left.saturating_sub(1);
        return Some(None);
    }
    // A Korean character is a syllable, so two of them count as four letters; the rest is a particle or an ending.
    let letters = if word.starts_with(|first| matches!(first, '\u{ac00}'..='\u{d7a3}')) { letters.div_ceil(2) } else { letters };
    let form = word_form(word, letters);
    // A shorter word is alike to itself alone.
    let has_form = letters > 0 && (form.len() < word.len() || self::letters(form) == letters);
    loop {
        let alike = search.alike;
        let most = if alike == Alike::Slip { learned.min(words.len()) } else { words.len() };
        let first = usize::from(search.known);
        let end = first.saturating_add(AT_ONCE.max(*left as usize)).min(most);
        for symbol in (first..end).map(|position| Symbol(position as u16)) {
            let known = words.text(symbol);
            let is_alike = match alike {
                Alike::Begins => has_form && known.starts_with(form),
                #[cfg(all(feature = "alloc", feature = "unicode"))]
                Alike::Spelled => super::letters::is_spelled_alike(known, word, letters),
                Alike::Slip => is_slip(known, word),
            };
            if is_alike && !has_digit(known) {
                *left = left.saturating_sub(symbol.index().saturating_sub(first).saturating_add(1) as u32);
                return Some(Some(symbol));
            }
        }
        *left = left.saturating_sub(end.saturating_sub(first).max(1) as u32);
        *search = if end < most {
            Search { known: end as u16, ..*search }
        } else {
            let Some(next) = alike.next() else { return Some(None) };
            Search { alike: next, known: 0 }
        };
        if *left == 0 {
            return None;
        }
    }
}

/// Whether two words of five letters or more differ by one slip.
///
/// ```
/// use goodbot::language::is_slip;
/// assert!(is_slip("orange", "orage") && is_slip("orange", "ornage") && is_slip("purple", "qurple"));
/// assert!(!is_slip("take", "tale") && !is_slip("orange", "oarnges") && !is_slip("green", "green"));
/// ```
pub fn is_slip(one: &str, other: &str) -> bool {
    letters(one).min(letters(other)) >= LEAST_LETTERS && is_slip_of_any_length(one, other)
}

fn has_digit(word: &str) -> bool {
    word.bytes().any(|byte| byte.is_ascii_digit())
}

/// The number of bytes that two words share, from one end.
fn alike(one: impl Iterator<Item = u8>, other: impl Iterator<Item = u8>) -> usize {
    one.zip(other).take_while(|(one, other)| one == other).count()
}

/// The number of letters of a word. `chars().count()` is made for long texts and takes flash.
#[inline(never)]
fn letters(word: &str) -> usize {
    word.bytes().filter(|byte| byte & 0xc0 != 0x80).count()
}

/// Whether two words differ by one slip.
pub(crate) fn is_slip_of_any_length(one: &str, other: &str) -> bool {
    // Cut off the bytes that both share at the beginning and the end, but only whole letters.
    let begin = (0..=alike(one.bytes(), other.bytes())).rev().find(|&at| one.is_char_boundary(at)).unwrap_or(0);
    let (one, other) = (one.get(begin..).unwrap_or(""), other.get(begin..).unwrap_or(""));
    let end = one.len().wrapping_sub(alike(one.bytes().rev(), other.bytes().rev()));
    let end = (end..=one.len()).find(|&at| one.is_char_boundary(at)).unwrap_or(end);
    let other_end = other.len().wrapping_sub(one.len().wrapping_sub(end));
    let (one, other) = (one.get(..end).unwrap_or(""), other.get(..other_end).unwrap_or(""));
    match (letters(one), letters(other)) {
        (0 | 1, 1) | (1, 0) => true,
        // Two neighbours exchanged.
        (2, 2) => one.chars().eq(other.chars().rev()),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capacity::Capacity;
    use crate::symbols::Symbols;
    use std::string::String;
    use std::vec::Vec;

    /// The words that differ from one by a single slip, letter by letter.
    fn slips(word: &[char]) -> Vec<Vec<char>> {
        let (mut all, letters) = (Vec::new(), ['a', 'é', '子']);
        for at in 0..=word.len() {
            for letter in letters {
                all.push([&word[..at], &[letter], &word[at..]].concat());
            }
            if let Some((_, after)) = word[at..].split_first() {
                all.push([&word[..at], after].concat());
                all.extend(letters.map(|letter| [&word[..at], &[letter], after].concat()));
            }
            if let [first, second, after @ ..] = &word[at..] {
                all.push([&word[..at], &[*second, *first], after].concat());
            }
        }
        all
    }

    #[test]
    fn every_search_takes_some_of_the_budget_so_that_a_part_hears_no_whole_command() {
        let (mut bytes, mut ends, mut len) = ([0; 32], [0; 4], 0);
        let mut words = Symbols::new(&mut bytes, &mut ends, &mut len, Capacity::Words, Capacity::WordBytes);
        for word in ["purple", "orange"] {
            words.intern(word).unwrap();
        }
        for word in ["orange", "oranges", "orage", "bay12", "green"] {
            let mut left = 2;
            let _ = variant_on(words.read(), 2, word, 5, &mut { Search::START }, &mut left);
            assert!(left < 2, "{word}");
        }
    }

    #[test]
    fn a_slip_is_one_letter_more_less_or_other_or_two_exchanged() {
        let mut words: Vec<Vec<char>> = std::vec![Vec::new()];
        for length in 0..4 {
            let longer: Vec<_> = words
                .iter()
                .filter(|word| word.len() == length)
                .flat_map(|word| ['a', 'é', '子'].map(|letter| [word, &[letter][..]].concat()))
                .collect();
            words.extend(longer);
        }
        for one in &words {
            let (slips, text) = (slips(one), String::from_iter(one));
            for other in &words {
                let expected = one != other && slips.contains(other);
                assert_eq!(is_slip_of_any_length(&text, &String::from_iter(other)), expected, "{one:?} {other:?}");
            }
        }
    }
}
