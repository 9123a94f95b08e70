//! The description of a world.

use serde::Serialize;

use super::writing::{write_parameters, write_variable};
use crate::session::is_one;
use crate::task_text::{GroundAtomText, LiftedTaskText};
use crate::weights::in_order;

/// A world: its vocabulary and its objects.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
#[serde(tag = "type", rename = "world")]
pub struct WorldFile {
    /// Its name.
    pub name: String,
    /// The classes of objects.
    pub classes: Vec<String>,
    /// Classes below others, each with the one above it: an object of a class is also of those above.
    #[serde(serialize_with = "in_order", skip_serializing_if = "Vec::is_empty")]
    pub parents: Vec<(String, String)>,
    /// The attributes, each with the classes that carry it.
    #[serde(serialize_with = "in_order")]
    pub attributes: Vec<(String, Vec<String>)>,
    /// The propositions, each with the class of each argument.
    #[serde(serialize_with = "in_order")]
    pub propositions: Vec<(String, Vec<String>)>,
    /// The propositions that are variables: for each choice of the first arguments, exactly one last argument holds at a time.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub variables: Vec<String>,
    /// The objects.
    pub objects: Vec<ObjectOfWorld>,
    /// The propositions that hold.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub facts: Vec<GroundAtomText>,
    /// The actions of a robot.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub actions: Vec<ActionOfWorld>,
    /// Facts that follow from others, and that words can mean.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub derived: Vec<DerivedOfWorld>,
    /// The kinds of task that commands may mean.
    pub task_kinds: Vec<LiftedTaskText>,
}

impl WorldFile {
    /// A class and those above it, the nearest first.
    pub fn and_above<'w>(&'w self, class: &'w str) -> impl Iterator<Item = &'w str> {
        std::iter::successors(Some(class), |class| self.parents.iter().find(|(below, _)| below == class).map(|(_, above)| above.as_str()))
    }

    /// Whether a class is another one, or below it.
    pub fn is_a(&self, class: &str, above: &str) -> bool {
        self.and_above(class).any(|known| known == above)
    }
}

/// An object of a world.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ObjectOfWorld {
    /// Its name.
    pub name: String,
    /// Its class.
    pub class: String,
    /// Its values, each with its attribute.
    #[serde(serialize_with = "in_order", skip_serializing_if = "Vec::is_empty")]
    pub attributes: Vec<(String, String)>,
}

/// An action of a world, or one of its cases: the actions of one name are cases of one action, and the first one whose conditions hold takes
/// effect.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ActionOfWorld {
    /// Its name.
    pub name: String,
    /// Its parameters without their `?`, each with its class. Each choice of objects for them is an action of the robot.
    #[serde(serialize_with = "write_parameters", skip_serializing_if = "Vec::is_empty")]
    pub parameters: Vec<(String, String)>,
    /// Propositions that must hold, or must not hold, before it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub conditions: Vec<Literal>,
    /// Propositions that hold, or no longer hold, after it.
    pub effects: Vec<Literal>,
    /// Its cost, 1 to 255.
    #[serde(skip_serializing_if = "is_one")]
    pub cost: u8,
}

/// A fact about an object that follows from others, or one of its cases: it is so where the conditions of one of its entries hold.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct DerivedOfWorld {
    /// Its name, which words come to mean, such as `here`.
    pub name: String,
    /// The variable of the object, without its `?`.
    #[serde(serialize_with = "write_variable")]
    pub of: String,
    /// The class of the object, which follows from the conditions.
    #[serde(skip)]
    pub class: String,
    /// Propositions that must hold, or must not hold, with some objects for their other variables.
    pub conditions: Vec<Literal>,
}

/// A proposition of an action or of a derived fact, or its opposite.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Literal {
    /// Whether the proposition is negated.
    pub negated: bool,
    /// The proposition.
    pub proposition: String,
    /// Its arguments.
    pub terms: Vec<Term>,
}

/// An argument of such a proposition.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Term {
    /// A variable, without its `?`: a parameter, or a variable with a value from a condition.
    Variable(String),
    /// An object.
    Object(String),
}
