//! Warnings: entries that are allowed, but hardly intended.

use goodbot::home::{Cell, Home, HomeState, Moves};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Action, Domain};
use goodbot_formats::environment::{EnvironmentFile, ObjectRecord};
use goodbot_formats::session::SessionHeader;
use goodbot_formats::world::{ActionOfWorld, Literal};
use goodbot_lesson::home;
use goodbot_lesson::world::robot::Robot;
use std::collections::{BTreeMap, BTreeSet, HashSet, VecDeque};

/// A warning: the object's position in the environment, if it is about one object, and the message.
pub type Warning = (Option<usize>, String);

/// The warnings for a home without faults.
pub fn of_home(environment: &EnvironmentFile) -> Vec<Warning> {
    let mut doubts = unnamed(environment);
    doubts.extend(overlaps(environment));
    let mut memory = home::memory();
    if let Ok((home, start)) = home::build(environment, Moves::Push, &mut memory) {
        doubts.extend(ways(environment, &home, &start));
    }
    doubts
}

/// Colours and shapes that no word can name.
fn unnamed(environment: &EnvironmentFile) -> Vec<Warning> {
    let mut doubts = Vec::new();
    for (position, object) in environment.objects.iter().enumerate() {
        let (color, shape) = match object {
            ObjectRecord::Room { color, .. } => (color.as_str(), "-"),
            ObjectRecord::Block { color, shape, .. } => (color.as_str(), shape.as_str()),
            ObjectRecord::Door { .. } | ObjectRecord::Agent { .. } => continue,
        };
        for (what, text) in [("color", color), ("shape", shape)] {
            if text.trim().is_empty() {
                doubts.push((Some(position), format!("its {what} is empty, so no word can name it; give it one")));
            }
        }
    }
    doubts
}

/// Rooms that share more than their walls.
fn overlaps(environment: &EnvironmentFile) -> Vec<Warning> {
    let rooms: Vec<(usize, &str, [i32; 4])> = environment
        .objects
        .iter()
        .enumerate()
        .filter_map(|(position, object)| match object {
            ObjectRecord::Room { name, left, bottom, right, top, .. } => Some((position, name.as_str(), [*left, *bottom, *right, *top])),
            _ => None,
        })
        .collect();
    let mut doubts = Vec::new();
    for (number, (position, _, [left, bottom, right, top])) in rooms.iter().enumerate() {
        for (_, other, [l, b, r, t]) in rooms.iter().take(number) {
            if left.max(l) < right.min(r) && bottom.max(b) < top.min(t) {
                doubts.push((Some(*position), format!("it overlaps {other}, so that a thing can be in both; let rooms share walls alone")));
            }
        }
    }
    doubts
}

/// Rooms that the agent cannot reach, and doors that lead nowhere.
fn ways(environment: &EnvironmentFile, home: &Home<impl HomeMemory>, start: &HomeState) -> Vec<Warning> {
    let free: BTreeSet<(i32, i32)> = home.places().iter().map(|place| (place.cell().x, place.cell().y)).collect();
    let around = |(x, y): (i32, i32)| [(x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)].into_iter().filter(|cell| free.contains(cell));
    let Cell { x, y } = home.agent_cell(start);
    let (mut reached, mut open) = (BTreeSet::from([(x, y)]), vec![(x, y)]);
    while let Some(cell) = open.pop() {
        for next in around(cell) {
            if reached.insert(next) {
                open.push(next);
            }
        }
    }
    let mut doubts = Vec::new();
    for (position, object) in environment.objects.iter().enumerate() {
        match object {
            ObjectRecord::Room { left, bottom, right, top, .. } => {
                let inside = |&&(x, y): &&(i32, i32)| (left + 1..*right).contains(&x) && (bottom + 1..*top).contains(&y);
                if !reached.iter().any(|cell| inside(&cell)) {
                    doubts.push((Some(position), "the agent cannot get there; add a door".to_owned()));
                }
            }
            ObjectRecord::Door { left, bottom, right, top, .. } => {
                let own = |&(x, y): &(i32, i32)| (*left..=*right).contains(&x) && (*bottom..=*top).contains(&y);
                let beyond: BTreeSet<(i32, i32)> = free.iter().filter(|cell| own(cell)).flat_map(|&cell| around(cell)).collect();
                if beyond.iter().filter(|cell| !own(cell)).count() < 2 {
                    doubts.push((Some(position), "the door leads nowhere; put it into a wall between two rooms".to_owned()));
                }
            }
            ObjectRecord::Agent { .. } | ObjectRecord::Block { .. } => {}
        }
    }
    doubts
}

/// The warnings for a session line: the field and the message.
pub fn of_header(header: &SessionHeader) -> Vec<(&'static str, String)> {
    let sum = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>();
    let sums = [
        ("prior", header.prior.as_ref().map(|prior| sum(&mut prior.iter().map(|(_, value)| *value)))),
        ("strategies", header.strategies.as_ref().map(|records| sum(&mut records.iter().map(|record| record.prior)))),
    ];
    let odd = |(field, sum): (&'static str, Option<f64>)| {
        let sum = sum.filter(|sum| (sum - 1.0).abs() > 1e-6)?;
        Some((field, format!("the probabilities sum to {sum:.6} and not to 1; they are divided by their sum")))
    };
    sums.into_iter().filter_map(odd).collect()
}

/// The warnings for the actions of a world's robot: the field and the message. `all` says that all its states can be visited.
pub fn of_actions(robot: &Robot<'_>, start: u64, all: bool) -> Vec<(String, String)> {
    let mut doubts = Vec::new();
    let seen = if all { seen(robot, start) } else { BTreeMap::new() };
    for (position, action) in robot.file().actions.iter().enumerate() {
        let name = &action.name;
        let others = |actions: &[ActionOfWorld]| actions.iter().any(|other| other.name == *name);
        let actions = &robot.file().actions;
        let is_first = !others(actions.get(..position).unwrap_or(&[]));
        let is_only = is_first && !others(actions.get(position + 1..).unwrap_or(&[]));
        if let Some(literal) = contradicted(&action.effects) {
            let message = format!("{literal} both holds and does not hold after {name}; the last one counts, so leave one of the two out");
            doubts.push((format!("actions[{position}]"), message));
        }
        if let Some((one, other)) = two_values(&robot.file().variables, &action.effects) {
            let message = format!("{one} and {other} give one variable two values; the last one counts, so leave one of the two out");
            doubts.push((format!("actions[{position}]"), message));
        }
        if let Some(literal) = contradicted(&action.conditions) {
            let what = if is_only { name.clone() } else { format!("this case of {name}") };
            let message = format!("{literal} is to hold and not to hold, so that {what} can never be done; leave one of the two out");
            doubts.push((format!("actions[{position}]"), message));
        } else if all && is_first {
            let message = match seen.get(name.as_str()) {
                None => format!(
                    "{name} is possible in no state that the robot reaches from these facts; correct its conditions, or leave it out"
                ),
                Some(false) => format!("{name} changes nothing in any state; correct its effects, or leave it out"),
                Some(true) => continue,
            };
            doubts.push((format!("actions[{position}]"), message));
        }
    }
    doubts
}

/// The first proposition whose negation is in the list too.
fn contradicted(literals: &[Literal]) -> Option<&Literal> {
    let is_opposite = |one: &Literal, other: &Literal| other.negated && other.proposition == one.proposition && other.terms == one.terms;
    literals.iter().find(|one| !one.negated && literals.iter().any(|other| is_opposite(one, other)))
}

/// The first two effects that give the same variable different values.
fn two_values<'a>(variables: &[String], effects: &'a [Literal]) -> Option<(&'a Literal, &'a Literal)> {
    let of = |literal: &'a Literal| literal.terms.split_last().map(|(_, of)| (&literal.proposition, of));
    let mut given = effects.iter().enumerate().filter(|(_, literal)| variables.contains(&literal.proposition));
    given.find_map(|(at, one)| Some(one).zip(effects.iter().skip(at + 1).find(|&other| of(other) == of(one) && other.terms != one.terms)))
}

/// The names of the actions that are ever possible, without their objects, and whether each ever changes something. Stops when all do.
fn seen<'r>(robot: &'r Robot<'_>, start: u64) -> BTreeMap<&'r str, bool> {
    let name = |kind: &'r str| kind.split('(').next().unwrap_or(kind);
    let (mut seen, mut known, mut open) = (BTreeMap::new(), HashSet::from([start]), VecDeque::from([start]));
    let of_file = robot.file().actions.iter().map(|action| &action.name).collect::<HashSet<_>>().len();
    while let Some(state) = open.pop_front() {
        if seen.len() == of_file && seen.values().all(|&changes| changes) {
            break;
        }
        for (position, kind) in robot.actions().iter().enumerate() {
            if let Some(next) = robot.step(&state, Action::new(position as u8)) {
                *seen.entry(name(kind.name)).or_insert(false) |= next != state;
                if known.insert(next) {
                    open.push_back(next);
                }
            }
        }
    }
    seen
}
