//! Tasks as texts.
//!
//! A ground task names objects: `agentInRoom(agent0,room1)`, or a conjunction, `agentInRoom(agent0,room1) & blockInRoom(block0,room2)`. A
//! lifted task has variables in their place: `agentInRoom(?a,?r1) & blockInRoom(?o,?r2)`. A reader accepts blanks around names, commas and
//! `&`, and ` AND ` for ` & `. A writer puts one blank on each side of `&`, and none inside the parentheses.
//!
//! `!` before a ground proposition means that it is not to hold: `!agentInRoom(agent0,room1)`.
//!
//! A task may have a [way](WayText) after it: `then` and the next goal, `through` a proposition `or` another, `avoiding` a
//! proposition `or` another: `agentInRoom(agent0,room0) through agentInRoom(agent0,room1) or agentInRoom(agent0,room2)`.
//!
//! ```
//! use goodbot_formats::task_text::{GroundTaskText, LiftedTaskText};
//!
//! let task: GroundTaskText = "agentInRoom(agent0, room1) AND blockInRoom(block0, room2)".parse()?;
//! assert_eq!(task.to_string(), "agentInRoom(agent0,room1) & blockInRoom(block0,room2)");
//! assert_eq!(task.atoms()[1].arguments(), ["block0", "room2"]);
//!
//! let detour: GroundTaskText = "agentInRoom(agent0,room1) avoiding agentInRoom(agent0,room2)".parse()?;
//! assert_eq!(detour.way().avoiding[0].arguments(), ["agent0", "room2"]);
//!
//! let lifted: LiftedTaskText = "blockInRoom(?o, ?r)".parse()?;
//! assert_eq!(lifted.atoms()[0].variables(), ["o", "r"]);
//! # Ok::<(), goodbot_formats::task_text::TaskTextError>(())
//! ```

mod parse;

pub use parse::TaskTextError;

use serde::{Serialize, Serializer};
use std::fmt;

/// A proposition about objects: `agentInRoom(agent0,room1)`, or its opposite: `!agentInRoom(agent0,room1)`.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct GroundAtomText {
    negated: bool,
    function: String,
    arguments: Vec<String>,
}

/// A task about objects.
pub type GroundTaskText = TaskText<GroundAtomText>;

/// A proposition over variables: `agentInRoom(?a,?r)`.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LiftedAtomText {
    function: String,
    variables: Vec<String>,
}

/// A kind of task, over variables.
pub type LiftedTaskText = TaskText<LiftedAtomText>;

/// A conjunction of propositions, at least one, in their order in the text, and the way to it, if it has one.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TaskText<A> {
    atoms: Vec<A>,
    way: WayText<A>,
}

impl GroundAtomText {
    /// A proposition of a function and its objects, at least one.
    pub fn new<I>(function: impl Into<String>, arguments: I) -> Result<Self, TaskTextError>
    where
        I: IntoIterator<Item: Into<String>>,
    {
        let (function, arguments) = checked(function.into(), arguments)?;
        Ok(GroundAtomText { negated: false, function, arguments })
    }

    /// The opposite.
    #[must_use]
    pub fn negated(self) -> Self {
        GroundAtomText { negated: !self.negated, ..self }
    }

    /// Whether the proposition is not to hold.
    pub fn is_negated(&self) -> bool {
        self.negated
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
    /// The task with each proposition of its goal negated.
    #[must_use]
    pub fn opposite(&self) -> Self {
        TaskText { atoms: self.atoms.iter().cloned().map(GroundAtomText::negated).collect(), way: self.way.clone() }
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

impl<A: Ord + Clone + fmt::Display> TaskText<A> {
    /// A task of at least one proposition.
    ///
    /// # Errors
    /// [`TaskTextError::Empty`].
    pub fn new(atoms: Vec<A>) -> Result<Self, TaskTextError> {
        Self::with_way(atoms, WayText::default())
    }

    /// A task of at least one proposition, with a way.
    ///
    /// # Errors
    /// [`TaskTextError::Empty`] for a task or a clause without propositions, [`TaskTextError::AvoidsGoal`] for a way that avoids a
    /// proposition of the task.
    pub fn with_way(atoms: Vec<A>, way: WayText<A>) -> Result<Self, TaskTextError> {
        way.check(&atoms)?;
        Ok(TaskText { atoms, way })
    }

    /// Whether another text is of the same task: the same propositions and the same way, in any order.
    pub fn is_same(&self, other: &Self) -> bool {
        sorted(&self.atoms) == sorted(&other.atoms) && self.way.is_same(&other.way)
    }
}

impl<A> TaskText<A> {
    /// The propositions of the goal, at least one.
    pub fn atoms(&self) -> &[A] {
        &self.atoms
    }

    /// The way to the goal; empty if it has none.
    pub fn way(&self) -> &WayText<A> {
        &self.way
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
        if !is_usable_name(name) || function.starts_with('!') {
            let name = name.clone();
            return Err(TaskTextError::UnusableName { name });
        }
    }
    Ok((function, names))
}

impl fmt::Display for GroundAtomText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.negated { "!" } else { "" };
        write!(f, "{sign}{}({})", self.function, self.arguments.join(","))
    }
}

impl fmt::Display for LiftedAtomText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}(?{})", self.function, self.variables.join(",?"))
    }
}

impl<A: Ord + Clone + fmt::Display> fmt::Display for TaskText<A> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.way.fmt_around(f, &self.atoms)
    }
}

impl Serialize for GroundAtomText {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<A: Ord + Clone + fmt::Display> Serialize for TaskText<A> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// The way of a task. Each list may be empty.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct WayText<A> {
    /// Earlier goals in order, each a conjunction: the parts before `then`.
    pub before: Vec<Vec<A>>,
    /// Lists of alternatives: one of each list is to hold at some time up to the end, in any order.
    pub through: Vec<Vec<A>>,
    /// Propositions that must not hold before the end.
    pub avoiding: Vec<A>,
}

impl<A> Default for WayText<A> {
    fn default() -> Self {
        WayText { before: Vec::new(), through: Vec::new(), avoiding: Vec::new() }
    }
}

impl<A> WayText<A> {
    /// Whether there is no way.
    pub fn is_empty(&self) -> bool {
        self.before.is_empty() && self.through.is_empty() && self.avoiding.is_empty()
    }
}

impl<A: Ord + Clone + fmt::Display> WayText<A> {
    /// Refuses a task without a goal, an empty clause, and a way that avoids the goal.
    pub(super) fn check(&self, goal: &[A]) -> Result<(), TaskTextError> {
        if goal.is_empty() || self.before.iter().chain(&self.through).any(Vec::is_empty) {
            return Err(TaskTextError::Empty);
        }
        let asked = |atom: &&A| goal.contains(atom) || self.through.iter().any(|clause| clause.as_slice() == std::slice::from_ref(*atom));
        match self.avoiding.iter().find(asked) {
            Some(atom) => Err(TaskTextError::AvoidsGoal { atom: atom.to_string() }),
            None => Ok(()),
        }
    }

    /// Whether another way is the same. The order counts for earlier goals only.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        let each = |lists: &[Vec<A>]| lists.iter().map(|list| sorted(list)).collect::<Vec<_>>();
        each(&self.before) == each(&other.before)
            && sorted(&each(&self.through)) == sorted(&each(&other.through))
            && sorted(&self.avoiding) == sorted(&other.avoiding)
    }

    /// Writes a task: its goals, then its way.
    pub(super) fn fmt_around(&self, f: &mut fmt::Formatter<'_>, goal: &[A]) -> fmt::Result {
        for before in &self.before {
            list(f, before, " & ")?;
            f.write_str(" then ")?;
        }
        list(f, goal, " & ")?;
        for clause in &self.through {
            f.write_str(" through ")?;
            list(f, clause, " or ")?;
        }
        if !self.avoiding.is_empty() {
            f.write_str(" avoiding ")?;
            list(f, &self.avoiding, " or ")?;
        }
        Ok(())
    }
}

fn list<A: fmt::Display>(f: &mut fmt::Formatter<'_>, atoms: &[A], between: &str) -> fmt::Result {
    for (index, atom) in atoms.iter().enumerate() {
        if index > 0 {
            f.write_str(between)?;
        }
        atom.fmt(f)?;
    }
    Ok(())
}

/// The items of a list in order, each once, so that lists can be compared.
pub(super) fn sorted<A: Ord + Clone>(list: &[A]) -> Vec<A> {
    let mut list = list.to_vec();
    list.sort();
    list.dedup();
    list
}
