//! The world file of a problem.
//!
//! - Predicates without arguments, such as `handempty`, get an extra object as argument.
//! - A proposition such as `is-truck` tells which objects of a class a parameter may have.
//! - An action in which one object may serve as two parameters is two actions: in a world, different variables have different objects.
//! - Each predicate of the goal becomes a kind of task, and so does the whole goal.

use super::names::Named;
use super::reading::{Atom, Cost, Schema};
use super::sweep::{Kind, Swept, Ways};
use super::{Converted, Fault, PddlError, Text, error};
use crate::world::robot::MOST_TASKS_OF_A_ROBOT;
use goodbot_formats::task_text::{GroundAtomText, LiftedTaskText, is_usable_name};
use goodbot_formats::world::{ActionOfWorld, Literal, ObjectOfWorld, Term, WorldFile};
use std::collections::{BTreeMap, BTreeSet};

/// The object that predicates without arguments get.
const WHOLE: &str = "whole";
/// The attribute with an object's name, so that words can mean it.
const NAME: &str = "name";
/// The attribute with its type, in a class that has objects of several types.
const TYPE: &str = "type";
/// The most propositions of the whole goal as a kind of task.
const MOST_GOALS: usize = 4;
/// The most parameters of which any may be left out; those after them are kept.
const MOST_CHOSEN: usize = 10;
/// The costs of a world's actions.
const COSTS: std::ops::RangeInclusive<u64> = 1..=255;

/// Makes the world.
pub fn convert(named: &Named<'_>, swept: &Swept) -> Result<Converted, PddlError> {
    let in_problem = |fault: Fault| fault.of(Text::Problem);
    let mut writer = Writer { named, swept, world: WorldFile::default(), whole: WHOLE.to_owned(), warnings: vec![] };
    writer.add_vocabulary().map_err(in_problem)?;
    for (kind, ways) in swept.kinds() {
        writer.add_action(kind, ways).map_err(|fault| fault.of(Text::Domain))?;
    }
    if writer.world.actions.is_empty() {
        return error(1, "lets no action change anything; correct (:init ...)").map_err(in_problem);
    }
    let schemas: BTreeSet<usize> = swept.kinds().map(|(kind, _)| kind.schema).collect();
    for (_, schema) in named.domain.actions.iter().enumerate().filter(|(position, _)| !schemas.contains(position)) {
        writer.warnings.push(format!("{} can never be done, or changes nothing, so it is no action of the world", schema.name));
    }
    writer.add_kinds().map_err(in_problem)?;
    Ok(Converted { world: writer.world, warnings: writer.warnings })
}

struct Writer<'p> {
    named: &'p Named<'p>,
    swept: &'p Swept,
    world: WorldFile,
    whole: String,
    warnings: Vec<String>,
}

/// The name, with a number if another has it.
fn fresh(name: &str, is_taken: impl Fn(&str) -> bool) -> String {
    let mut numbered = (2..).map(|number| format!("{name}-{number}"));
    let mut fresh = name.to_owned();
    while is_taken(&fresh) {
        fresh = numbered.next().unwrap_or(fresh);
    }
    fresh
}

/// The objects that the parameters of an action may have; those with the same object count as one, the first.
struct Choices<'p> {
    schema: &'p Schema,
    same: &'p [usize],
    objects: BTreeMap<usize, BTreeSet<&'p str>>,
}

impl<'p> Choices<'p> {
    fn of(named: &Named<'p>, schema: &'p Schema, same: &'p [usize]) -> Self {
        let mut objects: BTreeMap<usize, BTreeSet<&str>> = BTreeMap::new();
        for (at, parameter) in same.iter().zip(&schema.parameters) {
            let of_type = named.objects.iter().filter(|object| named.is_a(&object.kind, &parameter.kind));
            let may_be = |object: &&str| {
                // The equalities and inequalities with constants.
                schema.equal.iter().all(|equal| {
                    let other = |[a, b]: [usize; 2]| equal.terms.get(a).filter(|it| **it == parameter.name).and(equal.terms.get(b));
                    let other = other([0, 1]).or_else(|| other([1, 0])).filter(|other| named.object(other).is_some());
                    other.is_none_or(|constant| (constant == object) == equal.is_same)
                })
            };
            let allowed: BTreeSet<&str> = of_type.map(|object| object.name.as_str()).filter(may_be).collect();
            let known = objects.entry(*at).or_insert_with(|| allowed.clone());
            known.retain(|object| allowed.contains(object));
        }
        // The only object of one parameter is no object of the others.
        loop {
            let only: Vec<(usize, &str)> =
                objects.iter().filter(|(_, of)| of.len() == 1).filter_map(|(&at, of)| Some((at, *of.first()?))).collect();
            let before: usize = objects.values().map(BTreeSet::len).sum();
            for (at, of) in &mut objects {
                of.retain(|object| only.iter().all(|(other, only)| other == at || only != object));
            }
            if objects.values().map(BTreeSet::len).sum::<usize>() == before {
                return Self { schema, same, objects };
            }
        }
    }

    /// The first of the parameters with the same object.
    fn first(&self, term: &str) -> Option<usize> {
        self.schema.parameters.iter().position(|it| it.name == term).and_then(|at| self.same.get(at).copied())
    }

    /// The only object that a parameter may have.
    fn only(&self, first: usize) -> Option<&'p str> {
        self.objects.get(&first).filter(|of| of.len() == 1).and_then(|of| of.first().copied())
    }

    fn name(&self, position: usize) -> &'p str {
        self.schema.parameters.get(position).map_or("", |it| it.name.trim_start_matches('?'))
    }

    fn term(&self, term: &str) -> Term {
        match self.first(term) {
            None => Term::Object(term.to_owned()),
            Some(first) => {
                self.only(first).map_or_else(|| Term::Variable(self.name(first).to_owned()), |object| Term::Object(object.to_owned()))
            }
        }
    }

    /// The parameters that are variables.
    fn variables(&self) -> Vec<usize> {
        self.objects.keys().copied().filter(|&first| self.only(first).is_none()).collect()
    }
}

impl Writer<'_> {
    /// Adds the classes, objects, propositions and facts.
    fn add_vocabulary(&mut self) -> Result<(), Fault> {
        let Self { named, swept, world, whole, .. } = self;
        let (domain, problem) = (named.domain, named.problem);
        world.name.clone_from(&problem.name);
        let parameters = domain.predicates.iter().flat_map(|(_, parameters)| parameters);
        for it in named.objects.iter().copied().chain(parameters) {
            let class = named.class(&it.kind);
            if !world.classes.iter().any(|known| known == class) {
                world.classes.push(class.to_owned());
            }
        }
        world.attributes.push((NAME.to_owned(), world.classes.clone()));
        let types_of =
            |class: &str| named.objects.iter().filter(|it| named.class(&it.kind) == class).map(|it| &it.kind).collect::<BTreeSet<_>>();
        let mixed: Vec<String> = world.classes.iter().filter(|class| types_of(class).len() > 1).cloned().collect();
        for object in &named.objects {
            if !is_usable_name(&object.name) {
                return error(object.line, format!("{:?} can be no name in a world; write it in letters and digits", object.name));
            }
            let class = named.class(&object.kind).to_owned();
            let mut attributes = vec![(NAME.to_owned(), object.name.clone())];
            if mixed.contains(&class) {
                attributes.push((TYPE.to_owned(), object.kind.clone()));
            }
            world.objects.push(ObjectOfWorld { name: object.name.clone(), class, attributes });
        }
        if !mixed.is_empty() {
            world.attributes.push((TYPE.to_owned(), mixed));
        }
        if domain.predicates.iter().any(|(_, parameters)| parameters.is_empty()) {
            *whole = fresh(WHOLE, |name| named.object(name).is_some() || world.classes.iter().any(|class| class == name));
            world.classes.push(whole.clone());
            world.objects.push(ObjectOfWorld { name: whole.clone(), class: whole.clone(), attributes: vec![] });
        }
        for (position, (name, parameters)) in domain.predicates.iter().enumerate() {
            let classes: Vec<String> = parameters.iter().map(|it| named.class(&it.kind).to_owned()).collect();
            if swept.is_variable(position) {
                world.variables.push(name.clone());
            }
            world.propositions.push((name.clone(), if classes.is_empty() { vec![whole.clone()] } else { classes }));
        }
        for atom in &problem.init {
            let terms = if atom.terms.is_empty() { vec![whole.clone()] } else { atom.terms.clone() };
            match GroundAtomText::new(atom.predicate.clone(), terms) {
                Ok(fact) if world.facts.contains(&fact) => {}
                Ok(fact) => world.facts.push(fact),
                Err(fault) => return error(atom.line, fault.to_string()),
            }
        }
        Ok(())
    }

    /// The proposition, which no action changes, that holds for these objects alone; that of an earlier action, if it says the same.
    fn fixed(&mut self, name: &str, classes: &[String], objects: &[Vec<&str>]) -> String {
        let world = &mut self.world;
        let facts = |name: &str| objects.iter().filter_map(|of| GroundAtomText::new(name, of.iter().copied()).ok()).collect::<Vec<_>>();
        let has = |name: &str| world.propositions.iter().any(|(known, _)| known == name);
        let is_same = |name: &str| {
            let is_own = self.named.predicate(name).is_none() && world.propositions.iter().any(|it| it.0 == name && it.1 == classes);
            is_own && world.facts.iter().filter(|fact| fact.function() == name).eq(facts(name).iter())
        };
        let name = fresh(name, |name| has(name) && !is_same(name));
        if !has(&name) {
            world.facts.extend(facts(&name));
            world.propositions.push((name.clone(), classes.to_vec()));
        }
        name
    }

    fn literal(&self, atom: &Atom, negated: bool, choices: &Choices<'_>) -> Literal {
        let terms = atom.terms.iter().map(|term| choices.term(term));
        let terms = if atom.terms.is_empty() { vec![Term::Object(self.whole.clone())] } else { terms.collect() };
        Literal { negated, proposition: atom.predicate.clone(), terms }
    }

    fn add_action(&mut self, kind: &Kind, ways: &Ways) -> Result<(), Fault> {
        let named = self.named;
        let Some(schema) = named.domain.actions.get(kind.schema) else { return Ok(()) };
        let choices = Choices::of(named, schema, &kind.same);
        if named.problem.minimizes_cost && schema.cost.is_none() {
            return error(
                schema.line,
                format!("{} has no cost, and a world's action costs 1 to 255; add (increase (total-cost) 1)", schema.name),
            );
        }
        let Some(cost) = u8::try_from(kind.cost).ok().filter(|_| COSTS.contains(&kind.cost)) else {
            return error(
                schema.line,
                format!("{} costs {}, and a world's action costs 1 to 255; change the costs", schema.name, kind.cost),
            );
        };
        let mut conditions: Vec<Literal> = schema.conditions.iter().map(|(atom, holds)| self.literal(atom, !holds, &choices)).collect();
        for first in choices.variables() {
            let (Some(parameter), Some(objects)) = (schema.parameters.get(first), choices.objects.get(&first)) else { continue };
            let class = named.class(&parameter.kind).to_owned();
            if objects.len() < named.of_class(&class) {
                let objects: Vec<Vec<&str>> = objects.iter().map(|&object| vec![object]).collect();
                let proposition = self.fixed(&format!("is-{}", parameter.kind), &[class], &objects);
                conditions.push(Literal { negated: false, proposition, terms: vec![choices.term(&parameter.name)] });
            }
        }
        if let Some(Cost::Told(function)) = schema.cost.as_ref().filter(|cost| named.problem.minimizes_cost && is_of_objects(cost)) {
            let told = named.problem.values.iter().filter(|(what, cost)| what.predicate == function.predicate && *cost == kind.cost);
            let told: Vec<Vec<&str>> = told.map(|(what, _)| what.terms.iter().map(String::as_str).collect()).collect();
            let class =
                |object: &&str| named.objects.iter().find(|it| it.name == **object).map_or("", |it| named.class(&it.kind)).to_owned();
            let classes: Vec<String> = told.first().map_or(vec![], |objects| objects.iter().map(class).collect());
            let proposition = self.fixed(&format!("{}-{}", function.predicate, kind.cost), &classes, &told);
            conditions.push(Literal { negated: false, proposition, terms: function.terms.iter().map(|term| choices.term(term)).collect() });
        }
        // A variable has one value: a new value ends the old one.
        let ended = schema.deletes.iter().filter(|atom| !self.world.variables.contains(&atom.predicate)).map(|atom| (atom, true));
        let all = ended.chain(schema.adds.iter().map(|atom| (atom, false)));
        let effects: Vec<Literal> = all.map(|(atom, negated)| self.literal(atom, negated, &choices)).collect();
        let kept = self.kept(ways, &choices, &conditions).into_iter();
        let class = |first: usize| schema.parameters.get(first).map_or("", |it| named.class(&it.kind)).to_owned();
        let parameters = kept.map(|first| (choices.name(first).to_owned(), class(first))).collect();
        let name = fresh(&self.name(kind, &choices), |name| name == "noop" || self.world.actions.iter().any(|action| action.name == name));
        self.world.actions.push(ActionOfWorld { name, parameters, conditions, effects, cost });
        Ok(())
    }

    /// The name of an action, told apart from others of the same action of the domain.
    fn name(&self, kind: &Kind, choices: &Choices<'_>) -> String {
        let others = || self.swept.kinds().map(|(other, _)| other).filter(|other| other.schema == kind.schema);
        let mut name = choices.schema.name.clone();
        if others().any(|other| other.same != kind.same) {
            for (at, &first) in kind.same.iter().enumerate().filter(|&(at, first)| at != *first) {
                name = format!("{name}-{}-is-{}", choices.name(at), choices.name(first));
            }
        }
        if others().any(|other| other.same == kind.same && other.cost != kind.cost) { format!("{name}-{}", kind.cost) } else { name }
    }

    /// The parameters to keep: of all choices that settle the others, the one with the fewest actions.
    fn kept(&self, ways: &Ways, choices: &Choices<'_>, conditions: &[Literal]) -> Vec<usize> {
        let variables = choices.variables();
        // An object is found for a variable of a condition; one of the effects alone stays a parameter.
        let is_found = |first: usize| {
            let is_it = |term: &Term| matches!(term, Term::Variable(name) if name == choices.name(first));
            conditions.iter().any(|literal| literal.terms.iter().any(is_it))
        };
        let chosen = |choice: u32| -> Vec<usize> {
            let is_kept = |at: usize, first: usize| at >= MOST_CHOSEN || choice >> at & 1 == 1 || !is_found(first);
            variables.iter().enumerate().filter(|&(at, &first)| is_kept(at, first)).map(|(_, &first)| first).collect()
        };
        let all = (0..1_u32 << variables.len().min(MOST_CHOSEN)).map(chosen);
        let settling = all.filter(|chosen| self.swept.settles(ways, chosen));
        settling.min_by_key(|chosen| (self.swept.count(ways, chosen), chosen.len())).unwrap_or(variables)
    }

    /// Adds the goal and each of its predicates as kinds of task.
    fn add_kinds(&mut self) -> Result<(), Fault> {
        let goal = &self.named.problem.goal;
        let line = goal.first().map_or(1, |atom| atom.line);
        for atom in goal {
            let kind = self.lifted(std::slice::from_ref(atom))?;
            if !self.world.task_kinds.contains(&kind) {
                self.world.task_kinds.push(kind);
            }
        }
        if goal.iter().all(|atom| self.named.problem.init.iter().any(|known| known.is_same(atom))) {
            self.warnings.push("the goal holds at first; no plan is needed".to_owned());
        }
        if !self.swept.reaches_goal {
            self.warnings.push("no plan reaches the goal; correct the problem, unless its parts are what you want".to_owned());
        }
        let left_out = |why: String| format!("the whole goal is no kind of task: {why}; its parts are");
        if goal.len() > MOST_GOALS {
            self.warnings.push(left_out(format!("it has {} propositions, and {MOST_GOALS} are the most", goal.len())));
        } else if goal.len() > 1 {
            let whole = self.lifted(goal)?;
            self.world.task_kinds.push(whole);
            let tasks = crate::world::count_tasks(&self.world).unwrap_or(usize::MAX);
            if tasks > MOST_TASKS_OF_A_ROBOT {
                self.world.task_kinds.pop();
                self.warnings.push(left_out(format!("its kind would give more than {MOST_TASKS_OF_A_ROBOT} tasks")));
            }
        }
        match crate::world::count_tasks(&self.world) {
            Ok(0) => {
                error(line, "holds at first, and so does all else of its kind: no task is left; let it be something that is to change")
            }
            _ => Ok(()),
        }
    }

    fn lifted(&self, atoms: &[Atom]) -> Result<LiftedTaskText, Fault> {
        let mut objects: Vec<&str> = Vec::new();
        let mut texts = Vec::new();
        for atom in atoms {
            let terms = if atom.terms.is_empty() { vec![self.whole.as_str()] } else { atom.terms.iter().map(String::as_str).collect() };
            let mut variables = Vec::new();
            for term in terms {
                let at = objects.iter().position(|known| *known == term).unwrap_or_else(|| {
                    objects.push(term);
                    objects.len() - 1
                });
                variables.push(format!("?x{at}"));
            }
            texts.push(format!("{}({})", atom.predicate, variables.join(",")));
        }
        texts
            .join(" & ")
            .parse()
            .or_else(|fault: goodbot_formats::task_text::TaskTextError| error(atoms.first().map_or(1, |atom| atom.line), fault.to_string()))
    }
}

fn is_of_objects(cost: &&Cost) -> bool {
    matches!(cost, Cost::Told(function) if !function.terms.is_empty())
}
