//! The names and propositions of a world, checked against its classes.

use std::collections::BTreeMap;

use super::file::WorldFile;
use crate::error::{FormatError, not_in_world, wrong_class};
use crate::json::Node;
use crate::quoted::quoted;
use crate::task_text::{GroundAtomText, TaskTextError, is_usable_name};

/// A world with a table of its objects' classes.
pub(super) struct WorldClasses<'w> {
    world: &'w WorldFile,
    classes: BTreeMap<&'w str, &'w str>,
}

impl<'w> WorldClasses<'w> {
    pub(super) fn of(world: &'w WorldFile) -> Self {
        WorldClasses { world, classes: world.objects.iter().map(|object| (object.name.as_str(), object.class.as_str())).collect() }
    }

    pub(super) const fn world(&self) -> &'w WorldFile {
        self.world
    }

    pub(super) fn class_of(&self, object: &str) -> Option<&'w str> {
        self.classes.get(object).copied()
    }

    /// Propositions about the world's objects.
    pub(super) fn atoms(&self, list: &Node<'_>) -> Result<Vec<GroundAtomText>, FormatError> {
        list.list()?.iter().map(|node| self.atom(node)).collect()
    }

    fn atom(&self, node: &Node<'_>) -> Result<GroundAtomText, FormatError> {
        let atom: GroundAtomText = node.task()?;
        if atom.is_negated() {
            return Err(node.error("is a negated proposition; leave it out: propositions that are not listed do not hold"));
        }
        let parameters = self.world.parameters(node, atom.function(), atom.arguments().len())?;
        for (argument, class) in atom.arguments().iter().zip(parameters) {
            match self.classes.get(argument.as_str()) {
                None => return Err(node.error(not_in_world("object", argument))),
                Some(known) if !self.world.is_a(known, class) => {
                    return Err(node.error(wrong_class(argument, class)));
                }
                Some(_) => {}
            }
        }
        Ok(atom)
    }
}

impl WorldFile {
    /// The classes of a proposition's arguments, if their number is right.
    pub(super) fn parameters(&self, node: &Node<'_>, function: &str, given: usize) -> Result<&[String], FormatError> {
        match self.propositions.iter().find(|(name, _)| name == function) {
            None => Err(node.error(not_in_world("proposition", function))),
            Some((_, parameters)) if parameters.len() != given => Err(node.error(format!(
                "{} was given {given} arguments, and it has {} in this world; write that many",
                quoted(function),
                parameters.len()
            ))),
            Some((_, parameters)) => Ok(parameters),
        }
    }
}

/// A name that a task can have.
pub(super) fn usable(node: &Node<'_>) -> Result<String, FormatError> {
    let name = node.text()?;
    if is_usable_name(&name) { Ok(name) } else { Err(node.error(TaskTextError::UnusableName { name }.to_string())) }
}
