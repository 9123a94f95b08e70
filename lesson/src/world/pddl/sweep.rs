//! Visits all states that a problem can reach, and finds what holds in all of them.

use super::names::{Named, TWICE, has_one_twice};
use super::reading::{Atom, Cost, Schema};
use super::{PddlError, Text};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

/// The most states to visit, and the most actions with their objects.
const MOST_STATES: usize = 1_000_000;
const MOST_ACTIONS: usize = 20_000;
/// The most objects to try as parameters, for all actions together.
const MOST_TRIES: usize = 100_000;
/// The most actions to look at, and the most to do, in all states together: a problem that is too large is refused within seconds.
const MOST_LOOKS: usize = 200_000_000;
const MOST_DONE: usize = 40_000_000;

/// A predicate and its objects, by their positions.
type Fact = (usize, Vec<usize>);

/// A state: a bit for each fact that can change.
type State = Box<[u64]>;

fn has(state: &State, fact: usize) -> bool {
    state.get(fact / 64).is_some_and(|word| word >> (fact % 64) & 1 == 1)
}

fn set(state: &mut State, fact: usize, holds: bool) {
    if let Some(word) = state.get_mut(fact / 64) {
        *word = *word & !(1 << (fact % 64)) | u64::from(holds) << (fact % 64);
    }
}

/// What becomes one action of a world file.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Kind {
    /// The position of the action in the domain.
    pub schema: usize,
    /// For each parameter, the first one with the same object. In a world from a file, different variables have different objects.
    pub same: Vec<usize>,
    /// The cost.
    pub cost: u64,
}

/// How an action of the world is possible.
#[derive(Debug, Default)]
pub struct Ways {
    /// Whether it ever changes a state.
    is_of_use: bool,
    /// Those that are ever possible.
    all: BTreeSet<usize>,
    /// Those that are possible in one state, if there are several.
    together: HashSet<Vec<usize>>,
}

/// An action with objects for its parameters.
#[derive(Debug)]
struct Ground {
    kind: usize,
    objects: Vec<usize>,
    needs: Vec<usize>,
    forbids: Vec<usize>,
    adds: Vec<usize>,
    deletes: Vec<usize>,
    /// The predicate of an effect with one object for two arguments.
    twice: Option<usize>,
}

/// The findings that hold in every reachable state.
#[derive(Debug)]
pub struct Swept {
    actions: Vec<Ground>,
    kinds: Vec<(Kind, Ways)>,
    /// For each predicate: whether its last argument always has exactly one object for each choice of the others.
    variables: Vec<bool>,
    /// Whether the goal holds in some state.
    pub reaches_goal: bool,
}

impl Swept {
    /// The actions that ever change a state.
    pub fn kinds(&self) -> impl Iterator<Item = (&Kind, &Ways)> {
        self.kinds.iter().filter(|(_, ways)| ways.is_of_use).map(|(kind, ways)| (kind, ways))
    }

    /// Whether the last argument of a predicate always has exactly one object for each choice of the others.
    pub fn is_variable(&self, predicate: usize) -> bool {
        self.variables.get(predicate).copied().unwrap_or(false)
    }

    fn chosen(&self, action: usize, parameters: &[usize]) -> Vec<usize> {
        let objects = self.actions.get(action).map_or(&[][..], |action| &action.objects);
        parameters.iter().filter_map(|&at| objects.get(at).copied()).collect()
    }

    /// How many actions there are if only these parameters count.
    pub fn count(&self, ways: &Ways, parameters: &[usize]) -> usize {
        ways.all.iter().map(|&action| self.chosen(action, parameters)).collect::<HashSet<_>>().len()
    }

    /// Whether these parameters settle the others: in no state do the others leave a choice of effects.
    pub fn settles(&self, ways: &Ways, parameters: &[usize]) -> bool {
        let effect = |&action: &usize| self.actions.get(action).map(|action| (&action.adds, &action.deletes));
        ways.together.iter().all(|possible| {
            let mut effects = HashMap::new();
            possible.iter().all(|action| {
                let effect = effect(action);
                *effects.entry(self.chosen(*action, parameters)).or_insert(effect) == effect
            })
        })
    }
}

/// Visits all states, and tells how many were `visited`.
///
/// # Errors
/// There are too many, or an effect has one object for two arguments.
pub fn sweep(named: &Named<'_>, mut visited: impl FnMut(usize)) -> Result<Swept, PddlError> {
    let too_many = || PddlError {
        text: Text::Problem,
        line: 1,
        message: format!(
            "makes more states or actions than can be looked at ({MOST_STATES} and {MOST_ACTIONS}); take a smaller problem, with fewer objects"
        ),
    };
    let mut grounder = Grounder::of(named);
    for (position, schema) in named.domain.actions.iter().enumerate() {
        grounder.ground(position, schema, &mut BTreeMap::new()).ok_or_else(too_many)?;
    }
    let Grounder { facts, actions, kinds, start, changed, .. } = grounder;
    let mut first: State = vec![0; facts.all.len().div_ceil(64)].into();
    start.iter().filter_map(|fact| facts.numbers.get(fact)).for_each(|&fact| set(&mut first, fact, true));
    let goal: Option<Vec<usize>> = named
        .problem
        .goal
        .iter()
        .filter_map(|atom| fact(named, atom, &BTreeMap::new()))
        .filter(|fact| changed.contains(&fact.0) || !start.contains(fact))
        .map(|fact| facts.numbers.get(&fact).copied())
        .collect();
    let mut variables = variables(named, &facts);
    let mut swept = Swept { actions, kinds, variables: vec![], reaches_goal: false };
    let (mut known, mut open, mut looks, mut left) = (HashSet::from([first.clone()]), vec![first], MOST_LOOKS, MOST_DONE);
    while let Some(state) = open.pop() {
        visited(known.len() - open.len());
        swept.reaches_goal |= goal.as_ref().is_some_and(|goal| goal.iter().all(|&fact| has(&state, fact)));
        let is_one = |facts: &Vec<usize>| facts.iter().filter(|&&fact| has(&state, fact)).count() == 1;
        variables.retain(|_, choices| choices.iter().all(is_one));
        looks = looks.checked_sub(swept.actions.len()).ok_or_else(too_many)?;
        let mut possible: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        let mut next = state.clone();
        for (position, action) in swept.actions.iter().enumerate() {
            if !action.needs.iter().all(|&fact| has(&state, fact)) || action.forbids.iter().any(|&fact| has(&state, fact)) {
                continue;
            }
            left = left.checked_sub(1).ok_or_else(too_many)?;
            possible.entry(action.kind).or_default().push(position);
            next.clone_from(&state);
            action.deletes.iter().for_each(|&fact| set(&mut next, fact, false));
            action.adds.iter().for_each(|&fact| set(&mut next, fact, true));
            if next == state {
                continue;
            }
            let Some((kind, ways)) = swept.kinds.get_mut(action.kind) else { continue };
            ways.is_of_use = true;
            if let (Some(twice), Some(schema)) = (action.twice, named.domain.actions.get(kind.schema)) {
                let predicate = named.domain.predicates.get(twice).map_or("", |(name, _)| name);
                let message = format!("an effect of {} on {predicate} {TWICE}", schema.name);
                return Err(PddlError { text: Text::Domain, line: schema.line, message });
            }
            if !known.contains(&next) {
                if known.len() == MOST_STATES {
                    return Err(too_many());
                }
                known.insert(next.clone());
                open.push(next.clone());
            }
        }
        for (kind, actions) in possible {
            let Some((_, ways)) = swept.kinds.get_mut(kind) else { continue };
            ways.all.extend(&actions);
            if actions.len() > 1 {
                ways.together.insert(actions);
            }
        }
    }
    swept.variables = (0..named.domain.predicates.len()).map(|predicate| variables.contains_key(&predicate)).collect();
    Ok(swept)
}

/// The facts of each predicate that may be a variable, by the choice of all arguments but the last.
fn variables(named: &Named<'_>, facts: &Facts) -> BTreeMap<usize, Vec<Vec<usize>>> {
    let mut variables = BTreeMap::new();
    for (predicate, (_, parameters)) in named.domain.predicates.iter().enumerate() {
        let classes: Vec<&str> = parameters.iter().map(|it| named.class(&it.kind)).collect();
        let Some((last, firsts)) = classes.split_last() else { continue };
        let mut by_choice: BTreeMap<&[usize], Vec<usize>> = BTreeMap::new();
        for (number, (_, objects)) in facts.all.iter().enumerate().filter(|(_, fact)| fact.0 == predicate) {
            if let Some((_, others)) = objects.split_last() {
                by_choice.entry(others).or_default().push(number);
            }
        }
        // Arguments of one class have different objects.
        let choices = firsts
            .iter()
            .enumerate()
            .map(|(at, class)| named.of_class(class).saturating_sub(firsts.iter().take(at).filter(|other| *other == class).count()));
        if !firsts.contains(last) && !by_choice.is_empty() && by_choice.len() == choices.product::<usize>() {
            variables.insert(predicate, by_choice.into_values().collect());
        }
    }
    variables
}

/// The facts that can change, with a number for each.
#[derive(Default)]
struct Facts {
    numbers: HashMap<Fact, usize>,
    all: Vec<Fact>,
}

impl Facts {
    fn number(&mut self, fact: Fact) -> usize {
        let next = self.all.len();
        let all = &mut self.all;
        *self.numbers.entry(fact).or_insert_with_key(|fact| {
            all.push(fact.clone());
            next
        })
    }
}

/// The object of each parameter.
type Binding<'p> = BTreeMap<&'p str, usize>;

fn value(named: &Named<'_>, term: &str, binding: &Binding<'_>) -> Option<usize> {
    binding.get(term).copied().or_else(|| named.object(term))
}

fn fact(named: &Named<'_>, atom: &Atom, binding: &Binding<'_>) -> Option<Fact> {
    Some((named.predicate(&atom.predicate)?, atom.terms.iter().map(|term| value(named, term, binding)).collect::<Option<_>>()?))
}

/// Gives the actions each choice of objects that is ever possible.
struct Grounder<'p> {
    named: &'p Named<'p>,
    /// The predicates that an action changes, and the facts at the start.
    changed: BTreeSet<usize>,
    start: BTreeSet<Fact>,
    /// The values of the functions.
    values: HashMap<(&'p str, Vec<usize>), u64>,
    facts: Facts,
    kinds: Vec<(Kind, Ways)>,
    actions: Vec<Ground>,
    tries: usize,
}

impl<'p> Grounder<'p> {
    fn of(named: &'p Named<'p>) -> Self {
        let effects = named.domain.actions.iter().flat_map(|action| action.adds.iter().chain(&action.deletes));
        let changed: BTreeSet<usize> = effects.filter_map(|atom| named.predicate(&atom.predicate)).collect();
        let none = BTreeMap::new();
        let start: BTreeSet<Fact> = named.problem.init.iter().filter_map(|atom| fact(named, atom, &none)).collect();
        let told = |(what, value): &'p (Atom, u64)| {
            let objects = what.terms.iter().map(|term| named.object(term)).collect::<Option<_>>()?;
            Some(((what.predicate.as_str(), objects), *value))
        };
        let values = named.problem.values.iter().filter_map(told).collect();
        let mut facts = Facts::default();
        for fact in start.iter().filter(|fact| changed.contains(&fact.0)) {
            facts.number(fact.clone());
        }
        Self { named, changed, start, values, facts, kinds: vec![], actions: vec![], tries: MOST_TRIES }
    }

    /// Grounds an action with each choice of objects for the parameters that have none yet; `None` if there are too many.
    fn ground(&mut self, position: usize, schema: &'p Schema, binding: &mut Binding<'p>) -> Option<()> {
        // A proposition that no action changes must hold as at the start. This is checked as soon as its objects are chosen.
        let is_as_wanted = |(atom, holds): &(Atom, bool)| {
            let fact = fact(self.named, atom, binding).filter(|fact| !self.changed.contains(&fact.0));
            fact.is_none_or(|fact| self.start.contains(&fact) == *holds)
        };
        let is_possible = schema.conditions.iter().all(is_as_wanted)
            && schema.equal.iter().all(|equal| {
                let [a, b] = equal.terms.each_ref().map(|term| value(self.named, term, binding));
                a.is_none() || b.is_none() || (a == b) == equal.is_same
            });
        if !is_possible {
            return Some(());
        }
        self.tries = self.tries.checked_sub(1).filter(|_| self.actions.len() <= MOST_ACTIONS)?;
        let Some(next) = schema.parameters.iter().find(|it| !binding.contains_key(it.name.as_str())) else {
            self.add(position, schema, binding);
            return Some(());
        };
        for (object, of) in self.named.objects.iter().enumerate() {
            if self.named.is_a(&of.kind, &next.kind) {
                binding.insert(&next.name, object);
                self.ground(position, schema, binding)?;
            }
        }
        binding.remove(next.name.as_str());
        Some(())
    }

    fn add(&mut self, position: usize, schema: &Schema, binding: &Binding<'_>) {
        let Some(cost) = self.cost(schema, binding) else { return };
        let Self { named, changed, facts, kinds, actions, .. } = self;
        let objects: Vec<usize> = schema.parameters.iter().filter_map(|it| binding.get(it.name.as_str()).copied()).collect();
        let same = objects.iter().map(|object| objects.iter().position(|other| other == object).unwrap_or(0)).collect();
        let kind = Kind { schema: position, same, cost };
        let of_kind = kinds.iter().position(|(known, _)| *known == kind).unwrap_or(kinds.len());
        if of_kind == kinds.len() {
            kinds.push((kind, Ways::default()));
        }
        let mut numbers = |atoms: &mut dyn Iterator<Item = &Atom>| -> Vec<usize> {
            let facts_of = atoms.filter_map(|atom| fact(named, atom, binding)).filter(|fact| changed.contains(&fact.0));
            facts_of.map(|fact| facts.number(fact)).collect()
        };
        let mut ground = Ground {
            kind: of_kind,
            objects,
            needs: numbers(&mut schema.conditions.iter().filter(|(_, holds)| *holds).map(|(atom, _)| atom)),
            forbids: numbers(&mut schema.conditions.iter().filter(|(_, holds)| !*holds).map(|(atom, _)| atom)),
            adds: numbers(&mut schema.adds.iter()),
            deletes: numbers(&mut schema.deletes.iter()),
            twice: None,
        };
        let mut effects = ground.adds.iter().chain(&ground.deletes).filter_map(|&number| facts.all.get(number));
        ground.twice = effects.find(|(_, objects)| has_one_twice(objects)).map(|&(predicate, _)| predicate);
        actions.push(ground);
    }

    /// What an action costs; `None` if it cannot be done, because its function has no value for these objects.
    fn cost(&self, schema: &Schema, binding: &Binding<'_>) -> Option<u64> {
        match &schema.cost {
            _ if !self.named.problem.minimizes_cost => Some(1),
            None => Some(0),
            Some(Cost::Of(cost)) => Some(*cost),
            Some(Cost::Told(told)) => {
                let objects = told.terms.iter().map(|term| value(self.named, term, binding)).collect::<Option<_>>()?;
                self.values.get(&(told.predicate.as_str(), objects)).copied()
            }
        }
    }
}
