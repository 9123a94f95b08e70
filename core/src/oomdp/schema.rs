//! The vocabulary of a domain: object classes, the attributes that objects of a class carry, and propositional functions.
//!
//! The language model knows a domain only by these names, so two robots whose schemas share names share their training data.

use crate::symbols::positions;

positions! {
    /// A class of objects, by its position in [`Schema::classes`].
    ClassId(u8);
    /// A propositional function, by its position in [`Schema::propositions`].
    PropositionId(u8);
}

/// A class of objects: `room`, `block`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Class<'a> {
    /// The machine token of the class.
    pub name: &'a str,
}

impl<'a> Class<'a> {
    /// The class of this name.
    pub const fn new(name: &'a str) -> Self {
        Self { name }
    }
}

/// A class that carries an attribute, and the name of the attribute proposition for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Carrier<'a> {
    /// The class.
    pub class: ClassId,
    /// The text before the capitalised value: `roomIs` makes `roomIsRed`.
    pub prefix: &'a str,
}

impl<'a> Carrier<'a> {
    /// This class carries the attribute, under this name.
    pub const fn new(class: ClassId, prefix: &'a str) -> Self {
        Self { class, prefix }
    }
}

/// An attribute: `color`, carried by rooms and blocks. Its values are data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Attribute<'a> {
    /// The attribute's name in files.
    pub name: &'a str,
    /// The classes that carry it, in the order of machine commands.
    pub carriers: &'a [Carrier<'a>],
}

impl<'a> Attribute<'a> {
    /// The attribute of this name, which these classes carry.
    pub const fn new(name: &'a str, carriers: &'a [Carrier<'a>]) -> Self {
        Self { name, carriers }
    }
}

/// A propositional function over objects: `blockInRoom(block, room)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Proposition<'a> {
    /// The machine token of the proposition.
    pub name: &'a str,
    /// The class of each argument, at most [`ARGUMENTS`](crate::capacity::ARGUMENTS).
    pub parameters: &'a [ClassId],
}

impl<'a> Proposition<'a> {
    /// The propositional function of this name, with the class of each argument.
    pub const fn new(name: &'a str, parameters: &'a [ClassId]) -> Self {
        Self { name, parameters }
    }
}

/// The classes, attributes and propositional functions of a domain.
///
/// ```
/// use goodbot::oomdp::{Attribute, Carrier, Class, ClassId, Proposition, Schema};
/// const ARM: ClassId = ClassId::new(0);
/// const SLOT: ClassId = ClassId::new(1);
/// const SCHEMA: Schema<'static> = Schema {
///     classes: &[Class::new("arm"), Class::new("slot")],
///     attributes: &[Attribute::new("color", &[Carrier::new(SLOT, "slotIs")])],
///     propositions: &[Proposition::new("armAtSlot", &[ARM, SLOT])],
/// };
/// assert_eq!(SCHEMA.class("slot"), Some(SLOT));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Schema<'a> {
    /// The classes.
    pub classes: &'a [Class<'a>],
    /// The attributes, in the order of machine commands, at most [`ATTRIBUTES`](crate::capacity::ATTRIBUTES).
    pub attributes: &'a [Attribute<'a>],
    /// The propositional functions.
    pub propositions: &'a [Proposition<'a>],
}

impl<'a> Schema<'a> {
    /// The class with this name.
    pub fn class(&self, name: &str) -> Option<ClassId> {
        self.classes.iter().position(|class| class.name == name).map(|position| ClassId(position as u8))
    }

    /// The propositional function with this name.
    pub fn proposition(&self, name: &str) -> Option<PropositionId> {
        self.propositions.iter().position(|proposition| proposition.name == name).map(|position| PropositionId(position as u8))
    }

    /// The name of a class; empty for one that the schema does not have.
    pub fn class_name(&self, class: ClassId) -> &'a str {
        self.classes.get(usize::from(class.0)).map_or("", |class| class.name)
    }

    /// The name of a propositional function; empty for one that the schema does not have.
    pub fn proposition_name(&self, proposition: PropositionId) -> &'a str {
        self.propositions.get(usize::from(proposition.0)).map_or("", |proposition| proposition.name)
    }

    /// The argument classes of a propositional function; none for one that the schema does not have.
    pub fn parameters(&self, proposition: PropositionId) -> &'a [ClassId] {
        self.propositions.get(usize::from(proposition.0)).map_or(&[], |proposition| proposition.parameters)
    }
}
