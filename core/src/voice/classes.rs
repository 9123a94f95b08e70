//! Closed classes of words, which speak about a command rather than in it. A table supplies them; they are not learned.

use crate::language::for_each_piece;
#[cfg(feature = "talk")]
use crate::language::is_slip;
use core::fmt;

/// Makes the classes, with their names in a table, from one list.
macro_rules! classes {
    ($($(#[$meta:meta])* $Class:ident = $name:literal,)*) => {
        /// A closed class of words.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u8)]
        pub enum Class {
            $($(#[$meta])* $Class,)*
        }

        impl Class {
            /// All classes, in order.
            pub const ALL: [Self; [$($name),*].len()] = [$(Self::$Class,)*];

            /// Its name in a table.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$Class => $name,)*
                }
            }
        }
    };
}

classes! {
    /// "not", "never", "except".
    Negation = "negation",
    /// "leave", "out", "away".
    Out = "out",
    /// "of", "from": after a word such as "out".
    From = "from",
    /// "but", "anywhere", "only".
    But = "but",
    /// "stop", "wait".
    Stop = "stop",
    /// "good", "well".
    Praise = "praise",
    /// "bad", "wrong".
    Blame = "blame",
    /// "yes", "okay".
    Yes = "yes",
    /// "no".
    No = "no",
    /// "again", "back", "undo".
    Again = "again",
    /// "and", "then".
    Connective = "connective",
    /// "or", "any": lets the robot choose.
    Or = "or",
    /// "all", "both", "everything".
    All = "all",
    /// "it", "there", "other".
    Pronoun = "pronoun",
    /// "hello", "thanks".
    Greeting = "greeting",
    /// "what", "is", "where".
    Asking = "asking",
    /// "please", "could you", "I want".
    Polite = "polite",
    /// "it": the thing of the last task.
    It = "it",
    /// "there": the place named last. If it is of the class `here` as well, such as "where" and "beside", it tells a place by a thing there.
    There = "there",
    /// "back": the place before the last task.
    Back = "back",
    /// "other", "another".
    Other = "other",
    /// "same", "too".
    Same = "same",
    /// "undo".
    Undo = "undo",
    /// "I", "she", "my": somebody else than the one addressed.
    Speaker = "speaker",
    /// "you": the one addressed.
    You = "you",
    /// "if", "tomorrow": what follows depends on something.
    If = "if",
    /// "to", "into", "towards": a direction, named by the words after it. Commands contain such words too.
    Toward = "toward",
    /// "le" in "apporte-le", "lo" in "llévalo": "it", joined to a verb. Elsewhere such a word is an article.
    Clitic = "clitic",
    /// "want": the speaker names a goal rather than an action.
    Wish = "wish",
    /// "meant": the speaker corrects the robot.
    Meant = "meant",
    /// "aller": an act word, and no slip for a word of another class, whatever its spelling. If it is of the class `out` as well, such as
    /// "leave", it leaves a thing in the named place. If it is of the class `if` as well, such as "forget", it takes back what was said
    /// before. If it is of the class `asking` as well, such as "have", it puts an act into the past.
    Act = "act",
    /// "here", "stay": the goal holds already, and its place needs no name.
    Here = "here",
}

impl Class {
    /// Whether an utterance of such words alone is no command.
    pub const fn is_talk(self) -> bool {
        matches!(self, Self::Stop | Self::Praise | Self::Blame | Self::Yes | Self::No | Self::Again | Self::Greeting | Self::Asking)
    }
}

/// The classes of a word, one bit each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Classes(u32);

impl Classes {
    /// No class.
    pub const NONE: Self = Self(0);

    /// One bit for each class, in their order.
    #[cfg(feature = "talk")]
    pub(crate) const fn bits(self) -> u32 {
        self.0
    }

    /// Whether the word is in a class.
    pub const fn contains(self, class: Class) -> bool {
        self.0 & (1 << class as u32) != 0
    }

    /// Whether the word is in one of these classes.
    pub fn contains_any(self, classes: &[Class]) -> bool {
        classes.iter().any(|&class| self.contains(class))
    }

    /// Whether it is a word such as "forget".
    pub const fn forgets(self) -> bool {
        self.contains(Class::Act) && self.contains(Class::If)
    }

    /// Whether it tells a place by a thing there, such as "where" and "beside".
    pub const fn is_beside(self) -> bool {
        self.contains(Class::There) && self.contains(Class::Here)
    }

    /// One class alone.
    pub const fn of(class: Class) -> Self {
        Self::NONE.with(class)
    }

    /// The classes without those of words that occur in commands themselves.
    pub const fn about_commands(self) -> Self {
        let of_commands = Self::of(Class::Toward).with(Class::Clitic).with(Class::Act);
        let of_commands = if self.is_beside() { of_commands.with(Class::There).with(Class::Here) } else { of_commands };
        Self(self.0 & !of_commands.0)
    }

    pub(crate) const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    #[cfg(feature = "talk")]
    pub(crate) const fn without(self, class: Class) -> Self {
        Self(self.0 & !Self::of(class).0)
    }

    pub(crate) const fn with(self, class: Class) -> Self {
        Self(self.0 | 1 << class as u32)
    }
}

/// A table of closed classes: each line has a class, a colon, and its words. A `#` begins a comment. A word may be in several classes, and
/// a class on several lines. No word may be in `praise` or `yes` and also in `blame` or `no`. A line such as `language: en` begins the
/// words of a language, which count if lessons were in it; `language:` alone begins words that always count.
///
/// ```
/// use goodbot::voice::{Class, ClosedWords};
/// let words = ClosedWords::new("negation: not don't never   # and more\nstop: stop wait")?;
/// assert!(words.of("never").contains(Class::Negation) && words.of("stop").contains(Class::Stop));
/// assert_eq!(ClosedWords::new("colour: red").unwrap_err().to_string(), "line 1: \"colour\" is no class of words");
/// # Ok::<(), goodbot::voice::ClosedWordsError<'static>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ClosedWords<'t> {
    text: &'t str,
    /// The languages of the table that are not spoken, in order: one bit each.
    silent: u32,
    /// What decides whether the robot acts on what was said.
    #[cfg(feature = "talk")]
    pub(crate) weights: crate::talk::Weights<'t>,
}

/// The word that begins the words of a language.
const LANGUAGE: &str = "language";

impl<'t> ClosedWords<'t> {
    /// No words.
    pub const NONE: Self = Self::of_text("");
    /// The words of English: 2.0 KB.
    pub const ENGLISH: ClosedWords<'static> = ClosedWords::of_text(include_str!("classes/english.txt"));
    /// The words of German: 2.4 KB.
    pub const GERMAN: ClosedWords<'static> = ClosedWords::of_text(include_str!("classes/german.txt"));
    /// The words of French: 1.9 KB.
    pub const FRENCH: ClosedWords<'static> = ClosedWords::of_text(include_str!("classes/french.txt"));
    /// The words of Spanish: 1.8 KB.
    pub const SPANISH: ClosedWords<'static> = ClosedWords::of_text(include_str!("classes/spanish.txt"));
    /// The words of Chinese: 1.9 KB.
    pub const CHINESE: ClosedWords<'static> = ClosedWords::of_text(include_str!("classes/chinese.txt"));
    /// The words of all five languages.
    pub const ALL: ClosedWords<'static> = ClosedWords::of_text(concat!(
        include_str!("classes/english.txt"),
        include_str!("classes/german.txt"),
        include_str!("classes/french.txt"),
        include_str!("classes/spanish.txt"),
        include_str!("classes/chinese.txt")
    ));

    const fn of_text(text: &'t str) -> Self {
        Self {
            text,
            silent: 0,
            #[cfg(feature = "talk")]
            weights: crate::talk::Weights::BUILT_IN,
        }
    }

    /// The same words, with other [weights](crate::talk::Weights) to decide whether the robot acts.
    #[cfg(feature = "talk")]
    #[must_use]
    pub const fn weighed(self, weights: crate::talk::Weights<'t>) -> Self {
        Self { weights, ..self }
    }

    /// Reads the table from a text.
    ///
    /// # Errors
    /// A [`ClosedWordsError`] for the first line that is wrong.
    pub fn new(text: &'t str) -> Result<Self, ClosedWordsError<'t>> {
        let table = Self::of_text(text);
        let opposites = table.marks(&[Class::Blame, Class::No]);
        for (line, content) in lines(text).enumerate() {
            let line = line.saturating_add(1);
            let Some(Line { name, words }) = parted(content) else {
                match content.split_ascii_whitespace().next() {
                    None => continue,
                    Some(word) => return Err(ClosedWordsError::NoClass { word, line }),
                }
            };
            if name == LANGUAGE {
                continue;
            }
            let Some(class) = named(name) else {
                return Err(ClosedWordsError::NoSuchClass { name, line });
            };
            let is_for = matches!(class, Class::Praise | Class::Yes);
            for word in words.split_ascii_whitespace() {
                if !is_piece(word) {
                    return Err(ClosedWordsError::NotAWord { word, line });
                }
                // Such a word would make the trainer's praise punish the robot.
                if is_for && opposites.may_have(word) && table.of(word).contains_any(&[Class::Blame, Class::No]) {
                    return Err(ClosedWordsError::Opposites { word, line });
                }
            }
        }
        Ok(table)
    }

    /// Marks of all words of these classes.
    fn marks(self, classes: &[Class]) -> Marks {
        let mut marks = Marks([0; 64]);
        for line in self.lines().filter(|line| classes.iter().any(|class| class.name() == line.name)) {
            line.words().for_each(|word| marks.add(word));
        }
        marks
    }

    fn lines(self) -> impl Iterator<Item = Line<'t>> {
        self.lines_of_languages().filter_map(move |(language, line)| (self.silent & language == 0).then_some(line))
    }

    /// The lines of all languages, also of those that are not spoken, with the bit of each.
    fn lines_of_languages(self) -> impl Iterator<Item = (u32, Line<'t>)> {
        let mut languages = Languages::START;
        lines(self.text).filter_map(move |line| Some((languages.now, languages.pass(parted(line)?)?)))
    }

    /// The lines that have a word which begins with these bytes, and perhaps others. A table is long and has few such lines, so they are
    /// looked for by bytes, and only they are read.
    fn lines_with<'b>(self, front: &'b [u8]) -> impl Iterator<Item = Line<'t>> + use<'t, 'b> {
        lines_with(self.text, front)
            .filter(move |&(start, line)| line.name != LANGUAGE && (self.silent == 0 || self.silent & self.language_at(start) == 0))
            .map(|(_, line)| line)
    }

    /// The bit of the language of a line.
    fn language_at(self, start: usize) -> u32 {
        let mut languages = Languages::START;
        for (_, line) in lines_with(self.text.get(..start).unwrap_or(""), LANGUAGE.as_bytes()) {
            languages.pass(line);
        }
        languages.now
    }

    /// The classes of a word, as [`for_each_piece`] passes it.
    pub fn of(self, word: &str) -> Classes {
        let mut classes = Classes::NONE;
        for line in self.lines_with(word.as_bytes()).filter(|line| line.words().any(|other| other == word)) {
            classes = classes.and(line.classes());
        }
        classes
    }

    /// The number of words of a class.
    pub fn count(self, class: Class) -> usize {
        self.lines().filter(|line| line.name == class.name()).map(|line| line.words().count()).sum()
    }

    /// Whether there are no words.
    pub fn is_empty(self) -> bool {
        self.lines().next().is_none()
    }
}

#[cfg(feature = "talk")]
impl ClosedWords<'_> {
    /// The words of the languages that the lessons were probably in: those that have more than half as many known words as any other. Words
    /// before the first language, and after an unnamed one, belong to all. "Sal" means to go out in Spanish, and resembles a French room.
    pub(crate) fn spoken(self, knows: &dyn Fn(&str) -> bool) -> Self {
        let mut known = [0_u16; u32::BITS as usize];
        for (language, line) in self.lines_of_languages() {
            let count = line.words().filter(|word| knows(word)).count() as u16;
            known.iter_mut().skip(language.trailing_zeros() as usize).take(1).for_each(|known| *known = known.saturating_add(count));
        }
        let most = known.iter().skip(1).copied().max().unwrap_or(0);
        let is_silent = |(at, &count): (usize, &u16)| u32::from(at > 0 && count < most && count <= most / 2) << at;
        Self { silent: known.iter().enumerate().map(is_silent).fold(0, |all, bit| all | bit), ..self }
    }

    /// The number of signs of the longest word at the front of these signs, and its classes. Scripts without spaces are heard sign by sign.
    pub(crate) fn of_signs(self, signs: &[Option<char>]) -> Option<(usize, Classes)> {
        let (first, mut bytes) = (signs.first().copied().flatten()?, [0; 4]);
        let begins = |word: &str| word.chars().zip(signs).filter(|&(letter, &sign)| sign == Some(letter)).count() == word.chars().count();
        let (mut most, mut classes) = (1, Classes::NONE);
        for line in self.lines_with(first.encode_utf8(&mut bytes).as_bytes()) {
            for length in line.words().filter(|word| begins(word)).map(|word| word.chars().count()) {
                if length > most {
                    (most, classes) = (length, Classes::NONE);
                }
                if length == most {
                    classes = classes.and(line.classes());
                }
            }
        }
        (most > 1).then_some((most, classes))
    }

    /// The classes of the cues (negation, out, all, connective) that this word is a slip for.
    pub(crate) fn of_slip(self, word: &str) -> Classes {
        let mut classes = Classes::NONE;
        let cues = [Class::Negation, Class::Out, Class::All, Class::Connective];
        for line in self.lines().filter(|line| cues.iter().any(|cue| cue.name() == line.name)) {
            // Slips in the first letter are rare.
            let is_slip_for = |other: &str| word.chars().next() == other.chars().next() && is_slip(word, other);
            if line.words().any(is_slip_for) {
                classes = classes.and(line.classes());
            }
        }
        classes
    }

    /// The front of a word that ends with a word of this class, for each such word.
    pub(crate) fn ends(self, class: Class, word: &str) -> impl Iterator<Item = &str> {
        self.lines().filter(move |line| line.name == class.name()).flat_map(Line::words).filter_map(move |end| word.strip_suffix(end))
    }
}

/// The table as in its file.
impl fmt::Display for ClosedWords<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.text)
    }
}

/// A line of a table.
#[derive(Clone, Copy)]
struct Line<'t> {
    /// The name of its class.
    name: &'t str,
    words: &'t str,
}

impl<'t> Line<'t> {
    fn words(self) -> core::str::SplitAsciiWhitespace<'t> {
        self.words.split_ascii_whitespace()
    }

    /// Its class alone. Most lookups need the class of few lines, so it is not read with the line.
    fn classes(self) -> Classes {
        named(self.name).map_or(Classes::NONE, Classes::of)
    }
}

/// Which language the lines of a table are in, from the first line on.
struct Languages {
    last: u32,
    now: u32,
}

impl Languages {
    /// Before the first line.
    const START: Self = Self { last: 1, now: 1 };

    /// The line, if it has a class.
    fn pass<'t>(&mut self, line: Line<'t>) -> Option<Line<'t>> {
        if line.name != LANGUAGE {
            return Some(line);
        }
        let is_named = line.words().next().is_some();
        self.last = if is_named { self.last.rotate_left(1) } else { self.last };
        self.now = if is_named { self.last } else { 1 };
        None
    }
}

/// A set of words that may have others as well.
struct Marks([u32; 64]);

impl Marks {
    /// The place of a word's mark, and its bit.
    fn place(word: &str) -> (usize, u32) {
        let mark = word.bytes().fold(0_u32, |mark, byte| mark.wrapping_mul(31).wrapping_add(u32::from(byte)));
        (mark as usize / 32 % 64, 1 << (mark % 32))
    }

    fn add(&mut self, word: &str) {
        let (at, bit) = Self::place(word);
        self.0.iter_mut().skip(at).take(1).for_each(|marks| *marks |= bit);
    }

    fn may_have(&self, word: &str) -> bool {
        let (at, bit) = Self::place(word);
        self.0.get(at).is_some_and(|marks| marks & bit != 0)
    }
}

/// Whether a word of a table is in the form in which words are heard. In a script without spaces it has several signs.
fn is_piece(word: &str) -> bool {
    // Most words are; to take them to pieces would take ten times as long.
    if word.len() <= SHORT_WORD && word.bytes().all(|byte| byte.is_ascii_lowercase()) {
        return true;
    }
    let mut rest = Some(word);
    let heard = for_each_piece(word, |piece| {
        rest = rest.and_then(|rest| rest.strip_prefix(piece));
        Ok(())
    });
    heard.is_ok() && rest == Some("")
}

/// No word of so many bytes is too long to be heard.
const SHORT_WORD: usize = 24;

/// The class with this name.
fn named(name: &str) -> Option<Class> {
    Class::ALL.into_iter().find(|class| class.name() == name)
}

/// The text before a sign of ASCII, and the text after it, if it has that sign. Bytes are compared: a table is read for each word that is
/// heard, and the search of `core` would link code that can panic.
pub(crate) fn cut(text: &str, sign: u8) -> (&str, Option<&str>) {
    let Some(end) = text.bytes().position(|byte| byte == sign) else { return (text, None) };
    (text.get(..end).unwrap_or(""), text.get(end.saturating_add(1)..))
}

/// The lines of a table, without comments.
fn lines(text: &str) -> impl Iterator<Item = &str> {
    let mut rest = Some(text);
    core::iter::from_fn(move || {
        let (line, after) = cut(rest?, b'\n');
        rest = after;
        Some(cut(line, b'#').0)
    })
}

/// A line with a class, or with a language.
fn parted(line: &str) -> Option<Line<'_>> {
    let (name, words) = cut(line, b':');
    Some(Line { name: name.trim_ascii(), words: words? })
}

/// The lines with a word or a name that begins with these bytes, and perhaps others, and where each begins.
fn lines_with<'t, 'b>(text: &'t str, front: &'b [u8]) -> impl Iterator<Item = (usize, Line<'t>)> + use<'t, 'b> {
    let mut from = 0;
    core::iter::from_fn(move || {
        loop {
            let found = front_of_word(text.as_bytes(), from, front)?;
            let start = text.as_bytes().get(..found)?.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end.saturating_add(1));
            let (line, after) = cut(text.get(start..)?, b'\n');
            from = text.len().saturating_sub(after.map_or(0, str::len));
            if let Some(line) = parted(cut(line, b'#').0) {
                return Some((start, line));
            }
        }
    })
}

/// Where a word begins with these bytes, from a place on.
fn front_of_word(text: &[u8], mut from: usize, front: &[u8]) -> Option<usize> {
    let (&first, others) = front.split_first()?;
    loop {
        let at = from.saturating_add(text.get(from..)?.iter().position(|&byte| byte == first)?);
        let is_begin = at.checked_sub(1).and_then(|before| text.get(before)).is_none_or(|&byte| byte == b':' || byte.is_ascii_whitespace());
        from = at.saturating_add(1);
        if is_begin && text.get(from..)?.starts_with(others) {
            return Some(at);
        }
    }
}

/// Why a text is no table of closed classes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ClosedWordsError<'t> {
    /// There is no class with this name.
    #[error("line {line}: {name:?} is no class of words")]
    NoSuchClass {
        /// The name.
        name: &'t str,
        /// Its line, from 1.
        line: usize,
    },
    /// A line has no class before its words.
    #[error("line {line}: write a class and a colon before {word:?}")]
    NoClass {
        /// Its first word.
        word: &'t str,
        /// The line, from 1.
        line: usize,
    },
    /// A word is not in the form in which commands are heard: in lower case, without punctuation.
    #[error("line {line}: write {word:?} in lower case and without punctuation")]
    NotAWord {
        /// The word.
        word: &'t str,
        /// Its line, from 1.
        line: usize,
    },
    /// A word is praise or a yes, and also blame or a no.
    #[error("line {line}: {word:?} praises or agrees, and another line has it for the opposite; leave it in one of them")]
    Opposites {
        /// The word.
        word: &'t str,
        /// The line where it is praise or a yes, from 1.
        line: usize,
    },
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::{String, ToString};
    use std::vec::Vec;

    #[test]
    fn the_languages_that_no_lesson_was_in_are_silent() {
        let table = ClosedWords::new("no: nope\nlanguage: one\ntoward: to into\nlanguage: two\nout: sal\ntoward: a").unwrap();
        let of_one = table.spoken(&|word| ["to", "into", "a"].contains(&word));
        assert!(of_one.of("into").contains(Class::Toward) && of_one.of("nope").contains(Class::No));
        assert_eq!(of_one.of("sal"), Classes::NONE);
        assert!(table.spoken(&|word| word == "zonk").of("sal").contains(Class::Out), "no language is known");
    }

    #[test]
    fn words_after_a_language_without_a_name_are_of_all_languages() {
        let table =
            ClosedWords::new("language: one\ntoward: to into\nlanguage: two\nout: sal\nlanguage:\nno: nope\nlanguage: three\nno: nix")
                .unwrap();
        let of_one = table.spoken(&|word| word == "to");
        assert!(of_one.of("nope").contains(Class::No) && of_one.of("into").contains(Class::Toward));
        assert_eq!((of_one.of("sal"), of_one.of("nix")), (Classes::NONE, Classes::NONE));
    }

    #[test]
    fn a_word_that_is_for_the_robot_and_against_it_is_refused_with_its_line() {
        let error = ClosedWords::new("yes: yeah ok\n\nno: nope ok").unwrap_err();
        assert_eq!(error, ClosedWordsError::Opposites { word: "ok", line: 1 });
        assert_eq!(
            error.to_string(),
            "line 1: \"ok\" praises or agrees, and another line has it for the opposite; leave it in one of them"
        );
        for text in ["praise: well so\nblame: so", "praise: fine\nno: fine", "yes: right\nblame: right"] {
            assert!(matches!(ClosedWords::new(text), Err(ClosedWordsError::Opposites { line: 1, .. })), "{text}");
        }
    }

    #[test]
    fn other_words_may_be_in_two_classes_and_those_that_are_built_in_are_no_opposites() {
        assert!(ClosedWords::new("connective: after\npolite: after\nno: no\nnegation: no\nyes: ok\nyes: ok").is_ok());
        let all = ClosedWords::ALL.to_string();
        assert_eq!(ClosedWords::new(&all), Ok(ClosedWords::of_text(&all)));
    }

    /// The lookups as the table says them: line by line, and word by word.
    struct Plain<'t>(Vec<(Classes, Vec<&'t str>)>);

    impl<'t> Plain<'t> {
        fn new(table: ClosedWords<'t>) -> Self {
            let (mut last, mut language, mut lines) = (1_u32, 1_u32, Vec::new());
            for line in table.text.lines() {
                let Some((name, words)) = line.split('#').next().and_then(|line| line.split_once(':')) else { continue };
                if name.trim() == LANGUAGE {
                    last = if words.trim().is_empty() { last } else { last.rotate_left(1) };
                    language = if words.trim().is_empty() { 1 } else { last };
                } else if table.silent & language == 0 {
                    lines.push((Classes::of(named(name.trim()).unwrap()), words.split_whitespace().collect()));
                }
            }
            Self(lines)
        }

        fn of_lines(&self, has: impl Fn(&Classes, &[&str]) -> bool) -> Classes {
            let lines = self.0.iter().filter(|(classes, words)| has(classes, words));
            lines.fold(Classes::NONE, |all, (classes, _)| all.and(*classes))
        }

        fn of(&self, word: &str) -> Classes {
            self.of_lines(|_, words| words.contains(&word))
        }

        fn of_signs(&self, signs: &[Option<char>]) -> Option<(usize, Classes)> {
            let length = |word: &str| word.chars().count();
            let begins = |word: &str| word.chars().enumerate().all(|(at, letter)| signs.get(at) == Some(&Some(letter)));
            let words = self.0.iter().flat_map(|(_, words)| words);
            let most = words.filter(|word| begins(word)).map(|word| length(word)).max().filter(|&most| most > 1)?;
            Some((most, self.of_lines(|_, words| words.iter().any(|word| begins(word) && length(word) == most))))
        }

        fn of_slip(&self, word: &str) -> Classes {
            let cues = [Class::Negation, Class::Out, Class::All, Class::Connective];
            let is_slip_for = |other: &&str| word.chars().next() == other.chars().next() && is_slip(word, other);
            self.of_lines(|classes, words| classes.contains_any(&cues) && words.iter().any(is_slip_for))
        }
    }

    /// A word, without each letter, with each letter doubled, and with neighbours exchanged.
    fn misspelt(word: &str) -> Vec<String> {
        let letters: Vec<char> = word.chars().collect();
        let mut all = Vec::from([word.to_string()]);
        for at in 0..letters.len() {
            let (before, after) = (&letters[..at], &letters[at + 1..]);
            all.push([before, after].concat().into_iter().collect());
            all.push([before, &[letters[at]; 2], after].concat().into_iter().collect());
            if let [next, rest @ ..] = after {
                all.push([before, &[*next, letters[at]], rest].concat().into_iter().collect());
            }
        }
        all
    }

    #[test]
    fn each_word_of_the_tables_and_each_misspelt_one_has_the_classes_that_its_lines_say() {
        let comments = "# no: stop\n\tstop :halt  stop# wait\r\nlanguage: one #\n no:stop\n\nlanguage:\nall: st sto\x0cstop";
        let own = ClosedWords::new(comments).unwrap();
        for table in [ClosedWords::ALL, ClosedWords::ENGLISH, ClosedWords::NONE, own] {
            for silent in [0, 0b10, 0b11100, 0b110, 1] {
                let table = ClosedWords { silent, ..table };
                let plain = Plain::new(table);
                let words = Plain::new(ClosedWords { silent: 0, ..table }).0.into_iter().flat_map(|(_, words)| words);
                for (at, word) in words.chain(["", " ", "stop halt", "no:", "language", "#", "é"]).enumerate() {
                    // To misspell all would take long.
                    for word in misspelt(word).into_iter().take(if at % 9 == 0 { usize::MAX } else { 1 }) {
                        assert_eq!(table.of(&word), plain.of(&word), "{word} {silent}");
                        assert_eq!(table.of_slip(&word), plain.of_slip(&word), "{word} {silent}");
                        let signs: Vec<_> = word.chars().chain("的".chars()).map(Some).chain([None]).collect();
                        assert_eq!(table.of_signs(&signs), plain.of_signs(&signs), "{word} {silent}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_word_of_any_form_is_a_piece_if_it_is_heard_as_it_is_written() {
        for word in ["stop", "o'clock", "don't", "nächste", "停下", "a", "3"] {
            assert!(is_piece(word), "{word}");
        }
        for word in ["Stop", "stop!", "two-fold", "'s", "…", &"a".repeat(65)] {
            assert!(!is_piece(word), "{word}");
        }
    }
}
