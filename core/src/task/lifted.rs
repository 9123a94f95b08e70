//! Lifted tasks: conjunctions of propositional functions over typed free variables.

use super::way::{Clause, Part};
use crate::capacity::{ARGUMENTS, Capacity, CapacityError, PROPOSITIONS_PER_TASK, VARIABLES_PER_TASK};
use crate::oomdp::vocabulary::digest;
use crate::oomdp::{ClassId, PropositionId, Schema};
use heapless::Vec;

/// Fills the place of an argument that the propositional function does not have.
pub const NO_VARIABLE: u8 = u8::MAX;

/// A propositional function of a lifted task's variables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LiftedProposition {
    /// The propositional function.
    pub proposition: PropositionId,
    /// The variable of each argument, by position among the task's variables; [`NO_VARIABLE`] beyond the function's parameters.
    pub variables: [u8; ARGUMENTS],
}

/// A conjunction of propositional functions over typed variables: `blockInRoom(?o, ?r)`. A state where it holds has reward 1 and is
/// terminal. It may have a [way](super::Way): `agentInRoom(?a, ?goal) avoiding agentInRoom(?a, ?not)`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct LiftedTask {
    /// The goal's propositions, then those of the way.
    propositions: Vec<LiftedProposition, PROPOSITIONS_PER_TASK, u8>,
    parts: Parts,
    pub(crate) variables: Vec<ClassId, VARIABLES_PER_TASK, u8>,
    vocabulary: u32,
}

/// The part of each proposition in the task's way. Without the feature `ways` all belong to the goal, and this takes no memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
struct Parts(#[cfg(feature = "ways")] [Part; PROPOSITIONS_PER_TASK]);

impl Parts {
    #[cfg(feature = "ways")]
    fn get(&self, position: usize) -> Part {
        self.0.get(position).copied().unwrap_or_default()
    }

    #[cfg(feature = "ways")]
    fn set(&mut self, position: usize, part: Part) {
        if let Some(slot) = self.0.get_mut(position) {
            *slot = part;
        }
    }

    #[cfg(not(feature = "ways"))]
    fn get(&self, _position: usize) -> Part {
        Part::Goal
    }

    #[cfg(not(feature = "ways"))]
    fn set(&mut self, _position: usize, _part: Part) {}
}

/// A fault in the text of a lifted task.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TaskTextError {
    /// It is not of the form `name(?a, ?b) & name(?c)`.
    #[error(
        "a lifted task reads like agentInRoom(?a, ?r1) & blockInRoom(?o, ?r2); a way follows it, like through agentInRoom(?a, ?v) \
         or agentInRoom(?a, ?w), and avoiding agentInRoom(?a, ?x); then is between goals"
    )]
    Form,
    /// The domain has no propositional function of this name.
    #[error("the domain has no propositional function with the name that proposition {} has", nth(*.proposition))]
    UnknownProposition {
        /// The proposition, by its position among those given, from 0.
        proposition: u8,
    },
    /// A proposition has more or fewer arguments than its function.
    #[error("proposition {} was given {given} arguments, and its function has {wanted}", nth(*.proposition))]
    ArgumentCount {
        /// The proposition, by its position among those given, from 0.
        proposition: u8,
        /// The number of given arguments.
        given: u8,
        /// The number of its function's arguments.
        wanted: u8,
    },
    /// One variable is used for objects of two classes.
    #[error(
        "argument {} of proposition {} is a variable for objects of another class; use another name",
        nth(*.argument),
        nth(*.proposition)
    )]
    ClassConflict {
        /// The proposition with the second class, by its position among those given, from 0.
        proposition: u8,
        /// The argument, from 0.
        argument: u8,
    },
    /// A way goes through something that the goal requires anyway, or requires the same thing twice.
    #[error("the same is asked for twice; give what a way goes through a variable of its own")]
    SaysNothing,
    /// A way avoids something that the task requires.
    #[error("what is to be avoided is asked for as well; give what is avoided a variable of its own")]
    AvoidsGoal,
    /// It has a way, and the library was built without the feature `ways`.
    #[error("this robot knows no ways (through, avoiding, then); build it with the feature ways")]
    NoWays,
    /// A table was full.
    #[error(transparent)]
    Capacity(#[from] CapacityError),
}

/// Counted from 1.
const fn nth(position: u8) -> u16 {
    position as u16 + 1
}

impl LiftedTask {
    /// The task that one propositional function holds, each argument a variable of its own.
    ///
    /// # Errors
    /// [`TaskTextError`] if the schema lacks the function, or it has more arguments than a proposition can have.
    pub fn single(proposition: PropositionId, schema: &Schema<'_>) -> Result<Self, TaskTextError> {
        let mut task = Self::empty(schema);
        let parameters = schema.parameters(proposition);
        if parameters.is_empty() {
            return Err(TaskTextError::UnknownProposition { proposition: 0 });
        }
        let mut variables = [NO_VARIABLE; ARGUMENTS];
        Capacity::Arguments.fits(parameters.len(), ARGUMENTS)?;
        for ((position, slot), &class) in variables.iter_mut().enumerate().zip(parameters) {
            *slot = position as u8;
            task.add_variable(class)?;
        }
        task.add(LiftedProposition { proposition, variables }, Part::Goal)?;
        Ok(task)
    }

    /// The task with one more clause of its way, about a proposition with this many alternatives. All but the last argument are variables
    /// of the task, if it has one of that class; the last is a new variable for each alternative.
    ///
    /// For example, `agentInRoom(?a, ?goal)` with a clause of two alternatives is `agentInRoom(?a, ?goal) through agentInRoom(?a, ?v) or
    /// agentInRoom(?a, ?w)`.
    ///
    /// # Errors
    /// [`TaskTextError`].
    pub(crate) fn with_clause(
        &self,
        clause: Clause,
        proposition: PropositionId,
        alternatives: usize,
        schema: &Schema<'_>,
    ) -> Result<Self, TaskTextError> {
        if cfg!(not(feature = "ways")) {
            return Err(TaskTextError::NoWays);
        }
        let parameters = schema.parameters(proposition);
        let Some(last) = parameters.len().checked_sub(1) else { return Err(TaskTextError::UnknownProposition { proposition: 0 }) };
        Capacity::Arguments.fits(parameters.len(), ARGUMENTS)?;
        let mut task = self.clone();
        let part = match clause {
            Clause::Avoiding => Part::Avoiding,
            Clause::Through => {
                let clauses = self.way().map(|(part, _)| if let Part::Through(clause) = part { clause.saturating_add(1) } else { 0 });
                Part::Through(clauses.max().unwrap_or(0))
            }
        };
        for _ in 0..alternatives {
            let mut variables = [NO_VARIABLE; ARGUMENTS];
            for ((position, &class), slot) in parameters.iter().enumerate().zip(variables.iter_mut()) {
                let known = task.variables.iter().position(|&known| known == class).filter(|_| position != last);
                *slot = match known {
                    Some(known) => known as u8,
                    None => {
                        task.add_variable(class)?;
                        task.variables.len().saturating_sub(1) as u8
                    }
                };
            }
            task.add(LiftedProposition { proposition, variables }, part)?;
        }
        Ok(task)
    }

    /// A task without a way, with these [`propositions`](Self::propositions) and [`variables`](Self::variables), as another machine parsed
    /// them. Only their numbers are checked.
    ///
    /// # Errors
    /// A [`CapacityError`] if there are more than a task can have.
    pub fn written(propositions: &[LiftedProposition], variables: &[ClassId], schema: &Schema<'_>) -> Result<Self, CapacityError> {
        let mut task = Self::empty(schema);
        propositions.iter().try_for_each(|&proposition| task.add(proposition, Part::Goal))?;
        variables.iter().try_for_each(|&class| task.add_variable(class))?;
        Ok(task)
    }

    fn empty(schema: &Schema<'_>) -> Self {
        Self { propositions: Vec::new(), parts: Parts::default(), variables: Vec::new(), vocabulary: digest(schema) }
    }

    /// Reads `agentInRoom(?a, ?r1) & blockInRoom(?o, ?r2)`. A repeated variable is the same object; different variables are bound to
    /// different objects. A [way](super::Way) follows the goal: `then` and the next goal, `through` a proposition `or` another, and
    /// `avoiding` a proposition `or` another.
    ///
    /// ```
    /// use goodbot::{home, task::LiftedTask};
    /// let both = LiftedTask::parse("agentInRoom(?a, ?r1) & blockInRoom(?o, ?r2)", &home::SCHEMA)?;
    /// assert_eq!(both.variables().len(), 4);
    /// let detour = LiftedTask::parse("agentInRoom(?a, ?goal) through agentInRoom(?a, ?via)", &home::SCHEMA)?;
    /// assert!(detour.has_way() && detour.propositions().len() == 1);
    /// # Ok::<(), goodbot::task::TaskTextError>(())
    /// ```
    ///
    /// # Errors
    /// [`TaskTextError`].
    pub fn parse(text: &str, schema: &Schema<'_>) -> Result<Self, TaskTextError> {
        let mut task = Self::empty(schema);
        let mut names: Vec<&str, VARIABLES_PER_TASK> = Vec::new();
        let (mut part, mut rest) = (Part::Goal, text);
        // Earlier goals and clauses so far.
        let (mut stages, mut clauses) = (0_u8, 0_u8);
        loop {
            let (name, after) = split_at_byte(rest, b'(').ok_or(TaskTextError::Form)?;
            let (arguments, after) = split_at_byte(after, b')').ok_or(TaskTextError::Form)?;
            let proposition = task.read(name, arguments, &mut names, schema)?;
            task.add(proposition, part)?;
            let after = after.trim_ascii();
            if after.is_empty() {
                break;
            }
            let (connective, after) = match after.strip_prefix('&') {
                Some(after) => ("&", after),
                None => split_at_byte(after, b' ').ok_or(TaskTextError::Form)?,
            };
            part = match (connective, part) {
                ("&", Part::Goal) | ("or", Part::Through(_) | Part::Avoiding) => part,
                ("then", Part::Goal) => {
                    task.goal_is_only_before(stages);
                    stages = stages.saturating_add(1);
                    Part::Goal
                }
                ("through", _) => {
                    clauses = clauses.saturating_add(1);
                    Part::Through(clauses.saturating_sub(1))
                }
                ("avoiding", _) => Part::Avoiding,
                _ => return Err(TaskTextError::Form),
            };
            if cfg!(not(feature = "ways")) && connective != "&" {
                return Err(TaskTextError::NoWays);
            }
            rest = after;
        }
        task.put_goal_first();
        task.check_way()?;
        Ok(task)
    }

    /// Reads one proposition.
    fn read<'n>(
        &mut self,
        name: &str,
        arguments: &'n str,
        names: &mut Vec<&'n str, VARIABLES_PER_TASK>,
        schema: &Schema<'_>,
    ) -> Result<LiftedProposition, TaskTextError> {
        let this = self.propositions.len() as u8;
        let proposition = schema.proposition(name.trim_ascii()).ok_or(TaskTextError::UnknownProposition { proposition: this })?;
        let parameters = schema.parameters(proposition);
        let given = pieces(arguments, b',').count();
        if given != parameters.len() {
            let (given, wanted) = (given.min(usize::from(u8::MAX)) as u8, parameters.len().min(usize::from(u8::MAX)) as u8);
            return Err(TaskTextError::ArgumentCount { proposition: this, given, wanted });
        }
        Capacity::Arguments.fits(parameters.len(), ARGUMENTS)?;
        let mut variables = [NO_VARIABLE; ARGUMENTS];
        for (at, ((argument, slot), &class)) in pieces(arguments, b',').zip(variables.iter_mut()).zip(parameters).enumerate() {
            let variable = argument.trim_ascii();
            if variable.len() < 2 || variable.as_bytes().first() != Some(&b'?') {
                return Err(TaskTextError::Form);
            }
            let known = names.iter().position(|&name| name == variable);
            let position = match known {
                Some(position) => position,
                None => {
                    self.add_variable(class)?;
                    let _ = names.push(variable);
                    names.len().saturating_sub(1)
                }
            };
            if self.variables.get(position) != Some(&class) {
                return Err(TaskTextError::ClassConflict { proposition: this, argument: at as u8 });
            }
            *slot = position as u8;
        }
        Ok(LiftedProposition { proposition, variables })
    }

    /// Turns the goal so far into an earlier goal.
    fn goal_is_only_before(&mut self, stage: u8) {
        for position in 0..self.propositions.len() {
            if self.parts.get(position) == Part::Goal {
                self.parts.set(position, Part::Before(stage));
            }
        }
    }

    /// Brings the goal's propositions to the front; the others stay in order.
    fn put_goal_first(&mut self) {
        let count = self.propositions.len();
        for goal in 0..count {
            if self.parts.get(goal) != Part::Goal {
                continue;
            }
            for place in (0..goal).rev() {
                if self.parts.get(place) == Part::Goal {
                    break;
                }
                let (part, before) = (self.parts.get(place + 1), self.parts.get(place));
                self.parts.set(place, part);
                self.parts.set(place + 1, before);
                if let Some([first, second]) = self.propositions.get_mut(place..=place + 1) {
                    core::mem::swap(first, second);
                }
            }
        }
    }

    /// Refuses a way that requires or avoids the goal itself.
    fn check_way(&self) -> Result<(), TaskTextError> {
        for (_, avoided) in self.way().filter(|&(part, _)| part == Part::Avoiding) {
            // Itself, and another part.
            if self.parts().filter(|&(_, same)| same == avoided).count() > 1 {
                return Err(TaskTextError::AvoidsGoal);
            }
        }
        for (position, (part, proposition)) in self.way().enumerate() {
            let mut others = self.way().skip(position + 1);
            let in_way = others.any(|(other, same)| same == proposition && !matches!((part, other), (Part::Before(_), Part::Before(_))));
            if in_way || self.propositions().contains(&proposition) && !matches!(part, Part::Before(_)) {
                return Err(TaskTextError::SaysNothing);
            }
        }
        Ok(())
    }

    fn add_variable(&mut self, class: ClassId) -> Result<(), CapacityError> {
        self.variables.push(class).map_err(|_| CapacityError::full(Capacity::VariablesPerTask, VARIABLES_PER_TASK))
    }

    fn add(&mut self, proposition: LiftedProposition, part: Part) -> Result<(), CapacityError> {
        self.parts.set(self.propositions.len(), part);
        self.propositions.push(proposition).map_err(|_| CapacityError::full(Capacity::PropositionsPerTask, PROPOSITIONS_PER_TASK))
    }

    /// The conjunction; with a way, that of the goal.
    pub fn propositions(&self) -> &[LiftedProposition] {
        let goal = (0..self.propositions.len()).take_while(|&position| self.parts.get(position) == Part::Goal).count();
        self.propositions.get(..goal).unwrap_or(&[])
    }

    /// Whether it has a [way](super::Way).
    pub fn has_way(&self) -> bool {
        self.way().next().is_some()
    }

    /// The parts of its way, in the order of the text.
    pub fn way(&self) -> impl Iterator<Item = (Part, LiftedProposition)> + Clone + '_ {
        EachPart { lifted: self, next: 0, of_way: true }
    }

    /// The goal's propositions, then those of its way.
    pub fn parts(&self) -> impl Iterator<Item = (Part, LiftedProposition)> + Clone + '_ {
        EachPart { lifted: self, next: 0, of_way: false }
    }

    /// The number of uses of a variable.
    pub(super) fn uses(&self, variable: u8) -> usize {
        self.propositions.iter().flat_map(|part| &part.variables).filter(|&&other| other == variable).count()
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

/// The text before and after the first `separator`, an ASCII character. The standard library's split would bring panicking code into a
/// controller's flash.
fn split_at_byte(text: &str, separator: u8) -> Option<(&str, &str)> {
    let at = text.bytes().position(|byte| byte == separator)?;
    Some((text.get(..at)?, text.get(at + 1..)?))
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

/// Iterates over the parts of a lifted task. One function for all callers: each would compile adapters of its own.
#[derive(Clone)]
struct EachPart<'l> {
    lifted: &'l LiftedTask,
    next: usize,
    /// Whether the goal is left out.
    of_way: bool,
}

impl Iterator for EachPart<'_> {
    type Item = (Part, LiftedProposition);

    #[cfg_attr(target_family = "wasm", inline(never))]
    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let position = self.next;
            let &proposition = self.lifted.propositions.get(position)?;
            self.next = position.saturating_add(1);
            let part = self.lifted.parts.get(position);
            if !(self.of_way && part == Part::Goal) {
                return Some((part, proposition));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::home::SCHEMA;
    use std::string::ToString;

    #[test]
    fn a_proposition_alone_equals_its_text() {
        let single = LiftedTask::single(crate::home::BLOCK_IN_ROOM, &SCHEMA).unwrap();
        assert_eq!(LiftedTask::parse("blockInRoom( ?o , ?r )", &SCHEMA), Ok(single));
    }

    #[test]
    fn a_task_that_is_written_as_numbers_equals_its_text() {
        let read = LiftedTask::parse("agentInRoom(?a, ?r) & blockInRoom(?o, ?r)", &SCHEMA).unwrap();
        assert_eq!(LiftedTask::written(read.propositions(), read.variables(), &SCHEMA), Ok(read.clone()));
        let variables = [ClassId::new(0); VARIABLES_PER_TASK + 1];
        assert_eq!(LiftedTask::written(&[], &variables, &SCHEMA).unwrap_err().capacity, Capacity::VariablesPerTask);
    }

    #[test]
    fn what_cannot_be_a_task_is_refused() {
        let refused = |text| LiftedTask::parse(text, &SCHEMA).unwrap_err();
        assert_eq!(refused(""), TaskTextError::Form);
        assert_eq!(refused("blockInRoom(?o"), TaskTextError::Form);
        assert_eq!(refused("blockInRoom(?o, ?r) and more"), TaskTextError::Form);
        assert_eq!(refused("blockInRoom(?o, ?r) &"), TaskTextError::Form);
        assert_eq!(refused("blockInRoom(?o, ?r))"), TaskTextError::Form);
        assert_eq!(refused("blöckInRoom(?o, ?r)"), TaskTextError::UnknownProposition { proposition: 0 });
        assert_eq!(refused("blockInRoom(o, r)"), TaskTextError::Form);
        let unknown = refused("blockInRoom(?o, ?r) & flies(?a)");
        assert_eq!(unknown, TaskTextError::UnknownProposition { proposition: 1 });
        assert_eq!(unknown.to_string(), "the domain has no propositional function with the name that proposition 2 has");
        assert_eq!(refused("blockInRoom(?o)"), TaskTextError::ArgumentCount { proposition: 0, given: 1, wanted: 2 });
        assert_eq!(refused("blockInRoom(?x, ?x)"), TaskTextError::ClassConflict { proposition: 0, argument: 1 });
        let five = "blockInRoom(?o, ?r) & blockInRoom(?o, ?r) & blockInRoom(?o, ?r) & blockInRoom(?o, ?r) & blockInRoom(?o, ?r)";
        assert!(matches!(refused(five), TaskTextError::Capacity(_)));
    }
}
