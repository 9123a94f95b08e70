//! A world from PDDL, the planning field's language: from a domain and a problem with typing, STRIPS, negative preconditions, equality and
//! action costs. All else is refused by its name, with the text and the line.
//!
//! - `reading` makes a domain and a problem of lists and words in brackets; `names` checks that each name is known
//!   and that each object has the right type, and finds the classes.
//! - `sweep` visits all states that the problem can reach. Few actions are left that way: a robot is in one room, so a move needs only its
//!   goal, and an action leaves out each parameter that the others settle.
//! - `writing` makes the world file.

mod names;
mod reading;
mod sweep;
mod writing;

use goodbot_formats::world::WorldFile;
use std::fmt;

/// The text in which a fault is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Text {
    /// The domain.
    Domain,
    /// The problem.
    Problem,
}

impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Domain => "domain",
            Self::Problem => "problem",
        })
    }
}

/// A fault of a domain or a problem.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line} of the {text}: {message}")]
pub struct PddlError {
    /// The text at fault.
    pub text: Text,
    /// The line, counted from 1.
    pub line: usize,
    /// The fault, and the remedy.
    pub message: String,
}

/// A world of a problem.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Converted {
    /// The world.
    pub world: WorldFile,
    /// What a user may not expect, such as a goal that no plan reaches.
    pub warnings: Vec<String>,
}

/// The world of a domain and a problem.
///
/// ```
/// use goodbot_lesson::world::{pddl, robot};
/// let domain = "(define (domain lamps) (:predicates (on ?l) (off ?l))
///     (:action light :parameters (?l) :precondition (off ?l) :effect (and (on ?l) (not (off ?l)))))";
/// let problem = "(define (problem two) (:domain lamps) (:objects a b) (:init (off a) (off b)) (:goal (and (on a) (on b))))";
/// let world = pddl::convert(domain, problem)?.world;
/// assert_eq!(robot::plan(&world, &"on(a) & on(b)".parse()?)?.map(|plan| plan.len()), Some(2));
/// let when = domain.replace("(and (on ?l)", "(when (on ?l)");
/// assert_eq!(pddl::convert(&when, problem).unwrap_err().to_string(),
///     "line 2 of the domain: \"when\" is not understood: conditional effects are beyond STRIPS; write an action for each case");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The first part that is not understood, contradicts itself, or that a world file cannot express.
pub fn convert(domain: &str, problem: &str) -> Result<Converted, PddlError> {
    convert_in_steps(domain, problem, |_| {})
}

/// As [`convert`]. `visited` is called for each state of the problem that is looked at, the longest part of the work, with their number so far.
///
/// # Errors
/// As [`convert`].
pub fn convert_in_steps(domain: &str, problem: &str, visited: impl FnMut(usize)) -> Result<Converted, PddlError> {
    let in_domain = |fault: Fault| fault.of(Text::Domain);
    let in_problem = |fault: Fault| fault.of(Text::Problem);
    let domain = reading::Domain::parse(domain).map_err(in_domain)?;
    let problem = reading::Problem::parse(problem).map_err(in_problem)?;
    let named = names::Named::of(&domain, &problem);
    named.check_domain().map_err(in_domain)?;
    named.check_problem().map_err(in_problem)?;
    let swept = sweep::sweep(&named, visited)?;
    writing::convert(&named, &swept)
}

/// The most lists inside one another.
const DEEPEST: usize = 64;

/// A word or a list, with its line.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Expression {
    /// A word, in small letters.
    Word(String, usize),
    /// A list.
    List(Vec<Expression>, usize),
}

/// The fault of a text, and its line.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Fault {
    line: usize,
    message: String,
}

impl Fault {
    /// The fault, told of its text.
    pub fn of(self, text: Text) -> PddlError {
        PddlError { text, line: self.line, message: self.message }
    }
}

fn error<T>(line: usize, message: impl Into<String>) -> Result<T, Fault> {
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
