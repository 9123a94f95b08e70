//! The description of a world.

use serde::Serialize;

use super::writing::write_parameters;
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
    /// The kinds of task that commands may mean.
    pub task_kinds: Vec<LiftedTaskText>,
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
    /// Its cost, 1 to 16.
    #[serde(skip_serializing_if = "is_one")]
    pub cost: u8,
}

/// A proposition of an action, or its opposite.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Literal {
    /// Whether the proposition is negated.
    pub negated: bool,
    /// The proposition.
    pub proposition: String,
    /// Its arguments.
    pub terms: Vec<Term>,
}

/// An argument of a proposition of an action.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Term {
    /// A variable, without its `?`: a parameter, or a variable with a value from a condition.
    Variable(String),
    /// An object.
    Object(String),
}
