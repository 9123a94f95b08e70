//! Visits all states that a problem can reach, and finds which arguments determine others in all of them.

use crate::world::robot::{WorldFlaw, flaw};
use goodbot_formats::pddl::{Atom, Cost, Domain, Problem, Schema, Typed};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

/// The most states to visit, and the most actions with their objects.
const MOST_STATES: usize = 200_000;
const MOST_ACTIONS: usize = 20_000;
/// The most objects to try as parameters, for all actions together.
const MOST_TRIES: usize = 100_000;

/// A predicate and its objects, by their positions.
type Fact = (usize, Vec<usize>);

/// An action with objects for its parameters.
struct Ground {
    needs: Vec<usize>,
    forbids: Vec<usize>,
    adds: Vec<usize>,
    deletes: Vec<usize>,
    /// The schema and two of its parameters, if both have the same object.
    twice: Option<(usize, [usize; 2])>,
}

/// The findings that hold in every reachable state.
#[derive(Debug)]
pub struct Swept {
    /// For each predicate and each argument: whether the other arguments leave at most one object for it.
    at_most_one: Vec<Vec<bool>>,
    /// For each predicate: how many of its facts hold, if the number is the same in all states.
    always: Vec<Option<usize>>,
}

impl Swept {
    /// Whether the other arguments of a predicate always leave at most one object for this one.
    pub fn is_settled(&self, predicate: usize, argument: usize) -> bool {
        self.at_most_one.get(predicate).and_then(|arguments| arguments.get(argument)).copied().unwrap_or(false)
    }

    /// Whether the last argument of a predicate always has exactly one object for each of the `choices` of the others.
    pub fn is_variable(&self, predicate: usize, choices: usize) -> bool {
        let last = self.at_most_one.get(predicate).and_then(|arguments| arguments.last()).copied().unwrap_or(false);
        last && self.always.get(predicate).copied().flatten() == Some(choices)
    }
}

/// The objects and predicates of a problem, by position.
pub struct Named<'p> {
    /// The objects of the domain, then those of the problem.
    pub objects: Vec<&'p Typed>,
    /// The domain.
    pub domain: &'p Domain,
}

impl Named<'_> {
    /// The position of a predicate.
    pub fn predicate(&self, name: &str) -> Option<usize> {
        self.domain.predicates.iter().position(|(known, _)| known == name)
    }

    /// The position of an object.
    pub fn object(&self, name: &str) -> Option<usize> {
        self.objects.iter().position(|known| known.name == name)
    }

    /// Whether a type equals another, or is below it.
    pub fn is_a(&self, kind: &str, above: &str) -> bool {
        let mut kind = kind;
        for _ in 0..=self.domain.types.len() {
            if kind == above || above == "object" {
                return true;
            }
            match self.domain.types.iter().find(|known| known.name == kind) {
                Some(known) => kind = &known.kind,
                None => return false,
            }
        }
        false
    }

    fn fact(&self, atom: &Atom, binding: &BTreeMap<&str, usize>) -> Option<Fact> {
        let term = |term: &String| binding.get(term.as_str()).copied().or_else(|| self.object(term));
        Some((self.predicate(&atom.predicate)?, atom.terms.iter().map(term).collect::<Option<_>>()?))
    }
}

/// The facts of a problem, with a number for each.
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

/// Visits all states. `None` if there are too many.
///
/// # Errors
/// A [`WorldFlaw`] if an action can have one object for two parameters: in a world from a file they differ.
pub fn sweep(named: &Named<'_>, problem: &Problem) -> Result<Option<Swept>, WorldFlaw> {
    let changed: BTreeSet<usize> = named
        .domain
        .actions
        .iter()
        .flat_map(|action| action.adds.iter().chain(&action.deletes))
        .filter_map(|atom| named.predicate(&atom.predicate))
        .collect();
    let mut facts = Facts::default();
    let none = BTreeMap::new();
    let init: BTreeSet<Fact> = problem.init.iter().filter_map(|atom| named.fact(atom, &none)).collect();
    let start: BTreeSet<usize> = init.iter().map(|fact| facts.number(fact.clone())).collect();
    let (mut actions, mut tries) = (Vec::new(), MOST_TRIES);
    for (position, schema) in named.domain.actions.iter().enumerate() {
        ground(named, (position, schema), &mut BTreeMap::new(), &changed, &init, &mut facts, &mut actions, &mut tries);
        if actions.len() > MOST_ACTIONS || tries == 0 {
            return Ok(None);
        }
    }
    let mut swept = Swept {
        at_most_one: named.domain.predicates.iter().map(|(_, parameters)| vec![true; parameters.len()]).collect(),
        always: vec![None; named.domain.predicates.len()],
    };
    let first: Vec<usize> = start.into_iter().collect();
    look(&first, &facts, &mut swept, true);
    let (mut known, mut open) = (HashSet::from([first.clone()]), vec![first]);
    while let Some(state) = open.pop() {
        let has: HashSet<usize> = state.iter().copied().collect();
        for action in &actions {
            if !action.needs.iter().all(|fact| has.contains(fact)) || action.forbids.iter().any(|fact| has.contains(fact)) {
                continue;
            }
            let kept = state.iter().copied().filter(|fact| !action.deletes.contains(fact));
            let next: Vec<usize> = kept.chain(action.adds.iter().copied()).collect::<BTreeSet<_>>().into_iter().collect();
            if next == state {
                continue;
            }
            if let Some((schema, [a, b])) = action.twice {
                return twice(named, schema, a, b);
            }
            if known.insert(next.clone()) {
                if known.len() > MOST_STATES {
                    return Ok(None);
                }
                look(&next, &facts, &mut swept, false);
                open.push(next);
            }
        }
    }
    Ok(Some(swept))
}

fn twice<T>(named: &Named<'_>, schema: usize, a: usize, b: usize) -> Result<T, WorldFlaw> {
    let Some(schema) = named.domain.actions.get(schema) else { return flaw("actions", "take one object twice") };
    let name = |position: usize| schema.parameters.get(position).map_or("", |it| it.name.as_str());
    let message = format!(
        "{} can be done with one object for {} and {}, and in a world from a file they are two; add (not (= {} {}))",
        schema.name,
        name(a),
        name(b),
        name(a),
        name(b)
    );
    flaw("actions", message)
}

/// Records the facts of a state.
fn look(state: &[usize], facts: &Facts, swept: &mut Swept, is_first: bool) {
    let mut counts: HashMap<(usize, usize, Vec<usize>), usize> = HashMap::new();
    let mut all = vec![0; swept.always.len()];
    for &(predicate, ref arguments) in state.iter().filter_map(|&fact| facts.all.get(fact)) {
        all.iter_mut().skip(predicate).take(1).for_each(|count| *count += 1);
        for (position, _) in arguments.iter().enumerate() {
            let mut others = arguments.clone();
            others.remove(position);
            *counts.entry((predicate, position, others)).or_default() += 1;
        }
    }
    for ((predicate, position, _), count) in counts {
        if let Some(slot) = swept.at_most_one.get_mut(predicate).and_then(|arguments| arguments.get_mut(position)) {
            *slot &= count == 1;
        }
    }
    for (slot, count) in swept.always.iter_mut().zip(all) {
        *slot = if is_first || *slot == Some(count) { Some(count) } else { None };
    }
}

/// Grounds an action with each choice of objects that is ever possible.
#[expect(clippy::too_many_arguments, reason = "what is chosen, what it is chosen from, and what comes of it")]
fn ground<'p>(
    named: &Named<'p>,
    (position, schema): (usize, &'p Schema),
    binding: &mut BTreeMap<&'p str, usize>,
    changed: &BTreeSet<usize>,
    init: &BTreeSet<Fact>,
    facts: &mut Facts,
    actions: &mut Vec<Ground>,
    tries: &mut usize,
) {
    // A proposition that no action changes must hold as at the start. This is checked as soon as its objects are chosen.
    for (atom, holds) in &schema.conditions {
        if let Some(fact) = named.fact(atom, binding)
            && !changed.contains(&fact.0)
            && init.contains(&fact) != *holds
        {
            return;
        }
    }
    for (a, b, same) in &schema.equal {
        let value = |term: &String| binding.get(term.as_str()).copied().or_else(|| named.object(term));
        if let (Some(a), Some(b)) = (value(a), value(b))
            && (a == b) != *same
        {
            return;
        }
    }
    *tries = tries.saturating_sub(1);
    if actions.len() > MOST_ACTIONS || *tries == 0 {
        return;
    }
    if let Some(next) = schema.parameters.iter().find(|it| !binding.contains_key(it.name.as_str())) {
        for object in
            (0..named.objects.len()).filter(|&object| named.objects.get(object).is_some_and(|it| named.is_a(&it.kind, &next.kind)))
        {
            binding.insert(&next.name, object);
            ground(named, (position, schema), binding, changed, init, facts, actions, tries);
        }
        binding.remove(next.name.as_str());
        return;
    }
    let mut numbers = |atoms: &mut dyn Iterator<Item = &Atom>| -> Vec<usize> {
        atoms.filter_map(|atom| named.fact(atom, binding)).map(|fact| facts.number(fact)).collect()
    };
    let values: Vec<usize> = schema.parameters.iter().filter_map(|it| binding.get(it.name.as_str()).copied()).collect();
    let same = |(b, value): (usize, &usize)| values.iter().take(b).position(|other| other == value).map(|a| [a, b]);
    // Parameters that the domain declares equal count as one.
    let said = |[a, b]: &[usize; 2]| {
        let is = |term: &String, position: usize| schema.parameters.get(position).is_some_and(|it| it.name == *term);
        schema.equal.iter().any(|(one, other, same)| *same && (is(one, *a) && is(other, *b) || is(one, *b) && is(other, *a)))
    };
    actions.push(Ground {
        needs: numbers(&mut schema.conditions.iter().filter(|(_, holds)| *holds).map(|(atom, _)| atom)),
        forbids: numbers(&mut schema.conditions.iter().filter(|(_, holds)| !*holds).map(|(atom, _)| atom)),
        adds: numbers(&mut schema.adds.iter()),
        deletes: numbers(&mut schema.deletes.iter()),
        twice: values.iter().enumerate().filter_map(same).find(|pair| !said(pair)).map(|pair| (position, pair)),
    });
}

/// The costs of an action in a problem, each with the values of the cost function that give it.
pub fn costs<'p>(problem: &'p Problem, schema: &'p Schema) -> Result<Vec<(u64, Vec<&'p Atom>)>, WorldFlaw> {
    let told = match &schema.cost {
        _ if !problem.minimizes_cost => return Ok(vec![(1, vec![])]),
        None => {
            return flaw(
                "actions",
                format!(
                    "line {}: {} has no cost, and a world's action costs 1 to 16; add (increase (total-cost) 1)",
                    schema.line, schema.name
                ),
            );
        }
        Some(Cost::Of(cost)) => return Ok(vec![(*cost, vec![])]),
        Some(Cost::Told(told)) => told,
    };
    let mut by_cost: BTreeMap<u64, Vec<&Atom>> = BTreeMap::new();
    for (what, cost) in problem.values.iter().filter(|(what, _)| what.predicate == told.predicate) {
        by_cost.entry(*cost).or_default().push(what);
    }
    Ok(by_cost.into_iter().collect())
}
