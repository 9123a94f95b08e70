//! PDDL, the planning field's language: a domain and a problem with typing, STRIPS, negative preconditions, equality and action costs.
//!
//! - `expression`: lists and words in brackets; the rest reads what they say.
//!
//! ```
//! use goodbot_formats::pddl::{Domain, Problem};
//! let domain = Domain::parse("(define (domain lamps) (:predicates (on ?l)) (:action light :parameters (?l) :effect (on ?l)))")?;
//! let problem = Problem::parse("(define (problem two) (:domain lamps) (:objects a b) (:init) (:goal (on b)))")?;
//! assert_eq!((domain.actions[0].adds[0].to_string(), problem.goal[0].to_string()), ("(on ?l)".to_owned(), "(on b)".to_owned()));
//! assert_eq!(Domain::parse("(define (domain d)\n(:action a :effect (when (p) (q))))").unwrap_err().to_string(),
//!     "line 2: \"when\" is not understood: conditional effects are beyond STRIPS; write an action for each case");
//! # Ok::<(), goodbot_formats::pddl::PddlError>(())
//! ```

mod expression;
mod reading;

use std::fmt;

/// What is wrong with a text, and where.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {message}")]
pub struct PddlError {
    /// The line, counted from 1.
    pub line: usize,
    /// What is wrong, and what to do.
    pub message: String,
}

/// A name with its type; `object` where it has none.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Typed {
    /// The name; that of a variable begins with `?`.
    pub name: String,
    /// The type.
    pub kind: String,
}

/// A predicate of terms.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Atom {
    /// The predicate.
    pub predicate: String,
    /// Objects, and variables with their `?`.
    pub terms: Vec<String>,
}

impl fmt::Display for Atom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({}", self.predicate)?;
        self.terms.iter().try_for_each(|term| write!(f, " {term}"))?;
        f.write_str(")")
    }
}

/// What an action costs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Cost {
    /// A number; 1 by default.
    Of(u64),
    /// What the problem says of these objects.
    Told(Atom),
}

/// An action.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Schema {
    /// Its name.
    pub name: String,
    /// The line on which it begins.
    pub line: usize,
    /// Its parameters.
    pub parameters: Vec<Typed>,
    /// What must hold, and what must not where that is false.
    pub conditions: Vec<(Atom, bool)>,
    /// Terms that must be the same, and those that must not where that is false.
    pub equal: Vec<(String, String, bool)>,
    /// What holds after it.
    pub adds: Vec<Atom>,
    /// What does not, unless it is added.
    pub deletes: Vec<Atom>,
    /// What it adds to `total-cost`; nothing where it says nothing.
    pub cost: Option<Cost>,
}

/// A domain.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Domain {
    /// Its name.
    pub name: String,
    /// The types, each with the one above it.
    pub types: Vec<Typed>,
    /// Objects of every problem.
    pub constants: Vec<Typed>,
    /// The predicates, each with its parameters.
    pub predicates: Vec<(String, Vec<Typed>)>,
    /// The actions.
    pub actions: Vec<Schema>,
}

/// A problem.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Problem {
    /// Its name.
    pub name: String,
    /// The name of its domain; empty where it names none.
    pub domain: String,
    /// The objects.
    pub objects: Vec<Typed>,
    /// What holds at first.
    pub init: Vec<Atom>,
    /// What is said of numbers.
    pub values: Vec<(Atom, u64)>,
    /// What is to hold.
    pub goal: Vec<Atom>,
    /// Whether the plan with the least `total-cost` is best, and not the shortest.
    pub minimizes_cost: bool,
}
