//! Reads tasks, and lists the errors.

use super::{GroundAtomText, GroundTaskText, LiftedAtomText, LiftedTaskText, TaskText, WayText, is_name_character};
use crate::error::quoted;
use std::fmt;
use std::str::FromStr;

/// A text that is no task. Places count characters from 1.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TaskTextError {
    /// Another character than the expected one.
    #[error("is no task, {what} belongs at its character {column}; write it like agentInRoom(agent0,room1) & blockInRoom(block0,room2)")]
    Expected {
        /// The expected part.
        what: &'static str,
        /// Its place.
        column: usize,
    },
    /// A variable in a ground task.
    #[error("has a variable at its character {column}; name objects, like agentInRoom(agent0,room1)")]
    VariableInGround {
        /// Its place.
        column: usize,
    },
    /// An argument without `?` in a lifted task.
    #[error("has no variable at its character {column}; begin each with ?, like agentInRoom(?a,?r)")]
    ObjectInLifted {
        /// Its place.
        column: usize,
    },
    /// A name with characters that have a meaning in task texts.
    #[error("{} cannot be in a task; use a name without blanks and without ( ) , & ? and quotes", quoted(.name))]
    UnusableName {
        /// The name.
        name: String,
    },
    /// A task without propositions, or a proposition without arguments.
    #[error("is empty; write at least one proposition, and each with an argument, like agentInRoom(agent0,room1)")]
    Empty,
    /// A way that avoids a proposition of the task.
    #[error("avoids {atom}, which it asks for as well; remove the one or the other")]
    AvoidsGoal {
        /// The proposition.
        atom: String,
    },
}

/// The unread rest of a text.
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

    /// A proposition about objects, or its opposite.
    fn ground_atom(&mut self) -> Result<GroundAtomText, TaskTextError> {
        let negated = self.accept("!");
        let (function, arguments) = self.atom(false)?;
        Ok(GroundAtomText { negated, function, arguments })
    }

    fn lifted_atom(&mut self) -> Result<LiftedAtomText, TaskTextError> {
        let (function, variables) = self.atom(true)?;
        Ok(LiftedAtomText { function, variables })
    }

    /// A function and its arguments, all with `?` or all without.
    fn atom(&mut self, lifted: bool) -> Result<(String, Vec<String>), TaskTextError> {
        self.skip_blanks();
        if self.left().starts_with('!') {
            return Err(self.expected("a name"));
        }
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
            false => Err(self.expected("\" & \", \" then \", \" through \", \" or \", \" avoiding \" or the end")),
        }
    }
}

/// The part of the task that the next proposition belongs to.
#[derive(Clone, Copy, PartialEq)]
enum Clause {
    Goal,
    Through,
    Avoiding,
}

fn task<A: Ord + Clone + fmt::Display>(
    text: &str,
    read: impl Fn(&mut Rest<'_>) -> Result<A, TaskTextError>,
) -> Result<TaskText<A>, TaskTextError> {
    if text.trim().is_empty() {
        return Err(TaskTextError::Empty);
    }
    let mut rest = Rest { text, at: 0 };
    let (mut goal, mut way, mut clause) = (Vec::new(), WayText::default(), Clause::Goal);
    loop {
        let atom = read(&mut rest)?;
        match (clause, way.through.last_mut()) {
            (Clause::Goal, _) => goal.push(atom),
            (Clause::Through, Some(alternatives)) => alternatives.push(atom),
            (Clause::Through, None) => way.through.push(vec![atom]),
            (Clause::Avoiding, _) => way.avoiding.push(atom),
        }
        if clause == Clause::Goal && (rest.accept("&") || rest.accept("AND ")) || clause != Clause::Goal && rest.accept("or ") {
            continue;
        }
        if clause == Clause::Goal && rest.accept("then ") {
            way.before.push(std::mem::take(&mut goal));
        } else if rest.accept("through ") {
            clause = Clause::Through;
            way.through.push(Vec::new());
        } else if rest.accept("avoiding ") {
            clause = Clause::Avoiding;
        } else {
            rest.end()?;
            return TaskText::with_way(goal, way);
        }
    }
}

impl FromStr for GroundTaskText {
    type Err = TaskTextError;

    fn from_str(text: &str) -> Result<Self, TaskTextError> {
        task(text, |rest| rest.ground_atom())
    }
}

impl FromStr for GroundAtomText {
    type Err = TaskTextError;

    fn from_str(text: &str) -> Result<Self, TaskTextError> {
        let mut rest = Rest { text, at: 0 };
        let atom = rest.ground_atom()?;
        match rest.end() {
            Ok(()) => Ok(atom),
            Err(_) => Err(rest.expected("the end")),
        }
    }
}

impl FromStr for LiftedTaskText {
    type Err = TaskTextError;

    fn from_str(text: &str) -> Result<Self, TaskTextError> {
        task(text, |rest| rest.lifted_atom())
    }
}
