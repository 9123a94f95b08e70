//! Words, and lists in brackets.

use super::{PddlError, Text};

/// The most lists inside one another.
const DEEPEST: usize = 64;

/// A word or a list, with its line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Expression {
    /// A word, in small letters.
    Word(String, usize),
    /// A list.
    List(Vec<Expression>, usize),
}

/// The fault of a text, and its line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    line: usize,
    message: String,
}

impl Fault {
    /// The fault, told of its text.
    pub fn of(self, text: Text) -> PddlError {
        PddlError { text, line: self.line, message: self.message }
    }
}

pub fn error<T>(line: usize, message: impl Into<String>) -> Result<T, Fault> {
    Err(Fault { line, message: message.into() })
}

impl Expression {
    /// The only list of a text.
    pub fn parse(text: &str) -> Result<Self, Fault> {
        // The lists that are open, the outermost first.
        let mut open: Vec<(Vec<Self>, usize)> = Vec::new();
        let mut whole = None;
        // Some editors begin a file with a byte-order mark, and some domains write no blank before a variable: `(at?room)`.
        for (line, number) in text.trim_start_matches('\u{feff}').lines().zip(1..) {
            let line = line.split(';').next().unwrap_or("");
            let spaced = line.replace('(', " ( ").replace(')', " ) ").replace('?', " ?");
            for token in spaced.split_whitespace() {
                if whole.is_some() {
                    return error(number, "is after the end: write one definition in each file");
                }
                match token {
                    "(" if open.len() >= DEEPEST => return error(number, format!("has more than {DEEPEST} open brackets; close some")),
                    "(" => open.push((vec![], number)),
                    ")" => {
                        let Some((items, begin)) = open.pop() else {
                            return error(number, "closes a bracket that is not open; leave it out");
                        };
                        let list = Self::List(items, begin);
                        match open.last_mut() {
                            Some((around, _)) => around.push(list),
                            None => whole = Some(list),
                        }
                    }
                    word => match open.last_mut() {
                        Some((around, _)) => around.push(Self::Word(word.to_lowercase(), number)),
                        None => return error(number, format!("{word:?} is in no brackets; begin with (define")),
                    },
                }
            }
        }
        match (whole, open.last()) {
            (Some(whole), _) => Ok(whole),
            (None, Some((_, begin))) => error(*begin, "opens a bracket that is not closed; close it"),
            (None, None) => error(1, "has no text; begin with (define"),
        }
    }

    pub fn line(&self) -> usize {
        let (Self::Word(_, line) | Self::List(_, line)) = self;
        *line
    }

    /// The word.
    pub fn word(&self) -> Result<&str, Fault> {
        match self {
            Self::Word(word, _) => Ok(word),
            Self::List(_, line) => error(*line, "is a list where a word belongs"),
        }
    }

    /// The items of the list.
    pub fn list(&self) -> Result<&[Self], Fault> {
        match self {
            Self::List(items, _) => Ok(items),
            Self::Word(word, line) => error(*line, format!("{word:?} is a word where a list belongs; write it in brackets")),
        }
    }

    /// The first word of a list, and the rest of the list.
    pub fn headed(&self) -> Result<(&str, &[Self]), Fault> {
        match self.list()?.split_first() {
            Some((head, rest)) => Ok((head.word()?, rest)),
            None => error(self.line(), "is an empty list; leave it out"),
        }
    }
}
