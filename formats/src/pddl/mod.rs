//! PDDL, the planning field's language: a domain and a problem with typing, STRIPS, negative preconditions, equality and action costs.
//!
//! - `expression`: lists and words in brackets; `reading` interprets them.
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

/// The fault of a text, and its line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {message}")]
pub struct PddlError {
    /// The line, counted from 1.
    pub line: usize,
    /// The fault, and the remedy.
    pub message: String,
}

/// A name with its type; without a type, `object`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Typed {
    /// The name; that of a variable begins with `?`.
    pub name: String,
    /// The type.
    pub kind: String,
}

/// A predicate with its terms.
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

/// The cost of an action.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Cost {
    /// A number; 1 by default.
    Of(u64),
    /// The value that the problem gives for these objects.
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
    /// Propositions that must hold (`true`) or must not hold (`false`).
    pub conditions: Vec<(Atom, bool)>,
    /// Pairs of terms that must be equal (`true`) or must differ (`false`).
    pub equal: Vec<(String, String, bool)>,
    /// The propositions that hold after it.
    pub adds: Vec<Atom>,
    /// The propositions that no longer hold after it, unless they are added.
    pub deletes: Vec<Atom>,
    /// Its increase of `total-cost`, if it has one.
    pub cost: Option<Cost>,
}

/// A domain.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Domain {
    /// Its name.
    pub name: String,
    /// The types, each with the one above it.
    pub types: Vec<Typed>,
    /// Objects that every problem has.
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
    /// The name of its domain; empty if it names none.
    pub domain: String,
    /// The objects.
    pub objects: Vec<Typed>,
    /// The propositions that hold at the start.
    pub init: Vec<Atom>,
    /// The values of numeric functions.
    pub values: Vec<(Atom, u64)>,
    /// The propositions to reach.
    pub goal: Vec<Atom>,
    /// Whether the best plan has the least `total-cost`; otherwise the shortest plan is best.
    pub minimizes_cost: bool,
}
