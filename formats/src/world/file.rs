//! The description of a world: its objects, facts and kinds of task, the actions of a robot with conditions, effects and costs, and derived facts.

use super::{WorldClasses, usable, write_parameters, write_variable};
use crate::error::{FormatError, excerpt, not_in_world, quoted, wrong_class};
use crate::json::Node;
use crate::session::is_one;
use crate::task_text::{GroundAtomText, LiftedTaskText, TaskTextError};
use crate::weights::in_order;
use serde::Serialize;
use std::collections::BTreeMap;

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

/// Replaces `?` while a proposition is read: a character of Unicode's private area.
const VARIABLE: &str = "\u{e000}";

/// The costs that an action can have.
const COSTS: std::ops::RangeInclusive<u64> = 1..=255;

impl ActionOfWorld {
    pub(super) fn read(node: &Node<'_>, known: &WorldClasses<'_>) -> Result<Self, FormatError> {
        let fields = node.clone().object()?;
        fields.only(&["name", "parameters", "conditions", "effects", "cost"])?;
        let name = usable(&fields.required("name")?)?;
        let mut classes: BTreeMap<String, String> = BTreeMap::new();
        let mut parameters = Vec::new();
        if let Some(node) = fields.optional("parameters") {
            for (variable, class) in node.object()?.entries() {
                let text = class.text()?;
                let variable = named_variable(&class, variable)?;
                if !known.world().classes.contains(&text) {
                    return Err(class.error(not_in_world("class", &text)));
                }
                classes.insert(variable.clone(), text.clone());
                parameters.push((variable, text));
            }
        }
        let mut conditions = Vec::new();
        if let Some(list) = fields.optional("conditions") {
            for node in list.list()? {
                conditions.push(known.literal(&node, &mut classes, true)?);
            }
        }
        let mut effects = Vec::new();
        let effects_node = fields.required("effects")?;
        for node in effects_node.list()? {
            let effect = known.literal(&node, &mut classes, false)?;
            if effect.negated && known.world().variables.contains(&effect.proposition) {
                return Err(node.error(format!(
                    "{} is a variable and always has a value; write an effect that gives it another value",
                    quoted(&effect.proposition)
                )));
            }
            effects.push(effect);
        }
        if effects.is_empty() {
            return Err(effects_node.error("are none: an action that changes nothing is of no use; write what holds after it"));
        }
        let cost = match fields.optional("cost") {
            None => 1,
            Some(node) => match node.count()? {
                cost if COSTS.contains(&cost) => cost as u8,
                cost => return Err(node.error(format!("{cost} is no cost of an action; write a whole number from 1 to 255"))),
            },
        };
        Ok(Self { name, parameters, conditions, effects, cost })
    }
}

/// The name of a variable, without its `?`.
fn named_variable(node: &Node<'_>, text: &str) -> Result<String, FormatError> {
    match text.strip_prefix('?').filter(|name| !name.is_empty()) {
        Some(name) => Ok(name.to_owned()),
        None => Err(node.error(format!("{} is no variable; begin it with ?, like \"?room\"", quoted(text)))),
    }
}

impl DerivedOfWorld {
    pub(super) fn read(node: &Node<'_>, known: &WorldClasses<'_>) -> Result<Self, FormatError> {
        let fields = node.clone().object()?;
        fields.only(&["name", "of", "conditions"])?;
        let name = usable(&fields.required("name")?)?;
        let node = fields.required("of")?;
        let of = named_variable(&node, &node.text()?)?;
        let mut classes = BTreeMap::new();
        let conditions = fields.required("conditions")?.filled_list()?;
        let conditions = conditions.iter().map(|node| known.literal(node, &mut classes, true)).collect::<Result<_, _>>()?;
        match classes.remove(&of) {
            Some(class) => Ok(Self { name, of, class, conditions }),
            None => Err(node.error(format!("?{of} is in no condition; write one about it"))),
        }
    }
}

impl WorldClasses<'_> {
    /// Reads a proposition of an action. Only in conditions may variables be new.
    fn literal(&self, node: &Node<'_>, classes: &mut BTreeMap<String, String>, may_be_new: bool) -> Result<Literal, FormatError> {
        let text = node.text()?;
        // A variable is read as an object whose name no file has.
        let atom: GroundAtomText = text.replace('?', VARIABLE).parse().map_err(|error: TaskTextError| node.error(error.to_string()))?;
        let parameters = self.world().parameters(node, atom.function(), atom.arguments().len())?.to_vec();
        let mut terms = Vec::new();
        for (argument, class) in atom.arguments().iter().zip(parameters) {
            let wrong = |name: &str| Err(node.error(wrong_class(name, &class)));
            if let Some(variable) = argument.strip_prefix(VARIABLE) {
                let known = classes.get(variable);
                let class = match known {
                    Some(known) if self.world().is_a(known, &class) => known.clone(),
                    // The lower of two classes counts. Where an effect needs it, a condition must have it.
                    Some(known) if !(may_be_new && self.world().is_a(&class, known)) => return wrong(&format!("?{variable}")),
                    None if !may_be_new => {
                        return Err(node.error(format!(
                            "?{} has no value: it is no parameter and in no condition; add it to one of them",
                            excerpt(variable, 40)
                        )));
                    }
                    Some(_) | None => class,
                };
                classes.insert(variable.to_owned(), class);
                terms.push(Term::Variable(variable.to_owned()));
            } else {
                match self.class_of(argument) {
                    None => return Err(node.error(not_in_world("object", argument))),
                    Some(other) if !self.world().is_a(other, &class) => return wrong(argument),
                    Some(_) => terms.push(Term::Object(argument.clone())),
                }
            }
        }
        Ok(Literal { negated: atom.is_negated(), proposition: atom.function().to_owned(), terms })
    }
}
