//! A world from PDDL, the planning field's language: from a domain and a problem with typing, STRIPS, negative preconditions, equality and
//! action costs. All else is refused by its name, with the text and the line.
//!
//! - `expression` reads lists and words in brackets; `reading` makes a domain and a problem of them; `names` checks that each name is known
//!   and that each object has the right type, and finds the classes.
//! - `sweep` visits all states that the problem can reach. Few actions are left that way: a robot is in one room, so a move needs only its
//!   goal, and an action leaves out each parameter that the others settle.
//! - `writing` makes the world file.

mod expression;
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
    let in_domain = |fault: expression::Fault| fault.of(Text::Domain);
    let in_problem = |fault: expression::Fault| fault.of(Text::Problem);
    let domain = reading::Domain::parse(domain).map_err(in_domain)?;
    let problem = reading::Problem::parse(problem).map_err(in_problem)?;
    let named = names::Named::of(&domain, &problem);
    named.check_domain().map_err(in_domain)?;
    named.check_problem().map_err(in_problem)?;
    let swept = sweep::sweep(&named, visited)?;
    writing::convert(&named, &swept)
}
