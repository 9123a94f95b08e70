//! Tasks as texts.
//!
//! A ground task names objects: `agentInRoom(agent0,room1)`, or several at once,
//! `agentInRoom(agent0,room1) & blockInRoom(block0,room2)`. A lifted task has variables in their
//! place: `agentInRoom(?a,?r1) & blockInRoom(?o,?r2)`. Blanks around names, commas and `&` may be
//! there when reading, and ` AND ` may stand for ` & `; what is written has no blank inside the
//! parentheses and one on each side of `&`.
//!
//! ```
//! use goodbot_formats::task_text::{GroundTaskText, LiftedTaskText};
//!
//! let task: GroundTaskText = "agentInRoom(agent0, room1) AND blockInRoom(block0, room2)".parse()?;
//! assert_eq!(task.to_string(), "agentInRoom(agent0,room1) & blockInRoom(block0,room2)");
//! assert_eq!(task.atoms()[1].arguments(), ["block0", "room2"]);
//!
//! let lifted: LiftedTaskText = "blockInRoom(?o, ?r)".parse()?;
//! assert_eq!(lifted.atoms()[0].variables(), ["o", "r"]);
//! # Ok::<(), goodbot_formats::task_text::TaskTextError>(())
//! ```

use std::fmt;

use serde::{Serialize, Serializer};

mod parse;

pub use parse::TaskTextError;

/// A proposition about objects: `agentInRoom(agent0,room1)`.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct GroundAtomText {
    function: String,
    arguments: Vec<String>,
}

/// A conjunction of propositions about objects, at least one, in the order in which they stand.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct GroundTaskText {
    atoms: Vec<GroundAtomText>,
}

/// A proposition over variables: `agentInRoom(?a,?r)`.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LiftedAtomText {
    function: String,
    variables: Vec<String>,
}

/// A conjunction of propositions over variables, at least one, in the order in which they stand.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LiftedTaskText {
    atoms: Vec<LiftedAtomText>,
}

impl GroundAtomText {
    /// A proposition of a function and its objects, at least one.
    pub fn new<I>(function: impl Into<String>, arguments: I) -> Result<Self, TaskTextError>
    where
        I: IntoIterator<Item: Into<String>>,
    {
        let (function, arguments) = checked(function.into(), arguments)?;
        Ok(GroundAtomText { function, arguments })
    }

    /// The function's name, such as `agentInRoom`.
    pub fn function(&self) -> &str {
        &self.function
    }

    /// The names of the objects.
    pub fn arguments(&self) -> &[String] {
        &self.arguments
    }
}

impl GroundTaskText {
    /// A task of at least one proposition.
    pub fn new(atoms: Vec<GroundAtomText>) -> Result<Self, TaskTextError> {
        match atoms.is_empty() {
            true => Err(TaskTextError::Empty),
            false => Ok(GroundTaskText { atoms }),
        }
    }

    /// The propositions, at least one.
    pub fn atoms(&self) -> &[GroundAtomText] {
        &self.atoms
    }

    /// Whether these are the propositions of the task, in whatever order.
    pub fn holds_exactly(&self, atoms: &[GroundAtomText]) -> bool {
        let sorted = |atoms: &[GroundAtomText]| {
            let mut atoms = atoms.to_vec();
            atoms.sort();
            atoms.dedup();
            atoms
        };
        sorted(&self.atoms) == sorted(atoms)
    }
}

impl LiftedAtomText {
    /// A proposition of a function and its variables, at least one, given without their `?`.
    pub fn new<I>(function: impl Into<String>, variables: I) -> Result<Self, TaskTextError>
    where
        I: IntoIterator<Item: Into<String>>,
    {
        let (function, variables) = checked(function.into(), variables)?;
        Ok(LiftedAtomText { function, variables })
    }

    /// The function's name, such as `agentInRoom`.
    pub fn function(&self) -> &str {
        &self.function
    }

    /// The names of the variables, without their `?`.
    pub fn variables(&self) -> &[String] {
        &self.variables
    }
}

impl LiftedTaskText {
    /// A task of at least one proposition.
    pub fn new(atoms: Vec<LiftedAtomText>) -> Result<Self, TaskTextError> {
        match atoms.is_empty() {
            true => Err(TaskTextError::Empty),
            false => Ok(LiftedTaskText { atoms }),
        }
    }

    /// The propositions, at least one.
    pub fn atoms(&self) -> &[LiftedAtomText] {
        &self.atoms
    }
}

/// Whether a task text can hold this name.
pub fn is_usable_name(name: &str) -> bool {
    !name.is_empty() && name.chars().all(is_name_character)
}

fn is_name_character(c: char) -> bool {
    !c.is_whitespace() && !c.is_control() && !"(),&?\"".contains(c)
}

fn checked<I>(function: String, names: I) -> Result<(String, Vec<String>), TaskTextError>
where
    I: IntoIterator<Item: Into<String>>,
{
    let names: Vec<String> = names.into_iter().map(Into::into).collect();
    if names.is_empty() {
        return Err(TaskTextError::Empty);
    }
    for name in std::iter::once(&function).chain(&names) {
        if !is_usable_name(name) {
            let name = name.clone();
            return Err(TaskTextError::UnusableName { name });
        }
    }
    Ok((function, names))
}

impl fmt::Display for GroundAtomText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}({})", self.function, self.arguments.join(","))
    }
}

impl fmt::Display for LiftedAtomText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}(?{})", self.function, self.variables.join(",?"))
    }
}

impl fmt::Display for GroundTaskText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        conjunction(f, &self.atoms)
    }
}

impl fmt::Display for LiftedTaskText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        conjunction(f, &self.atoms)
    }
}

fn conjunction<A: fmt::Display>(f: &mut fmt::Formatter<'_>, atoms: &[A]) -> fmt::Result {
    for (index, atom) in atoms.iter().enumerate() {
        if index > 0 {
            f.write_str(" & ")?;
        }
        atom.fmt(f)?;
    }
    Ok(())
}

impl Serialize for GroundAtomText {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl Serialize for GroundTaskText {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
