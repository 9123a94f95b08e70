//! Worlds of any kind, and commands in them.
//!
//! A world is one JSON object with `"type":"world"`. It has classes, attributes, propositions and objects, and the kinds of task that
//! commands may mean:
//!
//! | field | contents |
//! |---|---|
//! | `name` | the world's name |
//! | `classes` | a list of names |
//! | `parents` | from a class to the one above it: its objects serve where objects of that one are wanted; may be absent |
//! | `attributes` | from each attribute to the list of classes that carry it |
//! | `propositions` | from each proposition to the list of its arguments' classes |
//! | `objects` | a list of objects with `name`, `class` and `attributes`: from attributes to values |
//! | `facts` | propositions that hold, such as `"p(a,b)"`; may be absent |
//! | `task_kinds` | a list of kinds of task, such as `"p(?x,?y)"` |
//! | `license`, `source` | licence and origin; may be absent |
//! | `variables` | propositions of which exactly one last argument holds at a time, such as `at(robot,room)`; may be absent |
//! | `actions` | the actions of a robot; may be absent |
//! | `derived` | facts about an object that follow from others, and that words can mean; may be absent |
//!
//! An action has a `name`, `parameters` (from variables such as `?room` to classes), `conditions` and `effects` (lists of propositions with
//! variables or objects; `!` negates a proposition) and a `cost` of 1 to 255. Only `name` and `effects` are required. If a variable of its
//! conditions is no parameter, it gets a value with which they hold. Further actions of the same name are further cases of it, of the same
//! cost: the first case whose conditions hold takes effect.
//!
//! A derived fact has a `name`, `of`, the variable of the object that it is about, and `conditions` as an action has. It is so for each object
//! with which they hold. Entries of one name are further cases of it.
//!
//! A log of worlds has worlds, and commands and sessions in worlds on earlier lines. A world is valid until another of the same name. A
//! session is as in a log of homes, but in place of `environment` it has `world`, the world's name, and `facts`, the propositions that hold
//! at the time of the command. Its `kind`, `id`, `command`, `intended`, `strategies`, `utterance`, `after`, `conversation` and
//! `closed_words` are as there. A command:
//!
//! | field of a command | contents |
//! |---|---|
//! | `world` | the name of its world |
//! | `command` | the words |
//! | `intended` | the propositions that are to hold |
//! | `id` | the command's name; may be absent |
//! | `group` | commands of one group, such as one speaker's, stay together in a split of the data; may be absent |
//! | `facts` | propositions that hold, if they differ from the world's; may be absent |
//! | `ended` | propositions that are to hold no longer; may be absent |
//! | `before` | the ids of earlier commands of the same sequence; may be absent |
//! | `language`, `part` | for people; may be absent |
//!
//!
//! ```
//! use goodbot_formats::world::{Line, WorldReader};
//!
//! let log = r#"
//! {"type":"world","name":"hall","classes":["lamp"],"attributes":{"color":["lamp"]},"propositions":{"on":["lamp"]},"objects":[{"name":"a","class":"lamp","attributes":{"color":"red"}}],"task_kinds":["on(?l)"]}
//! {"type":"command","world":"hall","command":"the red one","intended":["on(a)"]}
//! "#;
//! let lines: Vec<Line> = WorldReader::new(log.as_bytes()).collect::<Result<_, _>>()?;
//! let [Line::World(world), Line::Command(command)] = lines.as_slice() else { panic!("a world and a command") };
//! assert_eq!((world.objects.len(), command.intended[0].to_string()), (1, "on(a)".to_owned()));
//! # Ok::<(), goodbot_formats::FormatError>(())
//! ```

mod file;
mod reader;
mod session;

pub use file::{ActionOfWorld, DerivedOfWorld, Literal, ObjectOfWorld, Term, WorldFile};
pub use reader::{Line, WorldReader, field_line};
pub use session::{CommandRecord, SessionInWorld};

use crate::error::{FormatError, not_in_world, not_json, quoted, wrong_class};
use crate::json::{Node, Source};
use crate::task_text::{GroundAtomText, TaskTextError, is_usable_name};
use serde::ser::{Serialize, Serializer};
use std::collections::BTreeMap;

/// Writes the parameters of an action, with their `?`, as an object.
pub(super) fn write_parameters<S: Serializer>(parameters: &[(String, String)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(parameters.iter().map(|(name, class)| (format!("?{name}"), class)))
}

/// Writes a variable, with its `?`.
pub(super) fn write_variable<S: Serializer>(variable: &str, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&format_args!("?{variable}"))
}

impl Serialize for Literal {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl std::fmt::Display for Literal {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let sign = if self.negated { "!" } else { "" };
        write!(f, "{sign}{}(", self.proposition)?;
        for (position, term) in self.terms.iter().enumerate() {
            let comma = if position > 0 { "," } else { "" };
            match term {
                Term::Variable(name) => write!(f, "{comma}?{name}")?,
                Term::Object(name) => write!(f, "{comma}{name}")?,
            }
        }
        f.write_str(")")
    }
}

impl WorldFile {
    /// The world on one line, without a line end. Licence and source are left out.
    ///
    /// # Errors
    /// An error if the line could not be read again.
    pub fn to_json_line(&self) -> Result<String, FormatError> {
        let line = serde_json::to_string(self).map_err(|error| FormatError::new(1, not_json(error)))?;
        Self::read(&Source::new(&line, 1).root()?.object()?)?;
        Ok(line)
    }
}

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
