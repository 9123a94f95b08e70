//! A world from PDDL: from a domain and a problem.
//!
//! A world from a file has at most 15 actions with their objects. So an action drops each parameter that the others determine: a robot is
//! in one room, so a move needs only its goal. To find these parameters, `sweep` visits all states that the problem can reach.
//!
//! - The class of a type is the highest type above it. A proposition such as `is-truck` gives the object's own type.
//! - Predicates without arguments, such as `handempty`, get an extra object as argument.
//! - Each predicate of the goal becomes a kind of task, and so does the whole goal.

mod sweep;

use super::robot::{MOST_TASKS_OF_A_ROBOT, WorldFlaw, flaw};
use goodbot::capacity::ARGUMENTS;
use goodbot_formats::pddl::{Atom, Domain, Problem, Schema, Typed};
use goodbot_formats::task_text::{GroundAtomText, LiftedTaskText};
use goodbot_formats::world::{ActionOfWorld, Literal, ObjectOfWorld, Term, WorldFile};
use std::collections::{BTreeMap, BTreeSet};
use sweep::{Named, Swept, costs, sweep};

/// The object that predicates without arguments get.
const WHOLE: &str = "whole";
/// The attribute with an object's name, so that words can mean it.
const NAME: &str = "name";
/// The most parameters of an action.
const MOST_PARAMETERS: usize = 32;
/// The most propositions of the whole goal as a kind of task.
const MOST_GOALS: usize = 4;

struct Converter<'p> {
    named: Named<'p>,
    problem: &'p Problem,
    swept: Swept,
}

/// The world of a domain and a problem.
///
/// ```
/// use goodbot_formats::pddl::{Domain, Problem};
/// use goodbot_lesson::world::{pddl, robot};
/// let domain = Domain::parse("(define (domain lamps) (:predicates (on ?l) (off ?l))
///     (:action light :parameters (?l) :precondition (off ?l) :effect (and (on ?l) (not (off ?l)))))")?;
/// let problem = Problem::parse("(define (problem two) (:domain lamps) (:objects a b) (:init (off a) (off b)) (:goal (and (on a) (on b))))")?;
/// let world = pddl::world(&domain, &problem)?;
/// assert_eq!(robot::plan(&world, &"on(a) & on(b)".parse()?)?.map(|plan| plan.len()), Some(2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A [`WorldFlaw`] for a domain or problem that a world file cannot express.
pub fn world(domain: &Domain, problem: &Problem) -> Result<WorldFile, WorldFlaw> {
    let named = Named { objects: domain.constants.iter().chain(&problem.objects).collect(), domain };
    check(&named, problem)?;
    let Some(swept) = sweep(&named, problem)? else {
        return flaw("objects", "make more states or actions than can be looked at; take a smaller problem");
    };
    Converter { named, problem, swept }.world()
}

/// Checks that every name is known, and that each predicate has the right number of terms.
fn check(named: &Named<'_>, problem: &Problem) -> Result<(), WorldFlaw> {
    let Domain { name, constants, .. } = named.domain;
    if !problem.domain.is_empty() && problem.domain != *name {
        let message = format!("the problem {} is of the domain {}, and this is {name}; take the right one", problem.name, problem.domain);
        return flaw("domain", message);
    }
    if let Some(twice) = problem.objects.iter().find(|object| constants.iter().any(|constant| constant.name == object.name)) {
        return flaw("objects", format!("{} is a constant of the domain already; leave it out", twice.name));
    }
    check_types(named)?;
    for (name, parameters) in &named.domain.predicates {
        if parameters.len() > ARGUMENTS {
            return flaw("predicates", format!("{name} has {} arguments, and {ARGUMENTS} are the most; give it fewer", parameters.len()));
        }
    }
    let known = |atom: &Atom, variables: &[Typed]| {
        let Some((_, parameters)) = named.domain.predicates.iter().find(|(known, _)| *known == atom.predicate) else {
            return flaw("predicates", format!("{atom} is of a predicate that the domain does not have; add it"));
        };
        if parameters.len() != atom.terms.len() {
            return flaw("predicates", format!("{atom} has {} terms, and {} are wanted", atom.terms.len(), parameters.len()));
        }
        let is_known = |term: &&String| named.object(term).is_some() || variables.iter().any(|it| it.name == **term);
        match atom.terms.iter().find(|term| !is_known(term)) {
            Some(strange) => flaw("objects", format!("{strange} in {atom} is no object and no parameter; add it")),
            None => Ok(()),
        }
    };
    for schema in &named.domain.actions {
        if schema.parameters.len() > MOST_PARAMETERS {
            let message = format!("line {}: {} has more than {MOST_PARAMETERS} parameters; give it fewer", schema.line, schema.name);
            return flaw("actions", message);
        }
        let atoms = schema.conditions.iter().map(|(atom, _)| atom).chain(&schema.adds).chain(&schema.deletes);
        atoms.into_iter().try_for_each(|atom| known(atom, &schema.parameters))?;
    }
    problem.init.iter().chain(&problem.goal).try_for_each(|atom| known(atom, &[]))?;
    match problem.goal.iter().find(|atom| has_one_twice(&atom.terms)) {
        Some(atom) => flaw("goal", format!("{atom} {TWICE}; leave it out")),
        None => Ok(()),
    }
}

/// Why a proposition cannot have one object for two arguments.
const TWICE: &str = "has one object twice, and in a world from a file the objects of what changes differ";

fn has_one_twice<T: PartialEq>(terms: &[T]) -> bool {
    terms.iter().enumerate().any(|(position, term)| terms.iter().take(position).any(|other| other == term))
}

/// Checks that each type is declared: an undeclared type would have no objects.
fn check_types(named: &Named<'_>) -> Result<(), WorldFlaw> {
    let Domain { types, predicates, actions, .. } = named.domain;
    let is_known = |kind: &str| kind == "object" || types.iter().any(|it| it.name == kind || it.kind == kind);
    let check = |it: &Typed, of: &str| {
        if is_known(&it.kind) {
            return Ok(());
        }
        flaw("types", format!("{}{of} is of the type {}, which the domain does not have; add it to (:types ...)", it.name, it.kind))
    };
    named.objects.iter().try_for_each(|object| check(object, ""))?;
    for (name, parameters) in predicates {
        parameters.iter().try_for_each(|it| check(it, &format!(" of the predicate {name}")))?;
    }
    for action in actions {
        action.parameters.iter().try_for_each(|it| check(it, &format!(" of the action {}", action.name)))?;
    }
    Ok(())
}

impl Converter<'_> {
    /// The class of a type: the highest type above it, or `object` if anything may be any object.
    fn class<'k>(&'k self, kind: &'k str) -> &'k str {
        if self.is_mixed() {
            return "object";
        }
        let mut kind = kind;
        for _ in 0..self.named.domain.types.len() {
            match self.named.domain.types.iter().find(|known| known.name == kind) {
                Some(known) if known.kind != "object" => kind = &known.kind,
                _ => break,
            }
        }
        kind
    }

    /// Whether something may be any object. There is one class then.
    fn is_mixed(&self) -> bool {
        let Domain { predicates, actions, .. } = self.named.domain;
        let parameters =
            predicates.iter().flat_map(|(_, parameters)| parameters).chain(actions.iter().flat_map(|action| &action.parameters));
        parameters.into_iter().chain(self.named.objects.iter().copied()).any(|it| it.kind == "object")
    }

    fn of_class(&self, class: &str) -> usize {
        self.named.objects.iter().filter(|object| self.class(&object.kind) == class).count()
    }

    fn atom(&self, atom: &Atom) -> Result<GroundAtomText, WorldFlaw> {
        let terms = if atom.terms.is_empty() { vec![WHOLE.to_owned()] } else { atom.terms.clone() };
        GroundAtomText::new(atom.predicate.clone(), terms)
            .map_err(|error| WorldFlaw { field: "predicates".to_owned(), message: error.to_string() })
    }

    /// The proposition that an object is of a type, if its class has other types too.
    fn type_test(&self, kind: &str) -> Option<String> {
        let class = self.class(kind);
        let is_other = |object: &&&Typed| self.class(&object.kind) == class && !self.named.is_a(&object.kind, kind);
        self.named.objects.iter().find(is_other).map(|_| format!("is-{kind}"))
    }

    fn world(&self) -> Result<WorldFile, WorldFlaw> {
        let domain = self.named.domain;
        let mut world = WorldFile { name: self.problem.name.clone(), ..WorldFile::default() };
        let kinds = self.named.objects.iter().map(|object| self.class(&object.kind));
        let parameters = domain.predicates.iter().flat_map(|(_, parameters)| parameters).map(|it| self.class(&it.kind));
        for class in kinds.chain(parameters) {
            if !world.classes.iter().any(|known| known == class) {
                world.classes.push(class.to_owned());
            }
        }
        world.attributes.push((NAME.to_owned(), world.classes.clone()));
        for object in &self.named.objects {
            let attributes = vec![(NAME.to_owned(), object.name.clone())];
            world.objects.push(ObjectOfWorld { name: object.name.clone(), class: self.class(&object.kind).to_owned(), attributes });
        }
        if domain.predicates.iter().any(|(_, parameters)| parameters.is_empty()) {
            if self.named.object(WHOLE).is_some() || world.classes.iter().any(|class| class == WHOLE) {
                return flaw("objects", format!("{WHOLE:?} is what predicates without arguments are about; call yours another name"));
            }
            world.classes.push(WHOLE.to_owned());
            world.objects.push(ObjectOfWorld { name: WHOLE.to_owned(), class: WHOLE.to_owned(), attributes: vec![] });
        }
        for (position, (name, parameters)) in domain.predicates.iter().enumerate() {
            let classes: Vec<String> = parameters.iter().map(|it| self.class(&it.kind).to_owned()).collect();
            if let Some((_, firsts)) = classes.split_last() {
                let choices = firsts.iter().enumerate().map(|(at, class)| {
                    // Arguments of one class have different objects.
                    self.of_class(class).saturating_sub(firsts.iter().take(at).filter(|other| *other == class).count())
                });
                let differ = firsts.iter().all(|class| Some(class) != classes.last());
                if differ && self.is_changed(name) && self.swept.is_variable(position, choices.product()) {
                    world.variables.push(name.clone());
                }
            }
            world.propositions.push((name.clone(), if classes.is_empty() { vec![WHOLE.to_owned()] } else { classes }));
        }
        for atom in &self.problem.init {
            let fact = self.atom(atom)?;
            if !world.facts.contains(&fact) {
                world.facts.push(fact);
            }
        }
        for schema in &domain.actions {
            self.add_actions(schema, &mut world)?;
        }
        self.add_kinds(&mut world)?;
        if super::count_tasks(&world) == Ok(0) {
            return flaw(
                "goal",
                "holds at first, and so does all else of its kind: no task is left; let it be something that is to change",
            );
        }
        Ok(world)
    }

    fn is_changed(&self, predicate: &str) -> bool {
        self.named.domain.actions.iter().any(|action| action.adds.iter().chain(&action.deletes).any(|atom| atom.predicate == predicate))
    }

    /// Adds a proposition that no action changes, with its facts, unless it is known.
    fn add_fixed(world: &mut WorldFile, name: &str, classes: Vec<String>, facts: Vec<GroundAtomText>) {
        if world.propositions.iter().all(|(known, _)| known != name) {
            world.propositions.push((name.to_owned(), classes));
            world.facts.extend(facts);
        }
    }

    /// Adds an action for each cost of a schema.
    fn add_actions(&self, schema: &Schema, world: &mut WorldFile) -> Result<(), WorldFlaw> {
        // Terms that must be equal become one.
        let mut renamed: BTreeMap<&str, &str> = BTreeMap::new();
        for (a, b, _) in schema.equal.iter().filter(|(_, _, same)| *same) {
            let (from, to) = if schema.parameters.iter().any(|it| it.name == *b) { (b, a) } else { (a, b) };
            renamed.insert(from, to);
        }
        let term = |term: &String| -> Term {
            let mut name = term.as_str();
            for _ in 0..renamed.len() {
                name = renamed.get(name).copied().unwrap_or(name);
            }
            name.strip_prefix('?').map_or_else(|| Term::Object(name.to_owned()), |name| Term::Variable(name.to_owned()))
        };
        let literal = |atom: &Atom, negated: bool| Literal {
            negated,
            proposition: atom.predicate.clone(),
            terms: if atom.terms.is_empty() { vec![Term::Object(WHOLE.to_owned())] } else { atom.terms.iter().map(term).collect() },
        };
        let parameters: Vec<&Typed> = schema.parameters.iter().filter(|it| !renamed.contains_key(it.name.as_str())).collect();
        let kept = self.kept(schema, &parameters);
        let mut conditions: Vec<Literal> = schema.conditions.iter().map(|(atom, holds)| literal(atom, !holds)).collect();
        for parameter in &schema.parameters {
            if let Some(test) = self.type_test(&parameter.kind) {
                let is_of = |object: &&&Typed| self.named.is_a(&object.kind, &parameter.kind);
                let facts =
                    self.named.objects.iter().filter(is_of).filter_map(|it| GroundAtomText::new(test.clone(), [it.name.clone()]).ok());
                Self::add_fixed(world, &test, vec![self.class(&parameter.kind).to_owned()], facts.collect());
                conditions.push(Literal { negated: false, proposition: test, terms: vec![term(&parameter.name)] });
            }
        }
        // A variable has one value: a new value ends the old one.
        let ended = schema.deletes.iter().filter(|atom| !world.variables.contains(&atom.predicate));
        let effects: Vec<Literal> =
            ended.map(|atom| literal(atom, true)).chain(schema.adds.iter().map(|atom| literal(atom, false))).collect();
        if effects.is_empty() {
            return Ok(());
        }
        if let Some(effect) = effects.iter().find(|effect| has_one_twice(&effect.terms)) {
            let message = format!("line {}: an effect of {} on {} {TWICE}; leave it out", schema.line, schema.name, effect.proposition);
            return flaw("actions", message);
        }
        let costs = costs(self.problem, schema)?;
        let several = costs.len() > 1;
        for (cost, told) in costs {
            let Some(cost_of_world) = u8::try_from(cost).ok().filter(|cost| (1..=16).contains(cost)) else {
                return flaw("actions", format!("line {}: {} costs {cost}, and a world's action costs 1 to 16", schema.line, schema.name));
            };
            let name = if several { format!("{}-{cost}", schema.name) } else { schema.name.clone() };
            let mut conditions = conditions.clone();
            if let (Some(first), Some(goodbot_formats::pddl::Cost::Told(function))) = (told.first(), &schema.cost)
                && !first.terms.is_empty()
            {
                let test = format!("{}-{cost}", function.predicate);
                let class = |term: &String| {
                    self.named.objects.iter().find(|it| it.name == *term).map_or(WHOLE, |it| self.class(&it.kind)).to_owned()
                };
                let facts = told.iter().filter_map(|atom| GroundAtomText::new(test.clone(), atom.terms.clone()).ok()).collect();
                Self::add_fixed(world, &test, first.terms.iter().map(class).collect(), facts);
                conditions.push(Literal { negated: false, proposition: test, terms: function.terms.iter().map(term).collect() });
            }
            let parameters = kept.iter().map(|it| (it.name.trim_start_matches('?').to_owned(), self.class(&it.kind).to_owned())).collect();
            world.actions.push(ActionOfWorld { name, parameters, conditions, effects: effects.clone(), cost: cost_of_world });
        }
        Ok(())
    }

    /// The parameters that the others do not determine.
    fn kept<'t>(&self, schema: &Schema, parameters: &[&'t Typed]) -> Vec<&'t Typed> {
        let mut kept: Vec<&Typed> = parameters.to_vec();
        // Parameters with the most objects are dropped first.
        let mut order: Vec<&Typed> = parameters.to_vec();
        order.sort_by_key(|it| std::cmp::Reverse(self.of_class(self.class(&it.kind))));
        for parameter in order {
            let without: BTreeSet<&str> = kept.iter().filter(|it| it.name != parameter.name).map(|it| it.name.as_str()).collect();
            if self.settles(schema, without).contains(parameter.name.as_str()) {
                kept.retain(|it| it.name != parameter.name);
            }
        }
        kept
    }

    /// The terms that the conditions determine, given these parameters.
    fn settles<'t>(&self, schema: &'t Schema, mut given: BTreeSet<&'t str>) -> BTreeSet<&'t str> {
        loop {
            let before = given.len();
            for (atom, _) in schema.conditions.iter().filter(|(_, holds)| *holds) {
                let Some(predicate) = self.named.predicate(&atom.predicate) else { continue };
                for (position, term) in atom.terms.iter().enumerate() {
                    let is_given = |term: &String| !term.starts_with('?') || given.contains(term.as_str());
                    let others = atom.terms.iter().enumerate().filter(|&(at, _)| at != position).all(|(_, term)| is_given(term));
                    if others && !is_given(term) && self.swept.is_settled(predicate, position) {
                        given.insert(term);
                    }
                }
            }
            if given.len() == before {
                return given;
            }
        }
    }

    /// Adds the goal and each of its predicates as kinds of task.
    fn add_kinds(&self, world: &mut WorldFile) -> Result<(), WorldFlaw> {
        let refused = |error: &dyn std::fmt::Display| WorldFlaw { field: "task_kinds".to_owned(), message: error.to_string() };
        let lifted = |atoms: &[Atom]| -> Result<LiftedTaskText, WorldFlaw> {
            let mut objects: Vec<&str> = Vec::new();
            let mut texts = Vec::new();
            for atom in atoms {
                let terms = if atom.terms.is_empty() { vec![WHOLE] } else { atom.terms.iter().map(String::as_str).collect() };
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
            texts.join(" & ").parse().map_err(|error| refused(&error))
        };
        for atom in &self.problem.goal {
            let kind = lifted(std::slice::from_ref(atom))?;
            if !world.task_kinds.contains(&kind) {
                world.task_kinds.push(kind);
            }
        }
        if (2..=MOST_GOALS).contains(&self.problem.goal.len()) {
            world.task_kinds.push(lifted(&self.problem.goal)?);
            let tasks = super::meanings(world, &world.facts, &[]).map_or(usize::MAX, |tasks| tasks.len());
            if tasks > MOST_TASKS_OF_A_ROBOT {
                world.task_kinds.pop();
            }
        }
        Ok(())
    }
}
