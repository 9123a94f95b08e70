//! Reading tasks, and what can go wrong there.

use std::fmt;
use std::str::FromStr;

use super::{GroundAtomText, GroundTaskText, LiftedAtomText, LiftedTaskText, is_name_character};
use crate::error::quoted;

/// A text that is no task. What it says of a place counts characters from 1.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum TaskTextError {
    /// Something else stands where this belongs.
    Expected {
        /// What belongs there.
        what: &'static str,
        /// Where.
        column: usize,
    },
    /// A variable in a ground task.
    VariableInGround {
        /// Where.
        column: usize,
    },
    /// An argument without `?` in a lifted task.
    ObjectInLifted {
        /// Where.
        column: usize,
    },
    /// A name with characters that a task text has a use for.
    UnusableName {
        /// The name.
        name: String,
    },
    /// A task of no proposition, or a proposition of no argument.
    Empty,
}

impl fmt::Display for TaskTextError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TaskTextError::Expected { what, column } => write!(
                f,
                "is no task, {what} belongs at its character {column}; write it like agentInRoom(agent0,room1) & blockInRoom(block0,room2)"
            ),
            TaskTextError::VariableInGround { column } => {
                write!(f, "has a variable at its character {column}; name objects, like agentInRoom(agent0,room1)")
            }
            TaskTextError::ObjectInLifted { column } => {
                write!(f, "has no variable at its character {column}; begin each with ?, like agentInRoom(?a,?r)")
            }
            TaskTextError::UnusableName { name } => {
                write!(f, "{} cannot stand in a task; use a name without blanks and without ( ) , & ? and quotes", quoted(name))
            }
            TaskTextError::Empty => {
                f.write_str("is empty; write at least one proposition, and each with an argument, like agentInRoom(agent0,room1)")
            }
        }
    }
}

impl std::error::Error for TaskTextError {}

/// What is left of a text that is being read.
struct Rest<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Rest<'a> {
    fn column(&self) -> usize {
        1 + self.text[..self.at].chars().count()
    }

    fn left(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn skip_blanks(&mut self) {
        let left = self.left();
        self.at += left.len() - left.trim_start().len();
    }

    fn accept(&mut self, what: &str) -> bool {
        self.skip_blanks();
        let there = self.left().starts_with(what);
        if there {
            self.at += what.len();
        }
        there
    }

    fn expected(&self, what: &'static str) -> TaskTextError {
        let column = self.column();
        TaskTextError::Expected { what, column }
    }

    fn name(&mut self) -> Result<&'a str, TaskTextError> {
        self.skip_blanks();
        let left = self.left();
        let end = left.find(|c| !is_name_character(c)).unwrap_or(left.len());
        if end == 0 {
            return Err(self.expected("a name"));
        }
        self.at += end;
        Ok(&left[..end])
    }

    /// A function and its arguments, each with `?` before it or each without.
    fn atom(&mut self, lifted: bool) -> Result<(String, Vec<String>), TaskTextError> {
        let function = self.name()?.to_string();
        if !self.accept("(") {
            return Err(self.expected("\"(\""));
        }
        let mut names = Vec::new();
        loop {
            self.skip_blanks();
            match (lifted, self.left().starts_with('?')) {
                (false, true) => {
                    let column = self.column();
                    return Err(TaskTextError::VariableInGround { column });
                }
                (true, false) if self.left().starts_with(is_name_character) => {
                    let column = self.column();
                    return Err(TaskTextError::ObjectInLifted { column });
                }
                (true, true) => self.at += 1,
                _ => {}
            }
            names.push(self.name()?.to_string());
            if self.accept(")") {
                return Ok((function, names));
            }
            if !self.accept(",") {
                return Err(self.expected("\",\" or \")\""));
            }
        }
    }

    fn end(&mut self) -> Result<(), TaskTextError> {
        self.skip_blanks();
        match self.left().is_empty() {
            true => Ok(()),
            false => Err(self.expected("\" & \" or the end")),
        }
    }
}

fn atoms(text: &str, lifted: bool) -> Result<Vec<(String, Vec<String>)>, TaskTextError> {
    if text.trim().is_empty() {
        return Err(TaskTextError::Empty);
    }
    let mut rest = Rest { text, at: 0 };
    let mut atoms = vec![rest.atom(lifted)?];
    while rest.accept("&") || rest.accept("AND ") {
        atoms.push(rest.atom(lifted)?);
    }
    rest.end()?;
    Ok(atoms)
}

impl FromStr for GroundTaskText {
    type Err = TaskTextError;

    fn from_str(text: &str) -> Result<Self, TaskTextError> {
        let atoms = atoms(text, false)?.into_iter();
        let atom = |(function, arguments)| GroundAtomText { function, arguments };
        GroundTaskText::new(atoms.map(atom).collect())
    }
}

impl FromStr for GroundAtomText {
    type Err = TaskTextError;

    fn from_str(text: &str) -> Result<Self, TaskTextError> {
        let mut rest = Rest { text, at: 0 };
        let (function, arguments) = rest.atom(false)?;
        match rest.end() {
            Ok(()) => Ok(GroundAtomText { function, arguments }),
            Err(_) => Err(rest.expected("the end")),
        }
    }
}

impl FromStr for LiftedTaskText {
    type Err = TaskTextError;

    fn from_str(text: &str) -> Result<Self, TaskTextError> {
        let atoms = atoms(text, true)?.into_iter();
        let atom = |(function, variables)| LiftedAtomText { function, variables };
        LiftedTaskText::new(atoms.map(atom).collect())
    }
}
