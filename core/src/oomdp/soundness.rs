//! Checks that a domain keeps the rules of [`Domain`].

use super::{Action, ClassId, Domain, MOST_COST, ObjectId, PropositionId};
#[cfg(feature = "alloc")]
use super::{GroundProposition, Proposition, Schema, World};
use crate::capacity::{ARGUMENTS, ATTRIBUTES};
#[cfg(feature = "alloc")]
use alloc::{
    collections::{BTreeSet, VecDeque},
    vec::Vec,
};
use core::fmt;

/// A broken rule of a domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DomainFlaw {
    /// There are more actions than [`Action::MOST`].
    #[error("there are {given} actions, and {} are the most; give several small ones one name", Action::MOST)]
    Actions {
        /// The number of actions.
        given: usize,
    },
    /// The cost of an action is not from 1 to [`MOST_COST`].
    #[error("action {} costs {cost}; a cost must be from 1 to {MOST_COST}", .action.0)]
    Cost {
        /// The action.
        action: Action,
        /// Its cost.
        cost: u8,
    },
    /// An action has no name, or the name of another; `noop` is the name of doing nothing.
    #[error("action {} has no name, the name of another, or noop, which is doing nothing; name it", .action.0)]
    ActionName {
        /// The action.
        action: Action,
    },
    /// A class has no name, or the name of another.
    #[error("class {} has no name, or the name of another; name it", .class.0)]
    ClassName {
        /// The class.
        class: ClassId,
    },
    /// A propositional function has no name, or the name of another.
    #[error("propositional function {} has no name, or the name of another; name it", .proposition.0)]
    PropositionName {
        /// The propositional function.
        proposition: PropositionId,
    },
    /// A propositional function has no argument, more than [`ARGUMENTS`], or one of an unknown class.
    #[error("propositional function {} must have 1 to {ARGUMENTS} arguments, of classes that the schema has", .proposition.0)]
    Parameters {
        /// The propositional function.
        proposition: PropositionId,
    },
    /// There are more attributes than [`ATTRIBUTES`], or one is carried by an unknown class.
    #[error("attribute {attribute} is one of more than {ATTRIBUTES}, or a class carries it that the schema does not have")]
    Attribute {
        /// The attribute, by its position in the schema.
        attribute: usize,
    },
    /// An object is of an unknown class.
    #[error("object {} is of a class that the schema does not have", .object.0)]
    ObjectClass {
        /// The object.
        object: ObjectId,
    },
    /// An object has a value of an attribute that its class does not carry: no words could refer to it.
    #[error(
        "object {} has a value of attribute {attribute}, which its class does not carry; put \"\" in that attribute's place, or add a \
         carrier",
        .object.0
    )]
    Value {
        /// The object.
        object: ObjectId,
        /// The attribute, by its position in the schema.
        attribute: usize,
    },
    /// The number of a state is not below [`Domain::state_count`].
    #[error(
        "a state has the number {number}, and state_count is {count}{}; it must be more than every number, and no step may lead to what \
         is no state",
        Origin(*.from)
    )]
    Number {
        /// The number.
        number: u64,
        /// The result of `state_count`.
        count: u64,
        /// The previous state, by its number, and the action that leads on from it; `None` if it is the start state.
        from: Option<(u64, Action)>,
    },
    /// [`Domain::numbered`] returns another state than the one with the number. Usually, two states have the same number.
    #[error(
        "numbered({number}) is another state than the one with that number{}; give every state a number of its own that numbered turns \
         back, and let no step lead to what is no state",
        Origin(*.from)
    )]
    Numbered {
        /// The number.
        number: u64,
        /// The previous state, by its number, and the action that leads on from it; `None` if it is the start state.
        from: Option<(u64, Action)>,
    },
    /// [`Domain::step`] returns different states when called twice.
    #[error(
        "step leads from state {number} by action {} now to one state and now to another; let it depend on the state alone",
        .action.0
    )]
    Step {
        /// The number of the state.
        number: u64,
        /// The action.
        action: Action,
    },
}

/// Names the previous state and the action that leads on from it.
struct Origin(Option<(u64, Action)>);

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some((number, action)) => write!(f, " (action {} leads to it from state {number})", action.0),
            None => Ok(()),
        }
    }
}

/// Checks the actions against the rules of [`Domain::actions`], except for their names. Called at each command.
pub(crate) fn check_actions<D: Domain>(domain: &D) -> Result<(), DomainFlaw> {
    let actions = domain.actions();
    if actions.len() > Action::MOST {
        return Err(DomainFlaw::Actions { given: actions.len() });
    }
    match actions.iter().position(|kind| !(1..=MOST_COST).contains(&kind.cost)) {
        None => Ok(()),
        Some(position) => Err(DomainFlaw::Cost { action: Action(position as u8), cost: actions.get(position).map_or(0, |kind| kind.cost) }),
    }
}

/// The extent of a [`check`].
#[cfg(feature = "alloc")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Checked {
    /// The number of visited states.
    pub states: usize,
    /// Whether these are all states that the robot can reach.
    pub all: bool,
    /// The first propositional function that holds in none of these states, for any objects, although objects of its classes exist. If you
    /// do not expect that, look at [`Domain::holds`] for it. A function with more than 4,096 groundings is left out.
    pub never_held: Option<PropositionId>,
}

/// A propositional function with more groundings is not watched.
#[cfg(feature = "alloc")]
const MOST_GROUNDINGS: usize = 4_096;

/// Checks the rules of [`Domain`]: its description, and the results of its functions in every state that the actions lead to from `start`,
/// or in the first `most` of them. Otherwise such mistakes show only when the robot behaves strangely, so call it in a test of your robot.
/// It cannot detect states that only you know to be impossible, such as two trams at one stop: compare [`Checked::states`] with the number
/// of states that you expect.
///
/// ```
/// use goodbot::{HeapMemory, home::{Area, Cell, HomeBuilder, Moves}, oomdp::check};
/// let mut memory = HeapMemory::new(&goodbot::Capacities::SMALL);
/// let mut builder = HomeBuilder::new(&mut memory.home);
/// builder.room("room0", Area::new(0, 0, 4, 4), "red")?;
/// builder.agent("agent0", Cell::new(2, 2))?;
/// let (home, start) = builder.build(Moves::Push)?;
/// let checked = check(&home, start, 1_000_000)?;
/// assert!(checked.all && checked.states == 9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The first [`DomainFlaw`] found.
#[cfg(feature = "alloc")]
pub fn check<D: Domain>(domain: &D, start: D::State, most: usize) -> Result<Checked, DomainFlaw> {
    check_description(domain)?;
    let mut seen = BTreeSet::from([check_number(domain, &start, None)?]);
    let mut open = VecDeque::from([start]);
    let mut states: usize = 0;
    // The propositional functions that have not held yet, with all their groundings.
    let mut never_held = ground_propositions(&domain.world());
    while let Some(state) = open.pop_front() {
        if states >= most {
            open.push_back(state);
            break;
        }
        states = states.saturating_add(1);
        never_held.retain(|of_one| !of_one.iter().any(|proposition| domain.holds(proposition, &state)));
        for action in super::own_actions(domain) {
            let next = domain.step(&state, action);
            if domain.step(&state, action) != next {
                return Err(DomainFlaw::Step { number: domain.number(&state), action });
            }
            if let Some(next) = next
                && seen.insert(check_number(domain, &next, Some((domain.number(&state), action)))?)
            {
                open.push_back(next);
            }
        }
    }
    let never_held = never_held.iter().flatten().next().map(|proposition| proposition.proposition);
    Ok(Checked { states, all: open.is_empty(), never_held })
}

/// For each propositional function its groundings with different objects of its classes, if there are any and not too many.
#[cfg(feature = "alloc")]
fn ground_propositions(world: &World<'_>) -> Vec<Vec<GroundProposition>> {
    let of_class = |class: ClassId| world.objects.iter().filter(|(_, object)| object.class == class).count();
    let is_few =
        |kind: &Proposition<'_>| kind.parameters.iter().map(|&class| of_class(class)).fold(1, usize::saturating_mul) <= MOST_GROUNDINGS;
    let of_one = |(position, kind): (usize, &Proposition<'_>)| {
        let mut arguments = Vec::from([Vec::new()]);
        for &class in kind.parameters {
            let with_one_more = |before: &Vec<ObjectId>| {
                let others = world.objects.iter().filter(|(id, object)| object.class == class && !before.contains(id));
                others.map(|(id, _)| before.iter().copied().chain([id]).collect()).collect::<Vec<Vec<ObjectId>>>()
            };
            arguments = arguments.iter().flat_map(with_one_more).collect();
        }
        arguments.iter().map(|objects| GroundProposition::new(PropositionId(position as u8), objects)).collect()
    };
    let few = world.schema.propositions.iter().enumerate().filter(|(_, kind)| is_few(kind));
    few.map(of_one).filter(|of_one: &Vec<_>| !of_one.is_empty()).collect()
}

/// Checks the number of a state, and returns it.
#[cfg(feature = "alloc")]
fn check_number<D: Domain>(domain: &D, state: &D::State, from: Option<(u64, Action)>) -> Result<u64, DomainFlaw> {
    let (number, count) = (domain.number(state), domain.state_count());
    // Without a bound, there is nothing to exceed.
    if number >= count && count != u64::MAX {
        return Err(DomainFlaw::Number { number, count, from });
    }
    if domain.numbered(number) == *state { Ok(number) } else { Err(DomainFlaw::Numbered { number, from }) }
}

#[cfg(feature = "alloc")]
fn check_description<D: Domain>(domain: &D) -> Result<(), DomainFlaw> {
    check_actions(domain)?;
    let actions = domain.actions();
    let mut names = actions.iter().map(|kind| kind.name);
    if let Some(position) = misnamed(names.clone()).or_else(|| names.position(|name| name == "noop")) {
        return Err(DomainFlaw::ActionName { action: Action(position as u8) });
    }
    let World { schema, objects } = domain.world();
    check_schema(&schema)?;
    for (id, object) in objects.iter() {
        if usize::from(object.class.0) >= schema.classes.len() {
            return Err(DomainFlaw::ObjectClass { object: id });
        }
        let carries = |attribute: usize| {
            let carriers = schema.attributes.get(attribute).map_or(&[][..], |attribute| attribute.carriers);
            carriers.iter().any(|carrier| carrier.class == object.class)
        };
        if let Some(attribute) = (0..ATTRIBUTES).find(|&attribute| object.value(attribute).is_some() && !carries(attribute)) {
            return Err(DomainFlaw::Value { object: id, attribute });
        }
    }
    Ok(())
}

#[cfg(feature = "alloc")]
fn check_schema(schema: &Schema<'_>) -> Result<(), DomainFlaw> {
    let is_there = |class: ClassId| usize::from(class.0) < schema.classes.len();
    if let Some(position) = misnamed(schema.classes.iter().map(|class| class.name)) {
        return Err(DomainFlaw::ClassName { class: ClassId(position as u8) });
    }
    if let Some(position) = misnamed(schema.propositions.iter().map(|proposition| proposition.name)) {
        return Err(DomainFlaw::PropositionName { proposition: PropositionId(position as u8) });
    }
    for (position, proposition) in schema.propositions.iter().enumerate() {
        let parameters = proposition.parameters;
        if parameters.is_empty() || parameters.len() > ARGUMENTS || !parameters.iter().all(|&class| is_there(class)) {
            return Err(DomainFlaw::Parameters { proposition: PropositionId(position as u8) });
        }
    }
    for (position, attribute) in schema.attributes.iter().enumerate() {
        if position >= ATTRIBUTES || !attribute.carriers.iter().all(|carrier| is_there(carrier.class)) {
            return Err(DomainFlaw::Attribute { attribute: position });
        }
    }
    Ok(())
}

/// The first name that is empty or repeated.
#[cfg(feature = "alloc")]
fn misnamed<'n>(mut names: impl Iterator<Item = &'n str> + Clone) -> Option<usize> {
    let all = names.clone();
    let mut position: usize = 0;
    names.position(|name| {
        let is_known = all.clone().take(position).any(|before| before == name);
        position += 1;
        name.is_empty() || is_known
    })
}
