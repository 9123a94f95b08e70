//! Reads domains and problems from their lists.

use super::{Expression, Fault, error};
use std::collections::BTreeSet;
use std::fmt;

/// A name with its type; without a type, `object`.
#[derive(Debug, Clone)]
pub struct Typed {
    /// The name; that of a variable begins with `?`.
    pub name: String,
    /// The type.
    pub kind: String,
    pub line: usize,
}

/// A predicate with its terms, or a function.
#[derive(Debug, Clone)]
pub struct Atom {
    /// The predicate.
    pub predicate: String,
    /// Objects, and variables with their `?`.
    pub terms: Vec<String>,
    pub line: usize,
}

impl Atom {
    /// Whether it says the same, on whichever line.
    pub fn is_same(&self, other: &Self) -> bool {
        (&self.predicate, &self.terms) == (&other.predicate, &other.terms)
    }
}

impl fmt::Display for Atom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({}", self.predicate)?;
        self.terms.iter().try_for_each(|term| write!(f, " {term}"))?;
        f.write_str(")")
    }
}

/// The cost of an action.
#[derive(Debug, Clone)]
pub enum Cost {
    /// A number.
    Of(u64),
    /// The value that the problem gives for these objects.
    Told(Atom),
}

/// Two terms of an action that must be equal, or must differ.
#[derive(Debug, Clone)]
pub struct Equal {
    pub terms: [String; 2],
    pub is_same: bool,
    pub line: usize,
}

/// An action.
#[derive(Debug, Clone)]
pub struct Schema {
    pub name: String,
    /// The line on which it begins.
    pub line: usize,
    pub parameters: Vec<Typed>,
    /// Propositions that must hold (`true`) or must not hold (`false`).
    pub conditions: Vec<(Atom, bool)>,
    pub equal: Vec<Equal>,
    /// The propositions that hold after it.
    pub adds: Vec<Atom>,
    /// The propositions that no longer hold after it, unless they are added.
    pub deletes: Vec<Atom>,
    /// Its increase of `total-cost`, if it has one.
    pub cost: Option<Cost>,
}

/// A domain.
#[derive(Debug, Clone, Default)]
pub struct Domain {
    pub name: String,
    /// The types, each with the one above it.
    pub types: Vec<Typed>,
    /// Objects that every problem has.
    pub constants: Vec<Typed>,
    /// The predicates, each with its parameters.
    pub predicates: Vec<(String, Vec<Typed>)>,
    pub actions: Vec<Schema>,
}

/// A problem.
#[derive(Debug, Clone, Default)]
pub struct Problem {
    pub name: String,
    /// The name of its domain, and its line; empty if it names none.
    pub domain: (String, usize),
    pub objects: Vec<Typed>,
    /// The propositions that hold at the start.
    pub init: Vec<Atom>,
    /// The values of numeric functions.
    pub values: Vec<(Atom, u64)>,
    /// The propositions to reach.
    pub goal: Vec<Atom>,
    /// Whether the best plan has the least `total-cost`; otherwise the shortest plan is best.
    pub minimizes_cost: bool,
}

/// The type of all objects.
pub const OBJECT: &str = "object";
const TOTAL_COST: &str = "total-cost";

/// Why numbers are refused.
const NUMBERS: &str = "numbers that change are beyond STRIPS; write a proposition for each value";

/// Words of PDDL that are not supported, with the remedy.
const BEYOND: [(&str, &str); 15] = [
    ("when", "conditional effects are beyond STRIPS; write an action for each case"),
    ("forall", "quantifiers are beyond STRIPS; write what holds of each object"),
    ("exists", "quantifiers are beyond STRIPS; make it a parameter"),
    ("and", "a negated list is an alternative, and those are beyond STRIPS; write an action for each"),
    ("not", "a negation of a negation; write neither"),
    ("or", "alternatives are beyond STRIPS; write an action for each"),
    ("imply", "alternatives are beyond STRIPS; write an action for each"),
    ("<", NUMBERS),
    ("<=", NUMBERS),
    (">", NUMBERS),
    (">=", NUMBERS),
    ("preference", "preferences are not understood; write what is to hold"),
    (":durative-action", "time is not understood; write an action"),
    (":derived", "derived predicates are not understood; let the actions say what holds"),
    (":constraints", "constraints are not understood; leave them out"),
];

fn beyond<T>(word: &str, line: usize) -> Result<T, Fault> {
    match BEYOND.iter().find(|(known, _)| *known == word) {
        Some((_, instead)) => error(line, format!("{word:?} is not understood: {instead}")),
        None => error(line, format!("{word:?} is not understood here; leave it out")),
    }
}

/// `a b - kind c`: names with their types.
fn typed(items: &[Expression]) -> Result<Vec<Typed>, Fault> {
    let (mut all, mut first) = (Vec::<Typed>::new(), 0);
    let mut items = items.iter();
    while let Some(item) = items.next() {
        let word = item.word()?;
        if word != "-" {
            if word.starts_with('-') {
                return error(item.line(), format!("{word:?} is no name; write a blank after -"));
            }
            all.push(Typed { name: word.to_owned(), kind: OBJECT.to_owned(), line: item.line() });
            continue;
        }
        let Some(kind) = items.next() else { return error(item.line(), "has no type after -; write it") };
        if let Expression::List(_, line) = kind {
            return error(*line, "one of several types is not understood: give them one type above, and name that");
        }
        all.iter_mut().skip(first).try_for_each(|it| kind.word().map(|kind| kind.clone_into(&mut it.kind)))?;
        first = all.len();
    }
    Ok(all)
}

/// As [`typed`], but each name may occur once, and only parameters begin with `?`.
fn typed_once(items: &[Expression], what: &str) -> Result<Vec<Typed>, Fault> {
    let all = typed(items)?;
    for it in &all {
        let name = &it.name;
        if (what == "parameter") != (name.starts_with('?') && name.len() > 1) {
            let but = if what == "parameter" { "does not" } else { "does, or is one alone" };
            return error(it.line, format!("the name of a parameter begins with ?, and that of the {what} {name:?} {but}; correct it"));
        }
    }
    once(all.iter().map(|it| (it.name.as_str(), it.line)), what)?;
    Ok(all)
}

/// Refuses a name that is given twice.
fn once<'n>(names: impl Iterator<Item = (&'n str, usize)>, what: &str) -> Result<(), Fault> {
    let mut known = BTreeSet::new();
    for (name, line) in names {
        if !known.insert(name) {
            return error(line, format!("gives the {what} {name} twice; give each a name of its own"));
        }
    }
    Ok(())
}

/// Refuses a section that is given twice: one of the two would be lost.
fn sections_once(sections: &[Expression]) -> Result<(), Fault> {
    let heads = sections.iter().map(|section| Ok((section.headed()?.0, section.line()))).collect::<Result<Vec<_>, Fault>>()?;
    once(heads.into_iter().filter(|(head, _)| *head != ":action"), "section")
}

fn atom(expression: &Expression) -> Result<Atom, Fault> {
    let (predicate, terms) = expression.headed()?;
    if BEYOND.iter().any(|(known, _)| *known == predicate) {
        return beyond(predicate, expression.line());
    }
    let terms = terms.iter().map(|term| term.word().map(str::to_owned)).collect::<Result<_, _>>()?;
    Ok(Atom { predicate: predicate.to_owned(), terms, line: expression.line() })
}

/// The parts of a conjunction; an empty list has none.
fn parts(expression: &Expression) -> Result<Vec<&Expression>, Fault> {
    match expression.list()?.split_first() {
        None => Ok(vec![]),
        Some((Expression::Word(and, _), rest)) if and == "and" => {
            let mut all = Vec::new();
            for part in rest {
                all.extend(parts(part)?);
            }
            Ok(all)
        }
        Some(_) => Ok(vec![expression]),
    }
}

/// An expression without its `not`, and whether it is positive.
fn signed(expression: &Expression) -> Result<(&Expression, bool), Fault> {
    match expression.headed()? {
        ("not", [inner]) => Ok((inner, false)),
        ("not", _) => error(expression.line(), "\"not\" is about one proposition; write one"),
        _ => Ok((expression, true)),
    }
}

fn number(expression: &Expression) -> Result<u64, Fault> {
    let word = expression.word()?;
    let whole = word.strip_suffix(".0").unwrap_or(word);
    whole.parse().or_else(|_| error(expression.line(), format!("{word:?} is no whole number from 0; costs are such")))
}

/// The name and the sections of a definition of this kind.
fn definition<'e>(whole: &'e Expression, kind: &str) -> Result<(String, &'e [Expression]), Fault> {
    let named = match whole.headed()? {
        ("define", [named, sections @ ..]) => Some((named, sections)),
        _ => None,
    };
    match named.map(|(named, sections)| named.headed().map(|named| (named, sections))).transpose()? {
        Some(((found, [name]), sections)) if found == kind => Ok((name.word()?.to_owned(), sections)),
        _ => error(whole.line(), format!("is no definition of a {kind}; begin with (define ({kind} NAME)")),
    }
}

impl Domain {
    /// Reads a domain.
    ///
    /// # Errors
    /// The fault, and its line.
    pub fn parse(text: &str) -> Result<Self, Fault> {
        let whole = Expression::parse(text)?;
        let (name, sections) = definition(&whole, "domain")?;
        let mut domain = Self { name, ..Self::default() };
        sections_once(sections)?;
        for section in sections {
            let (head, rest) = section.headed()?;
            match head {
                ":requirements" | ":functions" => {}
                ":types" => domain.types = typed_once(rest, "type")?,
                ":constants" => domain.constants = typed_once(rest, "constant")?,
                ":predicates" => {
                    for predicate in rest {
                        let (name, parameters) = predicate.headed()?;
                        let names = domain.predicates.iter().map(|(known, _)| known.as_str()).chain([name]);
                        once(names.map(|name| (name, predicate.line())), "predicate")?;
                        domain.predicates.push((name.to_owned(), typed(parameters)?));
                    }
                }
                ":action" => {
                    let action = Schema::read(section.line(), rest)?;
                    domain.actions.push(action);
                    once(domain.actions.iter().map(|known| (known.name.as_str(), known.line)), "action")?;
                }
                other => return beyond(other, section.line()),
            }
        }
        Ok(domain)
    }
}

impl Schema {
    fn read(line: usize, items: &[Expression]) -> Result<Self, Fault> {
        let Some((name, fields)) = items.split_first() else { return error(line, "is an action without a name; write it") };
        let mut action = Self {
            name: name.word()?.to_owned(),
            line,
            parameters: vec![],
            conditions: vec![],
            equal: vec![],
            adds: vec![],
            deletes: vec![],
            cost: None,
        };
        once(fields.iter().step_by(2).filter_map(|field| Some((field.word().ok()?, field.line()))), "field")?;
        for pair in fields.chunks(2) {
            let [field, value] = pair else { return error(line, "has a field without a value; write it") };
            match field.word()? {
                ":parameters" => action.parameters = typed_once(value.list()?, "parameter")?,
                ":precondition" => {
                    for part in parts(value)? {
                        let (inner, holds) = signed(part)?;
                        match inner.headed()? {
                            ("=", terms) if terms.iter().any(|term| term.list().is_ok()) => {
                                return error(inner.line(), format!("\"=\" of a function is not understood: {NUMBERS}"));
                            }
                            ("=", [a, b]) => {
                                let terms = [a.word()?.to_owned(), b.word()?.to_owned()];
                                action.equal.push(Equal { terms, is_same: holds, line: inner.line() });
                            }
                            ("=", _) => return error(inner.line(), "\"=\" is about two terms; write two"),
                            _ => action.conditions.push((atom(inner)?, holds)),
                        }
                    }
                }
                ":effect" => {
                    for part in parts(value)? {
                        let (inner, holds) = signed(part)?;
                        match inner.headed()? {
                            ("increase", _) if !holds || action.cost.is_some() => {
                                return error(
                                    inner.line(),
                                    "changes total-cost a second time, or not at all; write one (increase (total-cost) ...)",
                                );
                            }
                            ("increase", [what, by]) if atom(what)?.predicate == TOTAL_COST => {
                                action.cost = Some(if by.list().is_ok() { Cost::Told(atom(by)?) } else { Cost::Of(number(by)?) });
                            }
                            ("increase" | "decrease" | "assign" | "scale-up" | "scale-down", _) => {
                                return error(
                                    inner.line(),
                                    "changes a number that is not total-cost; leave it out, or write a proposition for each value",
                                );
                            }
                            _ if holds => action.adds.push(atom(inner)?),
                            _ => action.deletes.push(atom(inner)?),
                        }
                    }
                }
                other => return beyond(other, field.line()),
            }
        }
        Ok(action)
    }
}

impl Problem {
    /// Reads a problem.
    ///
    /// # Errors
    /// The fault, and its line.
    pub fn parse(text: &str) -> Result<Self, Fault> {
        let whole = Expression::parse(text)?;
        let (name, sections) = definition(&whole, "problem")?;
        let mut problem = Self { name, ..Self::default() };
        sections_once(sections)?;
        for section in sections {
            let (head, rest) = section.headed()?;
            match (head, rest) {
                (":requirements", _) => {}
                (":domain", [name]) => problem.domain = (name.word()?.to_owned(), name.line()),
                (":objects", _) => problem.objects = typed_once(rest, "object")?,
                (":init", _) => {
                    for fact in rest {
                        match fact.headed()? {
                            ("=", [what, value]) => {
                                let (what, value) = (atom(what)?, number(value)?);
                                if problem.values.iter().any(|(known, other)| known.is_same(&what) && *other != value) {
                                    return error(fact.line(), format!("gives {what} a second value; leave one of the two"));
                                }
                                problem.values.push((what, value));
                            }
                            // A proposition that is not listed does not hold.
                            ("not", _) => {}
                            _ => problem.init.push(atom(fact)?),
                        }
                    }
                }
                (":goal", [goal]) => {
                    for part in parts(goal)? {
                        let (inner, holds) = signed(part)?;
                        if !holds {
                            return error(part.line(), "is a negated goal; name a proposition that is to hold");
                        }
                        problem.goal.push(atom(inner)?);
                    }
                }
                (":metric", [minimize, what]) => {
                    if minimize.word()? != "minimize" || atom(what)?.predicate != TOTAL_COST {
                        return error(section.line(), "is no metric that is understood; write (:metric minimize (total-cost))");
                    }
                    problem.minimizes_cost = true;
                }
                (other, _) => return beyond(other, section.line()),
            }
        }
        if problem.goal.is_empty() { error(whole.line(), "has no goal; add (:goal ...)") } else { Ok(problem) }
    }
}
