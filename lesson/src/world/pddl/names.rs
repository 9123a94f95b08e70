//! The names of a domain and a problem, checked, and the class of each type.

use super::reading::{Atom, Cost, Domain, OBJECT, Problem, Schema, Typed};
use super::{Fault, error};
use goodbot::capacity::ARGUMENTS;
use std::collections::{BTreeMap, BTreeSet};

/// The most parameters of an action.
const MOST_PARAMETERS: usize = 32;

/// The domain and the problem, their objects and classes.
pub struct Named<'p> {
    pub domain: &'p Domain,
    pub problem: &'p Problem,
    /// The objects of the domain, then those of the problem.
    pub objects: Vec<&'p Typed>,
    /// The class of each type.
    classes: BTreeMap<&'p str, String>,
}

/// Whether a list of terms or objects has one of them twice.
pub fn has_one_twice<T: PartialEq>(terms: &[T]) -> bool {
    terms.iter().enumerate().any(|(position, term)| terms.iter().take(position).any(|other| other == term))
}

/// Why a proposition that changes cannot have one object for two arguments.
pub const TWICE: &str = "has one object twice, and in a world from a file the objects of what changes differ; leave it out";

impl<'p> Named<'p> {
    pub fn of(domain: &'p Domain, problem: &'p Problem) -> Self {
        let objects = domain.constants.iter().chain(&problem.objects).collect();
        let mut named = Self { domain, problem, objects, classes: BTreeMap::new() };
        named.classes = named.classes();
        named
    }

    /// The position of a predicate.
    pub fn predicate(&self, name: &str) -> Option<usize> {
        self.domain.predicates.iter().position(|(known, _)| known == name)
    }

    /// The position of an object.
    pub fn object(&self, name: &str) -> Option<usize> {
        self.objects.iter().position(|known| known.name == name)
    }

    /// A type and those above it, `object` last.
    fn and_above<'k>(&self, kind: &'k str) -> Vec<&'k str>
    where
        'p: 'k,
    {
        let mut all = vec![kind];
        while let Some(known) = self.domain.types.iter().find(|known| all.last() == Some(&known.name.as_str())) {
            if all.contains(&known.kind.as_str()) {
                break;
            }
            all.push(&known.kind);
        }
        if !all.contains(&OBJECT) {
            all.push(OBJECT);
        }
        all
    }

    /// Whether a type equals another, or is below it.
    pub fn is_a(&self, kind: &str, above: &str) -> bool {
        self.and_above(kind).contains(&above)
    }

    /// The class of a type.
    pub fn class(&self, kind: &str) -> &str {
        self.classes.get(kind).map_or(OBJECT, String::as_str)
    }

    /// How many objects a class has.
    pub fn of_class(&self, class: &str) -> usize {
        self.objects.iter().filter(|object| self.class(&object.kind) == class).count()
    }

    fn parameters(&self) -> impl Iterator<Item = &'p Typed> {
        let of_predicates = self.domain.predicates.iter().flat_map(|(_, parameters)| parameters);
        of_predicates.chain(self.domain.actions.iter().flat_map(|action| &action.parameters))
    }

    /// The class of each type. Two types have one class if some predicate, parameter or price may be of objects of both: in a world each
    /// argument is of one class. A class is called as the lowest type above its types, if that is above no others.
    fn classes(&self) -> BTreeMap<&'p str, String> {
        let kinds: BTreeSet<&'p str> = self.parameters().chain(self.objects.iter().copied()).map(|it| it.kind.as_str()).collect();
        let mut together: Vec<BTreeSet<&'p str>> = Vec::new();
        for parameter in self.parameters() {
            together.push(kinds.iter().copied().filter(|kind| self.is_a(kind, &parameter.kind)).collect());
        }
        let mut priced: BTreeMap<(&str, usize), BTreeSet<&'p str>> = BTreeMap::new();
        for (function, _) in &self.problem.values {
            for (position, term) in function.terms.iter().enumerate() {
                let kind = self.objects.iter().find(|it| it.name == *term).map(|it| it.kind.as_str());
                priced.entry((&function.predicate, position)).or_default().extend(kind);
            }
        }
        together.extend(priced.into_values());
        let mut classes: Vec<BTreeSet<&'p str>> = kinds.iter().map(|&kind| BTreeSet::from([kind])).collect();
        for one in together {
            let (joined, mut rest): (Vec<_>, Vec<_>) = classes.into_iter().partition(|class| !class.is_disjoint(&one));
            rest.push(joined.into_iter().flatten().collect());
            classes = rest;
        }
        let name = |class: &BTreeSet<&'p str>| {
            let above = class.first().map_or(vec![], |kind| self.and_above(kind));
            let lowest = above.into_iter().find(|above| class.iter().all(|kind| self.is_a(kind, above))).unwrap_or(OBJECT);
            let is_above_others = kinds.iter().any(|kind| !class.contains(kind) && self.is_a(kind, lowest));
            if is_above_others { class.iter().copied().collect::<Vec<_>>().join("-") } else { lowest.to_owned() }
        };
        classes.iter().flat_map(|class| class.iter().map(|&kind| (kind, name(class))).collect::<Vec<_>>()).collect()
    }

    /// Checks that each name in the domain is known, and that each predicate has the right terms.
    pub fn check_domain(&self) -> Result<(), Fault> {
        let Domain { types, predicates, actions, constants, .. } = self.domain;
        let is_above_itself = |it: &&Typed| it.kind != OBJECT && self.is_a(&it.kind, &it.name);
        if let Some(it) = types.iter().find(is_above_itself) {
            return error(it.line, format!("the type {} is above itself; let it be below another one", it.name));
        }
        constants.iter().chain(self.parameters()).try_for_each(|it| self.check_type(it))?;
        for (name, parameters) in predicates {
            if let Some(beyond) = parameters.get(ARGUMENTS) {
                let message = format!("{name} has {} arguments, and {ARGUMENTS} are the most; give it fewer", parameters.len());
                return error(beyond.line, message);
            }
        }
        actions.iter().try_for_each(|action| self.check_action(action))
    }

    fn check_action(&self, action: &Schema) -> Result<(), Fault> {
        let Schema { name, line, parameters, .. } = action;
        if parameters.len() > MOST_PARAMETERS {
            let given = parameters.len();
            return error(*line, format!("{name} has {given} parameters, and {MOST_PARAMETERS} are the most; give it fewer"));
        }
        for atom in action.conditions.iter().map(|(atom, _)| atom).chain(&action.adds).chain(&action.deletes) {
            self.check_atom(atom, parameters)?;
        }
        for equal in &action.equal {
            equal.terms.iter().try_for_each(|term| self.kind(term, parameters, "an equality", equal.line).map(drop))?;
        }
        let Some(Cost::Told(cost)) = &action.cost else { return Ok(()) };
        cost.terms.iter().try_for_each(|term| self.kind(term, parameters, &cost.to_string(), cost.line).map(drop))?;
        let is_told = self.problem.values.iter().any(|(known, _)| known.predicate == cost.predicate);
        if self.problem.minimizes_cost && !is_told {
            return error(
                cost.line,
                format!("{cost} has no value in the problem, so {name} can never be done; give it values in (:init ...)"),
            );
        }
        Ok(())
    }

    /// Checks the same of the problem, and that the two belong together.
    pub fn check_problem(&self) -> Result<(), Fault> {
        let Problem { name, domain: (domain, line), objects, init, values, goal, .. } = self.problem;
        if *line > 0 && *domain != self.domain.name {
            let message = format!("{name} is of the domain {domain}, and this is {}; take the right one", self.domain.name);
            return error(*line, message);
        }
        for object in objects {
            if self.domain.constants.iter().any(|constant| constant.name == object.name) {
                return error(object.line, format!("{} is a constant of the domain already; leave it out", object.name));
            }
            self.check_type(object)?;
        }
        init.iter().chain(goal).try_for_each(|atom| self.check_atom(atom, &[]))?;
        for (function, _) in values {
            function.terms.iter().try_for_each(|term| self.kind(term, &[], &function.to_string(), function.line).map(drop))?;
        }
        match goal.iter().find(|atom| has_one_twice(&atom.terms)) {
            Some(atom) => error(atom.line, format!("{atom} {TWICE}")),
            None => Ok(()),
        }
    }

    /// Checks that a type is declared: an undeclared type would have no objects.
    fn check_type(&self, it: &Typed) -> Result<(), Fault> {
        if it.kind == OBJECT || self.domain.types.iter().any(|known| known.name == it.kind || known.kind == it.kind) {
            return Ok(());
        }
        error(it.line, format!("{} is of the type {}, which the domain does not have; add it to (:types ...)", it.name, it.kind))
    }

    /// The type of a parameter or an object, and whether it is an object.
    fn kind<'k>(&'k self, term: &str, parameters: &'k [Typed], of: &str, line: usize) -> Result<(&'k str, bool), Fault> {
        let parameter = parameters.iter().find(|it| it.name == *term).map(|it| (it.kind.as_str(), false));
        let object = || self.objects.iter().find(|it| it.name == *term).map(|it| (it.kind.as_str(), true));
        match parameter.or_else(object) {
            Some(kind) => Ok(kind),
            None => error(line, format!("{term} in {of} is no object and no parameter; correct it, or add it")),
        }
    }

    fn check_atom(&self, atom: &Atom, parameters: &[Typed]) -> Result<(), Fault> {
        let Some((_, wanted)) = self.domain.predicates.iter().find(|(known, _)| *known == atom.predicate) else {
            return error(atom.line, format!("{atom} is of a predicate that the domain does not have; add it to (:predicates ...)"));
        };
        if wanted.len() != atom.terms.len() {
            return error(atom.line, format!("{atom} has {} terms, and {} are wanted", atom.terms.len(), wanted.len()));
        }
        for (term, wanted) in atom.terms.iter().zip(wanted) {
            let (kind, is_object) = self.kind(term, parameters, &atom.to_string(), atom.line)?;
            // A parameter of a higher type may be an object of the lower one.
            if !self.is_a(kind, &wanted.kind) && (is_object || !self.is_a(&wanted.kind, kind)) {
                let wanted = &wanted.kind;
                return error(atom.line, format!("{term} in {atom} is of the type {kind}, and {wanted} is wanted; write one of that type"));
            }
        }
        Ok(())
    }
}
