//! Reads domains and problems from their lists.

use super::expression::{Expression, error};
use super::{Atom, Cost, Domain, PddlError, Problem, Schema, Typed};
use std::collections::BTreeSet;

/// The type of all objects.
const OBJECT: &str = "object";
const TOTAL_COST: &str = "total-cost";

/// Words of PDDL that are not supported, with the remedy.
const BEYOND: [(&str, &str); 8] = [
    ("when", "conditional effects are beyond STRIPS; write an action for each case"),
    ("forall", "quantifiers are beyond STRIPS; write what holds of each object"),
    ("exists", "quantifiers are beyond STRIPS; make it a parameter"),
    ("or", "alternatives are beyond STRIPS; write an action for each"),
    ("imply", "alternatives are beyond STRIPS; write an action for each"),
    (":durative-action", "time is not understood; write an action"),
    (":derived", "derived predicates are not understood; let the actions say what holds"),
    (":constraints", "constraints are not understood; leave them out"),
];

fn beyond<T>(word: &str, line: usize) -> Result<T, PddlError> {
    match BEYOND.iter().find(|(known, _)| *known == word) {
        Some((_, instead)) => error(line, format!("{word:?} is not understood: {instead}")),
        None => error(line, format!("{word:?} is not understood here; leave it out")),
    }
}

/// `a b - kind c`: names with their types.
fn typed(items: &[Expression]) -> Result<Vec<Typed>, PddlError> {
    let (mut all, mut first) = (Vec::<Typed>::new(), 0);
    let mut items = items.iter();
    while let Some(item) = items.next() {
        let word = item.word()?;
        if word != "-" {
            all.push(Typed { name: word.to_owned(), kind: OBJECT.to_owned() });
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

/// As [`typed`], but each name may occur once.
fn typed_once(items: &[Expression], what: &str, line: usize) -> Result<Vec<Typed>, PddlError> {
    let all = typed(items)?;
    once(all.iter().map(|it| it.name.as_str()), what, line)?;
    Ok(all)
}

/// Refuses a name that is given twice.
fn once<'n>(names: impl Iterator<Item = &'n str>, what: &str, line: usize) -> Result<(), PddlError> {
    let mut known = BTreeSet::new();
    for name in names {
        if !known.insert(name) {
            return error(line, format!("gives the {what} {name} twice; give each a name of its own"));
        }
    }
    Ok(())
}

fn atom(expression: &Expression) -> Result<Atom, PddlError> {
    let (predicate, terms) = expression.headed()?;
    if BEYOND.iter().any(|(known, _)| *known == predicate) {
        return beyond(predicate, expression.line());
    }
    let terms = terms.iter().map(|term| term.word().map(str::to_owned)).collect::<Result<_, _>>()?;
    Ok(Atom { predicate: predicate.to_owned(), terms })
}

/// The parts of a conjunction; an empty list has none.
fn parts(expression: &Expression) -> Result<Vec<&Expression>, PddlError> {
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
fn signed(expression: &Expression) -> Result<(&Expression, bool), PddlError> {
    match expression.headed()? {
        ("not", [inner]) => Ok((inner, false)),
        ("not", _) => error(expression.line(), "\"not\" is about one proposition; write one"),
        _ => Ok((expression, true)),
    }
}

fn number(expression: &Expression) -> Result<u64, PddlError> {
    let word = expression.word()?;
    let whole = word.strip_suffix(".0").unwrap_or(word);
    whole.parse().or_else(|_| error(expression.line(), format!("{word:?} is no whole number from 0; costs are such")))
}

/// The name and the sections of a definition of this kind.
fn definition<'e>(whole: &'e Expression, kind: &str) -> Result<(String, &'e [Expression]), PddlError> {
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
    pub fn parse(text: &str) -> Result<Self, PddlError> {
        let whole = Expression::parse(text)?;
        let (name, sections) = definition(&whole, "domain")?;
        let mut domain = Self { name, ..Self::default() };
        for section in sections {
            let (head, rest) = section.headed()?;
            match head {
                ":requirements" | ":functions" => {}
                ":types" => domain.types = typed(rest)?,
                ":constants" => domain.constants = typed_once(rest, "constant", section.line())?,
                ":predicates" => {
                    for predicate in rest {
                        let (name, parameters) = predicate.headed()?;
                        let others = domain.predicates.iter().map(|(known, _)| known.as_str());
                        once(others.chain([name]), "predicate", predicate.line())?;
                        domain.predicates.push((name.to_owned(), typed(parameters)?));
                    }
                }
                ":action" => {
                    let action = Schema::read(section.line(), rest)?;
                    let others = domain.actions.iter().map(|known| known.name.as_str());
                    once(others.chain([action.name.as_str()]), "action", section.line())?;
                    domain.actions.push(action);
                }
                other => return beyond(other, section.line()),
            }
        }
        Ok(domain)
    }
}

impl Schema {
    fn read(line: usize, items: &[Expression]) -> Result<Self, PddlError> {
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
        for pair in fields.chunks(2) {
            let [field, value] = pair else { return error(line, "has a field without a value; write it") };
            match field.word()? {
                ":parameters" => action.parameters = typed_once(value.list()?, "parameter", value.line())?,
                ":precondition" => {
                    for part in parts(value)? {
                        let (inner, holds) = signed(part)?;
                        match (inner.headed()?, atom(inner)?) {
                            (("=", _), Atom { terms, .. }) => match terms.as_slice() {
                                [a, b] => action.equal.push((a.clone(), b.clone(), holds)),
                                _ => return error(inner.line(), "\"=\" is about two terms; write two"),
                            },
                            (_, atom) => action.conditions.push((atom, holds)),
                        }
                    }
                }
                ":effect" => {
                    for part in parts(value)? {
                        let (inner, holds) = signed(part)?;
                        match inner.headed()? {
                            ("increase", [what, by]) if atom(what)?.predicate == TOTAL_COST => {
                                action.cost = Some(if by.list().is_ok() { Cost::Told(atom(by)?) } else { Cost::Of(number(by)?) });
                            }
                            ("increase" | "decrease" | "assign" | "scale-up" | "scale-down", _) => {
                                return error(inner.line(), "changes a number that is not total-cost; leave it out");
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
    pub fn parse(text: &str) -> Result<Self, PddlError> {
        let whole = Expression::parse(text)?;
        let (name, sections) = definition(&whole, "problem")?;
        let mut problem = Self { name, ..Self::default() };
        for section in sections {
            let (head, rest) = section.headed()?;
            match (head, rest) {
                (":requirements", _) => {}
                (":domain", [name]) => name.word()?.clone_into(&mut problem.domain),
                (":objects", _) => problem.objects = typed_once(rest, "object", section.line())?,
                (":init", _) => {
                    for fact in rest {
                        match fact.headed()? {
                            ("=", [what, value]) => problem.values.push((atom(what)?, number(value)?)),
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
