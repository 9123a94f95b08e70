//! A command as words: split on blanks, in lower case, without the punctuation at both ends of each.
//!
//! Without the feature `unicode`, which costs 4.6 KB in the course for a Cortex-M4F, only ASCII letters become lower case, and every
//! character beyond ASCII that is no blank and no common punctuation counts as a letter.

#[cfg(feature = "marks")]
use super::letters::{composed, full_width, is_within_words, ordinary};
use super::settings::Model;
use super::unspaced::Script;
use crate::capacity::{Capacity, CapacityError, NAME_BYTES, WORDS_PER_COMMAND};
use crate::symbols::Symbol;
use heapless::{String, Vec};
use letters::{is_alphanumeric, split, to_lower_case};

/// A command as words, `None` for one that the vocabulary does not have.
pub type Sentence = Vec<Option<Symbol>, WORDS_PER_COMMAND>;

/// One word, in lower case.
pub type Word = String<NAME_BYTES>;

/// Gives each word of `command` to `take`.
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
/// A [`CapacityError`] where a word is longer than [`NAME_BYTES`] or there are more than [`WORDS_PER_COMMAND`] words, and whatever `take`
/// gives.
pub fn for_each_word(command: &str, mut take: impl FnMut(&str) -> Result<(), CapacityError>) -> Result<(), CapacityError> {
    let pieces = || split(command).map(|word| word.trim_matches(|letter| is_apostrophe(letter) || !is_of_word(letter)));
    let words = || pieces().filter(|word| word.chars().any(is_alphanumeric));
    let count = words().count();
    if count > WORDS_PER_COMMAND {
        return Err(CapacityError::new(Capacity::WordsPerCommand, WORDS_PER_COMMAND, count));
    }
    words().try_for_each(|word| take(&lower_case(word)?))
}

/// Gives each word of `command` to `take`, as the role model hears it: in lower case, without the punctuation of any script, and what a
/// hyphen joins apart. Scripts without spaces between words are cut as [`unspaced`](super::unspaced) says.
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

/// The same, compiled once for all callers.
fn give_pieces(command: &str, take: &mut dyn FnMut(&str) -> Result<(), CapacityError>) -> Result<(), CapacityError> {
    // A command has no more words than bytes: to count those of a short one would take a controller a tenth of a call.
    if command.len() > WORDS_PER_COMMAND {
        let count = pieces(command).count();
        if count > WORDS_PER_COMMAND {
            return Err(CapacityError::new(Capacity::WordsPerCommand, WORDS_PER_COMMAND, count));
        }
    }
    pieces(command).try_for_each(|word| take(&composed_word(word)?))
}

impl Model {
    /// Gives each word of `command` to `take` as this model hears it: Model 2 by [`for_each_word`], the role model by [`for_each_piece`].
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

/// The words of a command that are read where it has too many: as many as [`WORDS_PER_COMMAND`], from the first.
///
/// ```
/// assert_eq!(goodbot::language::first_words("go to the red room"), "go to the red room");
/// assert_eq!(goodbot::language::first_words(&"go ".repeat(100)).trim(), "go ".repeat(64).trim());
/// ```
#[cfg(feature = "talk")]
pub fn first_words(command: &str) -> &str {
    start_of_piece(command, WORDS_PER_COMMAND).and_then(|end| command.get(..end)).unwrap_or(command)
}

/// Where a word of [`for_each_piece`] begins in a command, in bytes. `None` where there are fewer words.
#[cfg(feature = "talk")]
pub(crate) fn start_of_piece(command: &str, position: usize) -> Option<usize> {
    Some(pieces(command).nth(position)?.as_ptr().addr().saturating_sub(command.as_ptr().addr()))
}

const fn pieces(command: &str) -> Pieces<'_> {
    Pieces { rest: command }
}

/// The pieces of a command, letter by letter: adapters of iterators would take a controller twice the flash.
struct Pieces<'c> {
    rest: &'c str,
}

impl<'c> Iterator for Pieces<'c> {
    type Item = &'c str;

    #[inline(never)]
    fn next(&mut self) -> Option<&'c str> {
        let (mut start, mut end, mut before, mut says) = (0_usize, 0_usize, Script::Spaced, false);
        for (at, letter) in self.rest.char_indices() {
            if is_apostrophe(letter) {
                // Those at both ends are not part of the word.
                continue;
            }
            #[cfg(feature = "marks")]
            let is_of_word = is_of_word(letter) || is_within_words(letter);
            #[cfg(not(feature = "marks"))]
            let is_of_word = is_of_word(letter);
            let now = Script::of(letter);
            if end > start && !(is_of_word && now.goes_on(before)) {
                if says {
                    let (command, after) = self.rest.split_at_checked(at)?;
                    self.rest = after;
                    return command.get(start..end);
                }
                end = start;
            }
            if is_of_word {
                if end <= start {
                    start = at;
                }
                (end, before) = (at.saturating_add(letter.len_utf8()), now);
                says |= is_alphanumeric(letter);
            }
        }
        let last = self.rest.get(start..end).filter(|_| says);
        self.rest = "";
        last
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

    pub const fn is_alphanumeric(letter: char) -> bool {
        letter.is_ascii_alphanumeric() || !(letter.is_ascii() || is_punctuation(letter))
    }

    /// The punctuation and the blanks of living scripts, beyond ASCII: no table of all characters.
    const fn is_punctuation(letter: char) -> bool {
        let of_europe = matches!(letter, '\u{80}'..='\u{a9}' | '\u{ab}'..='\u{b4}' | '\u{b6}'..='\u{b9}' | '\u{bb}'..='\u{bf}')
            || matches!(letter, '×' | '÷' | '\u{37e}' | '\u{387}' | '\u{55a}'..='\u{55f}' | '\u{589}'..='\u{58f}' | '\u{1680}')
            || matches!(letter, '\u{2000}'..='\u{206f}' | '\u{20a0}'..='\u{20cf}' | '\u{2190}'..='\u{245f}' | '\u{2500}'..='\u{2bff}');
        let of_asia = matches!(letter, '\u{5be}' | '\u{5c0}' | '\u{5c3}' | '\u{5c6}' | '\u{5f3}' | '\u{5f4}' | '\u{60c}' | '\u{60d}')
            || matches!(letter, '\u{61b}'..='\u{61f}' | '\u{66a}'..='\u{66d}' | '\u{6d4}' | '\u{700}'..='\u{70f}')
            || matches!(letter, '\u{964}' | '\u{965}' | '\u{970}' | '\u{df4}' | '\u{e4f}' | '\u{e5a}' | '\u{e5b}')
            || matches!(letter, '\u{f04}'..='\u{f14}' | '\u{f3a}'..='\u{f3d}' | '\u{104a}'..='\u{104f}' | '\u{1360}'..='\u{1368}')
            || matches!(letter, '\u{17d4}'..='\u{17da}' | '\u{1800}'..='\u{180a}' | '\u{2e00}'..='\u{2e5d}')
            || matches!(letter, '\u{3000}'..='\u{3004}' | '\u{3008}'..='\u{3020}' | '\u{3030}' | '\u{303d}' | '\u{30a0}' | '\u{30fb}')
            || matches!(letter, '\u{fe10}'..='\u{fe1f}' | '\u{fe30}'..='\u{fe6f}' | '\u{feff}' | '\u{ff00}'..='\u{ff0f}')
            || matches!(letter, '\u{ff1a}'..='\u{ff20}' | '\u{ff3b}'..='\u{ff40}' | '\u{ff5b}'..='\u{ff65}');
        of_europe || of_asia
    }

    pub fn to_lower_case(letter: char) -> impl Iterator<Item = char> {
        core::iter::once(letter.to_ascii_lowercase())
    }
}

const fn is_apostrophe(letter: char) -> bool {
    matches!(letter, '\'' | '’' | '‘')
}

/// Letters and digits, and other characters of words: apostrophes, and the marks of scripts that write vowels and accents by themselves.
fn is_of_word(letter: char) -> bool {
    if letter.is_ascii() {
        return letter.is_ascii_alphanumeric() || is_apostrophe(letter);
    }
    let is_mark = matches!(letter, '\u{300}'..='\u{36f}' | '\u{591}'..='\u{5c7}' | '\u{610}'..='\u{61a}' | '\u{64b}'..='\u{670}')
        || matches!(letter, '\u{900}'..='\u{963}' | '\u{966}'..='\u{ddf}' | '\u{e31}'..='\u{e4e}' | '\u{eb1}'..='\u{ecd}')
        || matches!(letter, '\u{f71}'..='\u{f84}' | '\u{102b}'..='\u{103e}' | '\u{17b4}'..='\u{17d3}' | '\u{200c}' | '\u{200d}');
    is_alphanumeric(letter) || is_apostrophe(letter) || is_mark
}

/// The beginning of a word, by which its forms are one word: `orange` and `orangey`. All of it where `letters` is 0.
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

/// A word in lower case, as it would be typed most shortly.
#[cfg(feature = "marks")]
fn composed_word(text: &str) -> Result<Word, CapacityError> {
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

/// A word in lower case. How letters are written otherwise takes tables.
#[cfg(not(feature = "marks"))]
fn composed_word(text: &str) -> Result<Word, CapacityError> {
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
