//! Machine commands: a task and a constraint as a sentence of machine tokens, which a command is translated from.
//!
//! `blockInRoom block room blockIsYellow block roomIsRed room`: the lifted task's propositions, then the constraint's, each followed by
//! the classes of its arguments.

use super::constraint::facts;
use super::{GroundedTask, LiftedTask};
use crate::capacity::{Capacity, CapacityError, FACTS_PER_TASK, NAME_BYTES, TOKENS_PER_COMMAND};
use crate::oomdp::Domain;
use crate::symbols::{Symbol, Symbols};
use heapless::{String, Vec};

/// The machine tokens of one machine command.
pub type Tokens = Vec<Symbol, TOKENS_PER_COMMAND>;

/// All machine commands of one task: the tokens of its propositions, and those of each fact that a constraint may add.
#[derive(Clone, Debug)]
pub struct Expression {
    head: Tokens,
    facts: Vec<[Symbol; 2], FACTS_PER_TASK>,
}

impl Expression {
    /// The machine commands of `task`; their tokens are interned in `tokens`.
    ///
    /// # Errors
    /// A [`CapacityError`] where `tokens` is full or the task has too many facts.
    pub fn new<D: Domain + ?Sized>(
        domain: &D,
        lifted: &LiftedTask,
        task: &GroundedTask,
        tokens: &mut Symbols<'_>,
    ) -> Result<Self, CapacityError> {
        let schema = domain.schema();
        let mut head = Tokens::new();
        for part in &lifted.propositions {
            push(&mut head, tokens.intern(schema.proposition_name(part.proposition))?)?;
            for &class in schema.parameters(part.proposition) {
                push(&mut head, tokens.intern(schema.class_name(class))?)?;
            }
        }
        let mut expression = Self { head, facts: Vec::new() };
        for fact in facts(domain, lifted, task)? {
            let Some(attribute) = schema.attributes.get(usize::from(fact.attribute)) else { continue };
            let Some(carrier) = attribute.carriers.get(usize::from(fact.carrier)) else { continue };
            let value = domain.objects().value(fact.object, usize::from(fact.attribute));
            let pair = [tokens.intern(&attribute_token(carrier.prefix, value)?)?, tokens.intern(schema.class_name(carrier.class))?];
            let _ = expression.facts.push(pair);
        }
        Ok(expression)
    }

    /// How many constraints there are: two to the power of the number of facts.
    pub fn constraints(&self) -> u16 {
        1 << self.facts.len().min(FACTS_PER_TASK)
    }

    /// The machine command of one constraint; bit i of `constraint` says whether it has the i-th fact.
    ///
    /// # Errors
    /// A [`CapacityError`] where it has too many tokens.
    pub fn machine_command(&self, constraint: u16) -> Result<Tokens, CapacityError> {
        let mut command = self.head.clone();
        for (position, pair) in self.facts.iter().enumerate() {
            if constraint.checked_shr(position as u32).unwrap_or(0) & 1 == 1 {
                for &token in pair {
                    push(&mut command, token)?;
                }
            }
        }
        Ok(command)
    }
}

fn push(command: &mut Tokens, token: Symbol) -> Result<(), CapacityError> {
    command.push(token).map_err(|_| CapacityError::full(Capacity::TokensPerCommand, TOKENS_PER_COMMAND))
}

/// `roomIs` and `red` make `roomIsRed`. A first letter beyond ASCII stays as it is: it names the value as well, and the table of all
/// capitals is twelve kilobytes.
fn attribute_token(prefix: &str, value: &str) -> Result<String<NAME_BYTES>, CapacityError> {
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
