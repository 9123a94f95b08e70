//! Commands with more words than a robot reads: it reads the first words, and a remark counts the words of each.

use goodbot::capacity::{Capacity, CapacityError, WORDS_PER_COMMAND};
use goodbot::language::{Model, first_words, for_each_piece};
use std::fmt;

/// A command as it is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FirstWords<'c> {
    /// The words that are read.
    pub words: &'c str,
    /// How many words the command has, read or not.
    pub count: usize,
}

/// A command has more words than are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Long {
    /// How many words it has.
    pub count: usize,
}

impl Long {
    /// How many of them are not read.
    pub const fn unread(self) -> usize {
        self.count.saturating_sub(WORDS_PER_COMMAND)
    }
}

impl fmt::Display for Long {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "has {} words; its first {WORDS_PER_COMMAND} are read", self.count)
    }
}

impl FirstWords<'_> {
    /// The command's length, if only its first words are read.
    pub fn long(&self) -> Option<Long> {
        (self.count > WORDS_PER_COMMAND).then_some(Long { count: self.count })
    }
}

/// Reads a command: all of it, or its first words.
///
/// ```
/// use goodbot_lesson::first_words::read;
/// let long = "go ".repeat(65);
/// let read = read(&long)?;
/// assert_eq!((read.words, read.count), ("go ".repeat(64).trim_end(), 65));
/// assert_eq!(read.long().unwrap().to_string(), "has 65 words; its first 64 are read");
/// # Ok::<(), goodbot::capacity::CapacityError>(())
/// ```
///
/// # Errors
/// A [`CapacityError`] if one of the read words is too long.
pub fn read(command: &str) -> Result<FirstWords<'_>, CapacityError> {
    let mut count = 0;
    let mut counted = |words: &str| {
        for_each_piece(words, |_| {
            count += 1;
            Ok(())
        })
    };
    match counted(command) {
        Err(CapacityError { capacity: Capacity::WordsPerCommand, given, .. }) => {
            let words = first_words(command).trim_end();
            counted(words)?;
            Ok(FirstWords { words, count: given as usize })
        }
        Err(error) => Err(error),
        Ok(()) => Ok(FirstWords { words: command, count }),
    }
}

/// The fault of a command that [`read`] refuses, in words.
pub fn too_long(error: CapacityError) -> String {
    format!("has a word of more than {} bytes; shorten it", error.limit)
}

/// The words of a command in order, as a model reads them.
///
/// ```
/// use goodbot::language::Model;
/// assert_eq!(goodbot_lesson::first_words::heard(Model::Roles, "Go to the RED room!")?, ["go", "to", "the", "red", "room"]);
/// # Ok::<(), goodbot::capacity::CapacityError>(())
/// ```
///
/// # Errors
/// A [`CapacityError`] if there are too many words, or one is too long.
pub fn heard(model: Model, command: &str) -> Result<Vec<String>, CapacityError> {
    let mut words = Vec::new();
    model.for_each_word(command, |word| {
        words.push(word.to_owned());
        Ok(())
    })?;
    Ok(words)
}

/// The words of a text that are read. A text that [`read`] refuses is returned whole, and refused later when the robot hears it.
pub fn words_read(text: &str) -> &str {
    read(text).map_or(text, |read| read.words)
}

/// The remark that only the first words of this many commands are read.
pub fn told(count: usize) -> String {
    match count {
        1 => format!("1 command has more than {WORDS_PER_COMMAND} words; its first {WORDS_PER_COMMAND} are read"),
        _ => format!("{count} commands have more than {WORDS_PER_COMMAND} words; their first {WORDS_PER_COMMAND} are read"),
    }
}
