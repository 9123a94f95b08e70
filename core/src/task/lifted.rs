//! Lifted tasks: conjunctions of propositional functions over typed free variables.

use crate::capacity::{ARGUMENTS, Capacity, CapacityError, PROPOSITIONS_PER_TASK, VARIABLES_PER_TASK};
use crate::oomdp::vocabulary::digest;
use crate::oomdp::{ClassId, PropositionId, Schema};
use core::fmt;
use heapless::Vec;

/// Stands for an argument that the propositional function does not have.
pub const NO_VARIABLE: u8 = u8::MAX;

/// A propositional function of a lifted task's variables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LiftedProposition {
    /// The propositional function.
    pub proposition: PropositionId,
    /// The variable of each argument, by position among the task's variables; [`NO_VARIABLE`] beyond the function's parameters.
    pub variables: [u8; ARGUMENTS],
}

/// A conjunction of propositional functions over typed variables: `blockInRoom(?o, ?r)`. Reward 1 and termination where it holds.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct LiftedTask {
    pub(crate) propositions: Vec<LiftedProposition, PROPOSITIONS_PER_TASK, u8>,
    pub(crate) variables: Vec<ClassId, VARIABLES_PER_TASK, u8>,
    vocabulary: u32,
}

/// What is wrong with the text of a lifted task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TaskTextError {
    /// It is not of the form `name(?a, ?b) & name(?c)`.
    Form,
    /// The domain has no propositional function of this name.
    UnknownProposition,
    /// A proposition has more or fewer arguments than its function.
    ArgumentCount,
    /// One variable stands for objects of two classes.
    ClassConflict,
    /// Something was full.
    Capacity(CapacityError),
}

impl From<CapacityError> for TaskTextError {
    fn from(error: CapacityError) -> Self {
        Self::Capacity(error)
    }
}

impl fmt::Display for TaskTextError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Form => "a lifted task reads like agentInRoom(?a, ?r1) & blockInRoom(?o, ?r2)",
            Self::UnknownProposition => "the domain has no propositional function of this name",
            Self::ArgumentCount => "a proposition has more or fewer arguments than its function",
            Self::ClassConflict => "one variable stands for objects of two classes",
            Self::Capacity(error) => return error.fmt(f),
        })
    }
}

impl core::error::Error for TaskTextError {}

impl LiftedTask {
    /// The task that one propositional function holds, each argument a variable of its own.
    ///
    /// # Errors
    /// [`TaskTextError`] where the schema does not have it, or it has more arguments than a proposition can.
    pub fn single(proposition: PropositionId, schema: &Schema<'_>) -> Result<Self, TaskTextError> {
        let mut task = Self { propositions: Vec::new(), variables: Vec::new(), vocabulary: digest(schema) };
        let parameters = schema.parameters(proposition);
        if parameters.is_empty() {
            return Err(TaskTextError::UnknownProposition);
        }
        let mut variables = [NO_VARIABLE; ARGUMENTS];
        if parameters.len() > ARGUMENTS {
            return Err(CapacityError::new(Capacity::Arguments, ARGUMENTS, parameters.len()).into());
        }
        for ((position, slot), &class) in variables.iter_mut().enumerate().zip(parameters) {
            *slot = position as u8;
            task.add_variable(class)?;
        }
        task.add(LiftedProposition { proposition, variables })?;
        Ok(task)
    }

    /// Reads `agentInRoom(?a, ?r1) & blockInRoom(?o, ?r2)`. A variable that stands twice is the same object; different variables are
    /// bound to different objects.
    ///
    /// ```
    /// use goodbot::{home, task::LiftedTask};
    /// let both = LiftedTask::parse("agentInRoom(?a, ?r1) & blockInRoom(?o, ?r2)", &home::SCHEMA)?;
    /// assert_eq!(both.variables().len(), 4);
    /// # Ok::<(), goodbot::task::TaskTextError>(())
    /// ```
    ///
    /// # Errors
    /// [`TaskTextError`].
    pub fn parse(text: &str, schema: &Schema<'_>) -> Result<Self, TaskTextError> {
        let mut task = Self { propositions: Vec::new(), variables: Vec::new(), vocabulary: digest(schema) };
        let mut names: Vec<&str, VARIABLES_PER_TASK> = Vec::new();
        for part in pieces(text, b'&') {
            let (name, rest) = split_at_byte(part, b'(').ok_or(TaskTextError::Form)?;
            let (arguments, behind) = split_at_byte(rest, b')').ok_or(TaskTextError::Form)?;
            if !behind.trim_ascii().is_empty() {
                return Err(TaskTextError::Form);
            }
            let proposition = schema.proposition(name.trim_ascii()).ok_or(TaskTextError::UnknownProposition)?;
            let parameters = schema.parameters(proposition);
            if pieces(arguments, b',').count() != parameters.len() {
                return Err(TaskTextError::ArgumentCount);
            }
            if parameters.len() > ARGUMENTS {
                return Err(CapacityError::new(Capacity::Arguments, ARGUMENTS, parameters.len()).into());
            }
            let mut variables = [NO_VARIABLE; ARGUMENTS];
            for ((argument, slot), &class) in pieces(arguments, b',').zip(variables.iter_mut()).zip(parameters) {
                let variable = argument.trim_ascii();
                if variable.len() < 2 || variable.as_bytes().first() != Some(&b'?') {
                    return Err(TaskTextError::Form);
                }
                let known = names.iter().position(|&name| name == variable);
                let position = match known {
                    Some(position) => position,
                    None => {
                        task.add_variable(class)?;
                        let _ = names.push(variable);
                        names.len().saturating_sub(1)
                    }
                };
                if task.variables.get(position) != Some(&class) {
                    return Err(TaskTextError::ClassConflict);
                }
                *slot = position as u8;
            }
            task.add(LiftedProposition { proposition, variables })?;
        }
        Ok(task)
    }

    fn add_variable(&mut self, class: ClassId) -> Result<(), CapacityError> {
        self.variables.push(class).map_err(|_| CapacityError::full(Capacity::VariablesPerTask, VARIABLES_PER_TASK))
    }

    fn add(&mut self, proposition: LiftedProposition) -> Result<(), CapacityError> {
        self.propositions.push(proposition).map_err(|_| CapacityError::full(Capacity::PropositionsPerTask, PROPOSITIONS_PER_TASK))
    }

    /// The conjunction.
    pub fn propositions(&self) -> &[LiftedProposition] {
        &self.propositions
    }

    /// The digest of the vocabulary that it is written in.
    pub fn vocabulary(&self) -> u32 {
        self.vocabulary
    }

    /// The class of each variable.
    pub fn variables(&self) -> &[ClassId] {
        &self.variables
    }
}

/// What stands before and behind the first `separator`, an ASCII character. The library's own way of splitting brings code that panics into
/// a controller's flash.
fn split_at_byte(text: &str, separator: u8) -> Option<(&str, &str)> {
    let at = text.bytes().position(|byte| byte == separator)?;
    Some((text.get(..at)?, text.get(at.saturating_add(1)..)?))
}

/// The pieces of a text between one `separator`, an ASCII character, and the next.
fn pieces(text: &str, separator: u8) -> impl Iterator<Item = &str> {
    let mut rest = Some(text);
    core::iter::from_fn(move || {
        let all = rest?;
        let (piece, after) = split_at_byte(all, separator).map_or((all, None), |(piece, after)| (piece, Some(after)));
        rest = after;
        Some(piece)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::home::SCHEMA;

    #[test]
    fn a_proposition_alone_equals_its_text() {
        let single = LiftedTask::single(crate::home::BLOCK_IN_ROOM, &SCHEMA).unwrap();
        assert_eq!(LiftedTask::parse("blockInRoom( ?o , ?r )", &SCHEMA), Ok(single));
    }

    #[test]
    fn what_cannot_be_a_task_is_refused() {
        let refused = |text| LiftedTask::parse(text, &SCHEMA).unwrap_err();
        assert_eq!(refused(""), TaskTextError::Form);
        assert_eq!(refused("blockInRoom(?o"), TaskTextError::Form);
        assert_eq!(refused("blockInRoom(?o, ?r) and more"), TaskTextError::Form);
        assert_eq!(refused("blockInRoom(?o, ?r) &"), TaskTextError::Form);
        assert_eq!(refused("blockInRoom(?o, ?r))"), TaskTextError::Form);
        assert_eq!(refused("blöckInRoom(?o, ?r)"), TaskTextError::UnknownProposition);
        assert_eq!(refused("blockInRoom(o, r)"), TaskTextError::Form);
        assert_eq!(refused("flies(?a)"), TaskTextError::UnknownProposition);
        assert_eq!(refused("blockInRoom(?o)"), TaskTextError::ArgumentCount);
        assert_eq!(refused("blockInRoom(?x, ?x)"), TaskTextError::ClassConflict);
        let five = "blockInRoom(?o, ?r) & blockInRoom(?o, ?r) & blockInRoom(?o, ?r) & blockInRoom(?o, ?r) & blockInRoom(?o, ?r)";
        assert!(matches!(refused(five), TaskTextError::Capacity(_)));
    }
}
