//! Splits a command into words: at blanks, in lower case, without punctuation at either end.
//!
//! Without the feature `unicode`, which costs 4.6 KB in the course for a Cortex-M4F, only ASCII letters become lower case, and every
//! character beyond ASCII that is neither a blank nor common punctuation counts as a letter.

#[cfg(all(feature = "alloc", feature = "unicode"))]
use super::letters::{composed, full_width, is_within_words, ordinary};
use super::settings::Model;
use super::unspaced::Script;
use crate::capacity::{Capacity, CapacityError, NAME_BYTES, WORDS_PER_COMMAND};
use crate::symbols::Symbol;
use heapless::{String, Vec};
use letters::{is_alphanumeric, split, to_lower_case};

/// A command as words, with `None` for words outside the vocabulary.
pub type Sentence = Vec<Option<Symbol>, WORDS_PER_COMMAND>;

/// One word, in lower case.
pub type Word = String<NAME_BYTES>;

/// Passes each word of `command` to `take`.
///
/// ```
/// use goodbot::language::for_each_word;
/// let mut words = vec![];
/// for_each_word("Move to the RED-hot room, please !", |word| { words.push(word.to_string()); Ok(()) })?;
/// assert_eq!(words, ["move", "to", "the", "red-hot", "room", "please"]);
/// # Ok::<(), goodbot::capacity::CapacityError>(())
/// ```
///
/// # Errors
/// A [`CapacityError`] if a word is longer than [`NAME_BYTES`] or there are more than [`WORDS_PER_COMMAND`] words, and any error of `take`.
pub fn for_each_word(command: &str, mut take: impl FnMut(&str) -> Result<(), CapacityError>) -> Result<(), CapacityError> {
    let pieces = || split(command).map(|word| word.trim_matches(|letter| is_apostrophe(letter) || !is_of_word(letter)));
    let words = || pieces().filter(|word| word.chars().any(is_alphanumeric));
    let count = words().count();
    Capacity::WordsPerCommand.fits(count, WORDS_PER_COMMAND)?;
    words().try_for_each(|word| take(&lower_case(word)?))
}

/// Passes each word of `command` to `take` as the role model hears it: in lower case, without the punctuation of any script, with
/// hyphenated words split. Scripts without spaces between words are split as [`unspaced`](super::unspaced) describes.
///
/// ```
/// use goodbot::language::for_each_piece;
/// let mut words = vec![];
/// for_each_piece("don't go: the ‘tan-coloured’ room！", |word| { words.push(word.to_string()); Ok(()) })?;
/// assert_eq!(words, ["don't", "go", "the", "tan", "coloured", "room"]);
/// words.clear();
/// for_each_piece("去 red 的房间。", |word| { words.push(word.to_string()); Ok(()) })?;
/// assert_eq!(words, ["去", "red", "的", "房", "间"]);
/// # Ok::<(), goodbot::capacity::CapacityError>(())
/// ```
///
/// # Errors
/// As [`for_each_word`].
pub fn for_each_piece(command: &str, mut take: impl FnMut(&str) -> Result<(), CapacityError>) -> Result<(), CapacityError> {
    give_pieces(command, &mut take)
}

/// [`for_each_piece`], compiled once for all callers.
fn give_pieces(command: &str, take: &mut dyn FnMut(&str) -> Result<(), CapacityError>) -> Result<(), CapacityError> {
    // A command has no more words than bytes. Counting those of a short one would take a controller a tenth of a call.
    if command.len() > WORDS_PER_COMMAND {
        let count = pieces(command).count();
        Capacity::WordsPerCommand.fits(count, WORDS_PER_COMMAND)?;
    }
    pieces(command).try_for_each(|word| take(&composed_word(word)?))
}

impl Model {
    /// Passes each word of `command` to `take` as this model hears it: Model 2 by [`for_each_word`], the role model by [`for_each_piece`].
    ///
    /// # Errors
    /// As those.
    pub fn for_each_word(self, command: &str, take: impl FnMut(&str) -> Result<(), CapacityError>) -> Result<(), CapacityError> {
        match self.in_use() {
            Self::Model2 => for_each_word(command, take),
            Self::Roles => for_each_piece(command, take),
        }
    }
}

/// The beginning of a command that is read if it has too many words: its first [`WORDS_PER_COMMAND`] words.
///
/// ```
/// assert_eq!(goodbot::language::first_words("go to the red room"), "go to the red room");
/// assert_eq!(goodbot::language::first_words(&"go ".repeat(100)).trim(), "go ".repeat(64).trim());
/// ```
#[cfg(feature = "talk")]
pub fn first_words(command: &str) -> &str {
    start_of_piece(command, WORDS_PER_COMMAND).and_then(|end| command.get(..end)).unwrap_or(command)
}

/// The position in bytes at which a word of [`for_each_piece`] begins. `None` if there are fewer words.
#[cfg(feature = "talk")]
pub(crate) fn start_of_piece(command: &str, position: usize) -> Option<usize> {
    Some(pieces(command).nth(position)?.as_ptr().addr().saturating_sub(command.as_ptr().addr()))
}

/// Whether a command can have a word. Only the first few letters are looked at, because other work at the beginning of a command has no
/// parts: a longer one without a word is told while it is heard.
pub(crate) fn may_have_pieces(command: &str) -> bool {
    let mut letters = command.chars();
    letters.by_ref().take(FIRST_LETTERS).any(is_alphanumeric) || letters.next().is_some()
}

const FIRST_LETTERS: usize = 8;

/// With a small budget, a part of the work looks at this many letters. One beyond ASCII can take a controller 500 instructions.
pub(super) const LETTERS_AT_ONCE: u32 = 32;

pub(super) const fn pieces(command: &str) -> Pieces<'_> {
    Pieces { command, look: Look::START }
}

/// How far the letters of a command are looked at for its next piece, in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Look {
    seen: u32,
    /// The beginning of the piece, and its end so far.
    start: u32,
    end: u32,
    /// The script of its last letter.
    before: Script,
    /// Whether it has a letter or a digit.
    says: bool,
}

impl Look {
    /// At nothing yet.
    pub(super) const START: Self = Self { seen: 0, start: 0, end: 0, before: Script::Spaced, says: false };
}

/// The pieces of a command, found letter by letter: iterator adapters would take twice the flash on a controller.
pub(super) struct Pieces<'c> {
    command: &'c str,
    pub(super) look: Look,
}

impl<'c> Pieces<'c> {
    /// The pieces that are not looked at yet.
    pub(super) const fn from(command: &'c str, look: Look) -> Self {
        Self { command, look }
    }

    /// Looks for the next piece in at most `most` letters. `None` if there are more letters to look at, otherwise the piece, or that there is
    /// none.
    #[inline(never)]
    pub(super) fn look_on(&mut self, mut most: u32) -> Option<Option<&'c str>> {
        let command = self.command;
        let Look { mut seen, mut start, mut end, mut before, mut says } = self.look;
        for letter in command.get(seen as usize..).unwrap_or("").chars() {
            if most == 0 {
                self.look = Look { seen, start, end, before, says };
                return None;
            }
            most = most.saturating_sub(1);
            let at = seen;
            seen = seen.saturating_add(letter.len_utf8() as u32);
            if is_apostrophe(letter) {
                // At either end of a word they are not part of it.
                continue;
            }
            #[cfg(all(feature = "alloc", feature = "unicode"))]
            let is_of_word = is_of_word(letter) || is_within_words(letter);
            #[cfg(not(all(feature = "alloc", feature = "unicode")))]
            let is_of_word = is_of_word(letter);
            let now = Script::of(letter);
            if end > start && !(is_of_word && now.goes_on(before)) {
                if says {
                    self.look = Look { seen: at, start: at, end: at, ..Look::START };
                    return Some(command.get(start as usize..end as usize));
                }
                end = start;
            }
            if is_of_word {
                if end <= start {
                    start = at;
                }
                (end, before) = (seen, now);
                says |= is_alphanumeric(letter);
            }
        }
        self.look = Look { seen, start: seen, end: seen, ..Look::START };
        Some(command.get(start as usize..end as usize).filter(|_| says))
    }
}

impl<'c> Iterator for Pieces<'c> {
    type Item = &'c str;

    fn next(&mut self) -> Option<&'c str> {
        self.look_on(u32::MAX).flatten()
    }
}

#[cfg(feature = "unicode")]
mod letters {
    pub fn split(text: &str) -> impl Iterator<Item = &str> {
        text.split_whitespace()
    }

    pub fn is_alphanumeric(letter: char) -> bool {
        letter.is_alphanumeric()
    }

    pub fn to_lower_case(letter: char) -> impl Iterator<Item = char> {
        letter.to_lowercase()
    }
}

#[cfg(not(feature = "unicode"))]
mod letters {
    pub fn split(text: &str) -> impl Iterator<Item = &str> {
        text.split(is_blank).filter(|word| !word.is_empty())
    }

    const fn is_blank(letter: char) -> bool {
        letter.is_ascii_whitespace()
            || matches!(letter, '\u{b}' | '\u{85}' | '\u{a0}' | '\u{1680}' | '\u{2000}'..='\u{200a}' | '\u{2028}'..='\u{2029}')
            || matches!(letter, '\u{202f}' | '\u{205f}' | '\u{3000}')
    }

    pub fn is_alphanumeric(letter: char) -> bool {
        letter.is_ascii_alphanumeric() || !(letter.is_ascii() || super::is_in(&PUNCTUATION, letter))
    }

    /// The punctuation and the blanks of living scripts, beyond ASCII: no table of all characters.
    const PUNCTUATION: [u16; 98] = [
        0x80, 0xa9, 0xab, 0xb4, 0xb6, 0xb9, 0xbb, 0xbf, 0xd7, 0xd7, 0xf7, 0xf7, 0x37e, 0x37e, 0x387, 0x387, 0x55a, 0x55f, 0x589, 0x58f,
        0x5be, 0x5be, 0x5c0, 0x5c0, 0x5c3, 0x5c3, 0x5c6, 0x5c6, 0x5f3, 0x5f4, 0x60c, 0x60d, 0x61b, 0x61f, 0x66a, 0x66d, 0x6d4, 0x6d4,
        0x700, 0x70f, 0x964, 0x965, 0x970, 0x970, 0xdf4, 0xdf4, 0xe4f, 0xe4f, 0xe5a, 0xe5b, 0xf04, 0xf14, 0xf3a, 0xf3d, 0x104a, 0x104f,
        0x1360, 0x1368, 0x1680, 0x1680, 0x17d4, 0x17da, 0x1800, 0x180a, 0x2000, 0x206f, 0x20a0, 0x20cf, 0x2190, 0x245f, 0x2500, 0x2bff,
        0x2e00, 0x2e5d, 0x3000, 0x3004, 0x3008, 0x3020, 0x3030, 0x3030, 0x303d, 0x303d, 0x30a0, 0x30a0, 0x30fb, 0x30fb, 0xfe10, 0xfe1f,
        0xfe30, 0xfe6f, 0xfeff, 0xff0f, 0xff1a, 0xff20, 0xff3b, 0xff40, 0xff5b, 0xff65,
    ];

    pub fn to_lower_case(letter: char) -> impl Iterator<Item = char> {
        core::iter::once(letter.to_ascii_lowercase())
    }
}

const fn is_apostrophe(letter: char) -> bool {
    matches!(letter, '\'' | '’' | '‘')
}

/// Whether a character is in one of these ranges, each given by its first and last character. A table takes less flash than comparisons.
fn is_in(ranges: &[u16], letter: char) -> bool {
    ranges.as_chunks().0.iter().any(|&[first, last]| (u32::from(first)..=u32::from(last)).contains(&u32::from(letter)))
}

/// The combining marks of scripts that write vowels and accents as separate characters.
const MARKS: [u16; 24] = [
    0x300, 0x36f, 0x591, 0x5c7, 0x610, 0x61a, 0x64b, 0x670, 0x900, 0x963, 0x966, 0xddf, 0xe31, 0xe4e, 0xeb1, 0xecd, 0xf71, 0xf84, 0x102b,
    0x103e, 0x17b4, 0x17d3, 0x200c, 0x200d,
];

/// Letters, digits and the other characters of words: apostrophes and combining [`MARKS`].
fn is_of_word(letter: char) -> bool {
    if letter.is_ascii() {
        return letter.is_ascii_alphanumeric() || is_apostrophe(letter);
    }
    is_alphanumeric(letter) || is_apostrophe(letter) || is_in(&MARKS, letter)
}

/// The beginning of a word, which counts for all its forms: `orange` and `orangey`. The whole word if `letters` is 0.
///
/// ```
/// use goodbot::language::word_form;
/// assert_eq!(word_form("rooms", 4), word_form("room", 4));
/// assert_eq!(word_form("größer", 3), "grö");
/// assert_eq!(word_form("whole", 0), "whole");
/// ```
pub fn word_form(word: &str, letters: usize) -> &str {
    let end = word.char_indices().nth(letters).filter(|_| letters > 0);
    end.and_then(|(end, _)| word.get(..end)).unwrap_or(word)
}

fn lower_case(text: &str) -> Result<Word, CapacityError> {
    let mut word = Word::new();
    for letter in text.chars().flat_map(to_lower_case) {
        word.push(letter).map_err(|_| too_long(text))?;
    }
    Ok(word)
}

/// A word in lower case, in composed form.
#[cfg(all(feature = "alloc", feature = "unicode"))]
pub(super) fn composed_word(text: &str) -> Result<Word, CapacityError> {
    let mut word = Word::new();
    for letter in text.chars().filter_map(ordinary).map(full_width).flat_map(to_lower_case) {
        let one = word.chars().next_back().and_then(|before| composed(before, letter));
        if one.is_some() {
            word.pop();
        }
        word.push(one.unwrap_or(letter)).map_err(|_| too_long(text))?;
    }
    Ok(word)
}

/// A word in lower case. Other ways to write a letter need the tables of `letters`.
#[cfg(not(all(feature = "alloc", feature = "unicode")))]
pub(super) fn composed_word(text: &str) -> Result<Word, CapacityError> {
    lower_case(text)
}

fn too_long(text: &str) -> CapacityError {
    CapacityError::new(Capacity::NameBytes, NAME_BYTES, text.len().max(NAME_BYTES + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_of_ten_thousand_words_is_refused_with_both_numbers() {
        let long = "go ".repeat(10_000);
        let error = for_each_word(&long, |_| Ok(())).unwrap_err();
        assert_eq!(error, CapacityError::new(Capacity::WordsPerCommand, WORDS_PER_COMMAND, 10_000));
    }

    #[test]
    fn a_command_looked_at_letter_by_letter_has_the_same_words() {
        for command in
            ["", " ", "don't go: the ‘tan-coloured’ room！", "去 red 的房间。", "ห้องสีแดง e\u{301}", "\u{301} 'a' \u{301}..b\u{301}"]
        {
            let (mut look, mut found) = (Look::START, std::vec::Vec::new());
            loop {
                let mut pieces = Pieces::from(command, look);
                match pieces.look_on(1) {
                    Some(None) => break,
                    Some(Some(piece)) => found.push(piece),
                    None => {}
                }
                look = pieces.look;
            }
            assert_eq!(found, super::pieces(command).collect::<std::vec::Vec<_>>(), "{command}");
        }
    }

    #[test]
    fn a_word_without_end_is_refused() {
        assert_eq!(for_each_word(&"a".repeat(300), |_| Ok(())).unwrap_err().capacity, Capacity::NameBytes);
    }

    fn words(command: &str) -> std::vec::Vec<std::string::String> {
        let mut words = std::vec::Vec::new();
        for_each_word(command, |word| {
            words.push(std::string::String::from(word));
            Ok(())
        })
        .unwrap();
        words
    }

    fn pieces(command: &str) -> std::vec::Vec<std::string::String> {
        let mut words = std::vec::Vec::new();
        for_each_piece(command, |word| {
            words.push(std::string::String::from(word));
            Ok(())
        })
        .unwrap();
        words
    }

    #[test]
    fn punctuation_of_no_script_sticks_to_a_word() {
        for (command, plain) in [
            ("take the cup.", "take the cup"),
            ("\"the bin\", (the cup); please!", "the bin the cup please"),
            ("¿dónde está la taza?", "dónde está la taza"),
            ("«die tasse» … „bitte“ – ‘so’", "die tasse bitte so"),
            ("कप लाओ।", "कप लाओ"),
            ("الكوب، من فضلك؟", "الكوب من فضلك"),
            ("把 杯子 拿。", "把 杯子 拿"),
            ("カップ！ 「は」", "カップ は"),
            ("գավաթը։", "գավաթը"),
            ("ኩባያ።", "ኩባያ"),
        ] {
            let plain: std::vec::Vec<_> = plain.split(' ').collect();
            assert_eq!(words(command), plain, "{command}");
            assert_eq!(pieces(command), plain, "{command}");
        }
        assert_eq!(words("don't go to the tan-coloured room 5"), ["don't", "go", "to", "the", "tan-coloured", "room", "5"]);
        assert_eq!(pieces("don't，go！to\u{3000}room"), ["don't", "go", "to", "room"]);
    }

    #[test]
    fn an_empty_command_has_no_words() {
        for_each_word(" \t . ,\n", |word| panic!("{word}")).unwrap();
    }
}
