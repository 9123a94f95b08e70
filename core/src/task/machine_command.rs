//! Machine commands: a task and a constraint as a sentence of machine tokens, from which a command is translated.
//!
//! `blockInRoom block room blockIsYellow block roomIsRed room`: the lifted task's propositions and the constraint's, each followed by the
//! classes of its arguments. [`TokenOrder`] defines the order.

use super::constraint::{Fact, facts, sort};
use super::{GroundedTask, LiftedProposition, LiftedTask, Part};
use crate::capacity::{Capacity, CapacityError, FACTS_PER_TASK, NAME_BYTES, TOKENS_PER_COMMAND};
use crate::oomdp::{Domain, Schema};
use crate::symbols::{Symbol, Symbols};
use heapless::{String, Vec};

/// The machine tokens of one machine command.
pub type Tokens = Vec<Symbol, TOKENS_PER_COMMAND, u8>;

/// The position of a constraint's facts in a machine command.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TokenOrder {
    /// After all propositions of the task, by attribute and value (the reference). Two commands with exchanged colours, such as "the agent
    /// in the red room, the block in the blue one", then have the same machine command.
    #[default]
    Attributes,
    /// Each after the first proposition of the task that has its object as an argument, in the order of the arguments. The position of a
    /// fact identifies its object.
    Propositions,
}

/// All machine commands of one task: the tokens of its propositions, and those of each fact that a constraint may add.
#[derive(Clone, Debug)]
pub struct Expression {
    head: Tokens,
    facts: Vec<[Symbol; 2], FACTS_PER_TASK, u8>,
    /// The number of head tokens before each fact, in rising order.
    places: Vec<u8, FACTS_PER_TASK, u8>,
}

impl Expression {
    /// The machine commands of `task`; their tokens are interned in `tokens`. A fact whose token finds no room there is left out: no
    /// command can mention it until other tokens are forgotten (see [`forgetting`](crate::language::forgetting)).
    ///
    /// # Errors
    /// A [`CapacityError`] if `tokens` has no room for the task's own propositions and classes, or the task has too many facts.
    pub fn new<D: Domain>(
        domain: &D,
        lifted: &LiftedTask,
        task: &GroundedTask,
        order: TokenOrder,
        tokens: &mut Symbols<'_>,
    ) -> Result<Self, CapacityError> {
        let schema = domain.world().schema;
        let mut expression = Self { head: head(&schema, lifted, tokens)?, facts: Vec::new(), places: Vec::new() };
        let mut facts = facts(domain, lifted, task)?;
        if order == TokenOrder::Propositions {
            sort(&mut facts, |fact| (place(domain, lifted, task, fact), fact.attribute));
        } else if lifted.has_way() {
            sort(&mut facts, |fact| after_goal(domain, lifted, task, fact));
        }
        let mut interning = Interning::UNBOUNDED;
        for fact in &facts {
            let Some(attribute) = schema.attributes.get(usize::from(fact.attribute)) else { continue };
            let Some(carrier) = attribute.carriers.get(usize::from(fact.carrier)) else { continue };
            let value = domain.world().objects.value(fact.object, usize::from(fact.attribute));
            let class = tokens.intern(schema.class_name(carrier.class))?;
            let pair = match interning.intern(carrier.prefix, value, tokens) {
                Ok(token) => [token, class],
                Err(error) if matches!(error.capacity, Capacity::Tokens | Capacity::TokenBytes) => continue,
                Err(error) => return Err(error),
            };
            let place_of_fact = match order {
                TokenOrder::Attributes if lifted.has_way() => after_goal(domain, lifted, task, fact),
                TokenOrder::Attributes => expression.head.len() as u8,
                TokenOrder::Propositions => place(domain, lifted, task, fact).0,
            };
            let _ = expression.facts.push(pair);
            let _ = expression.places.push(place_of_fact);
        }
        Ok(expression)
    }

    /// The number of constraints: two to the power of the number of facts.
    pub fn constraints(&self) -> u16 {
        1 << self.facts.len().min(FACTS_PER_TASK)
    }

    /// The machine command of one constraint; bit i of `constraint` says whether it has the i-th fact.
    ///
    /// # Errors
    /// A [`CapacityError`] if it has too many tokens.
    pub fn machine_command(&self, constraint: u16) -> Result<Tokens, CapacityError> {
        let mut command = Tokens::new();
        self.write_machine_command(constraint, &mut command)?;
        Ok(command)
    }

    /// Like [`machine_command`](Self::machine_command), but replaces the contents of `command`.
    ///
    /// # Errors
    /// A [`CapacityError`] if it has too many tokens.
    pub(crate) fn write_machine_command(&self, constraint: u16, command: &mut Tokens) -> Result<(), CapacityError> {
        command.clear();
        let mut head = self.head.iter();
        let mut taken = 0;
        for (position, (pair, &place_of_fact)) in self.facts.iter().zip(&self.places).enumerate() {
            if constraint.checked_shr(position as u32).unwrap_or(0) & 1 == 0 {
                continue;
            }
            for &token in head.by_ref().take(usize::from(place_of_fact).saturating_sub(taken)) {
                push(command, token)?;
            }
            taken = taken.max(usize::from(place_of_fact));
            for &token in pair {
                push(command, token)?;
            }
        }
        for &token in head {
            push(command, token)?;
        }
        Ok(())
    }
}

/// The tokens of a lifted task's propositions and their classes, interned in `tokens`. The way's tokens follow the goal's, each after the
/// word for its part.
pub(crate) fn head(schema: &Schema<'_>, lifted: &LiftedTask, tokens: &mut Symbols<'_>) -> Result<Tokens, CapacityError> {
    let mut head = Tokens::new();
    for (connective, part) in parts(lifted) {
        if let Some(connective) = connective {
            push(&mut head, tokens.intern(connective)?)?;
        }
        push(&mut head, tokens.intern(schema.proposition_name(part.proposition))?)?;
        for &class in schema.parameters(part.proposition) {
            push(&mut head, tokens.intern(schema.class_name(class))?)?;
        }
    }
    Ok(head)
}

/// A lifted task's propositions, the goal's first, with the token before each.
fn parts(lifted: &LiftedTask) -> impl Iterator<Item = (Option<&'static str>, LiftedProposition)> + '_ {
    let mut last = Part::Goal;
    let way = lifted.way().map(move |(part, proposition)| {
        let connective = match part {
            Part::Through(_) | Part::Avoiding if part == last => Some("or"),
            Part::Through(_) => Some("through"),
            Part::Avoiding => Some("avoiding"),
            Part::Before(_) if part == last => None,
            Part::Before(_) => Some("after"),
            Part::Goal => None,
        };
        last = part;
        (connective, proposition)
    });
    lifted.propositions().iter().map(|&part| (None, part)).chain(way)
}

/// The first proposition with a fact's object as an argument: the number of tokens up to its end, and the argument's position.
fn place<D: Domain>(domain: &D, lifted: &LiftedTask, task: &GroundedTask, fact: &Fact) -> (u8, u8) {
    let mut end = 0_usize;
    for (connective, part) in parts(lifted) {
        let parameters = domain.world().schema.parameters(part.proposition).len();
        end += parameters + 1 + usize::from(connective.is_some());
        let arguments = task.grounded(part).arguments;
        if let Some(argument) = arguments.iter().take(parameters).position(|&object| object == fact.object) {
            return (end as u8, argument as u8);
        }
    }
    (end as u8, 0)
}

/// The number of tokens before a fact, if a task has a way and facts are ordered by attribute: those of the goal, or those up to the part
/// of the way in which its object first occurs.
fn after_goal<D: Domain>(domain: &D, lifted: &LiftedTask, task: &GroundedTask, fact: &Fact) -> u8 {
    let parameters = |part: &LiftedProposition| domain.world().schema.parameters(part.proposition).len() + 1;
    let goal: usize = lifted.propositions().iter().map(parameters).sum();
    place(domain, lifted, task, fact).0.max(goal as u8)
}

fn push(command: &mut Tokens, token: Symbol) -> Result<(), CapacityError> {
    command.push(token).map_err(|_| CapacityError::full(Capacity::TokensPerCommand, TOKENS_PER_COMMAND))
}

/// `roomIs` and `red` make `roomIsRed`. A first letter beyond ASCII stays as it is: the name is unique all the same, and a table of all
/// capitals takes twelve kilobytes.
pub(crate) fn attribute_token(prefix: &str, value: &str) -> Result<String<NAME_BYTES>, CapacityError> {
    let too_long = |_| CapacityError::new(Capacity::NameBytes, NAME_BYTES, prefix.len().saturating_add(value.len()));
    let mut token = String::new();
    token.push_str(prefix).map_err(too_long)?;
    let mut letters = value.chars();
    if let Some(first) = letters.next() {
        token.push(first.to_ascii_uppercase()).map_err(too_long)?;
    }
    token.push_str(letters.as_str()).map_err(too_long)?;
    Ok(token)
}

/// The interning of many tokens of attributes: a description needs dozens.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interning {
    /// The token before, near which the next one is looked for.
    #[cfg(feature = "ways")]
    near: Symbol,
    /// The tokens that may be looked for yet. Without the feature `ways` there is no end of them: such robots have few facts, and little
    /// room for code.
    #[cfg(feature = "ways")]
    left: u32,
}

impl Interning {
    /// Of any number of tokens.
    #[cfg(feature = "ways")]
    pub(super) const UNBOUNDED: Self = Self::at_most(u32::MAX);
    /// Of any number of tokens.
    #[cfg(not(feature = "ways"))]
    pub(super) const UNBOUNDED: Self = Self {};

    /// Of about so many tokens.
    #[cfg(feature = "ways")]
    pub(super) const fn at_most(tokens: u32) -> Self {
        Self { near: Symbol(0), left: tokens }
    }

    /// Whether as many tokens were looked for as may be.
    #[cfg(feature = "ways")]
    pub(super) const fn is_spent(self) -> bool {
        self.left == 0
    }

    /// The symbol of an [`attribute_token`].
    ///
    /// # Errors
    /// A [`CapacityError`] if there is no room.
    #[cfg(not(feature = "ways"))]
    #[expect(clippy::unused_self, reason = "as with the feature")]
    pub(super) fn intern(&mut self, prefix: &str, value: &str, tokens: &mut Symbols<'_>) -> Result<Symbol, CapacityError> {
        tokens.intern(&attribute_token(prefix, value)?)
    }

    /// The symbol of an [`attribute_token`]. One that is known is found without making its text.
    ///
    /// # Errors
    /// A [`CapacityError`] if there is no room.
    #[cfg(feature = "ways")]
    pub(super) fn intern(&mut self, prefix: &str, value: &str, tokens: &mut Symbols<'_>) -> Result<Symbol, CapacityError> {
        self.left = self.left.saturating_sub(1);
        let (prefix, value) = (prefix.as_bytes(), value.as_bytes());
        let (first, rest) = value.split_at_checked(1).unwrap_or((&[], &[]));
        let capital = first.first().map(u8::to_ascii_uppercase);
        let last = rest.last().or(capital.as_ref()).or(prefix.last());
        let length = prefix.len().saturating_add(value.len());
        let known = tokens.read().find_near(self.near, length, last, |token| {
            let after = token.strip_suffix(rest).and_then(|token| token.strip_suffix(capital.as_slice()));
            after.is_some_and(|token| token == prefix)
        });
        self.near = match known {
            Some(known) => known,
            None => tokens.add([prefix, capital.as_slice(), rest])?,
        };
        Ok(self.near)
    }
}

#[cfg(all(test, feature = "ways"))]
mod tests {
    use super::*;

    #[test]
    fn a_token_that_is_interned_in_parts_is_the_same_as_with_its_text() {
        let (mut bytes, mut ends, mut len) = ([0; 96], [0; 9], 0);
        let mut tokens = Symbols::new(&mut bytes, &mut ends, &mut len, Capacity::Tokens, Capacity::TokenBytes);
        let mut interning = Interning::at_most(12);
        for value in ["leftmost", "first", "", "é", "fast", "leftmost", "Red", "red", "F", "leftmosT", "first"] {
            let text = attribute_token("is", value).unwrap();
            let before = tokens.read().find(&text);
            let interned = interning.intern("is", value, &mut tokens).unwrap();
            assert_eq!(tokens.read().text(interned), text.as_str());
            assert!(before.is_none_or(|before| before == interned), "{value}");
            assert_eq!(tokens.intern(&text), Ok(interned));
        }
        assert!(!interning.is_spent());
        assert!(interning.intern("is", "new", &mut tokens).is_ok() && interning.is_spent());
        let long = "a".repeat(NAME_BYTES);
        assert_eq!(Interning::at_most(1).intern("is", &long, &mut tokens).unwrap_err(), attribute_token("is", &long).unwrap_err());
    }
}
