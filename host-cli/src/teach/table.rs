//! A world from a file in its present state, to be shown: its objects, and the facts about each.

use super::plain_names::{in_plain_words, looks};
use goodbot::oomdp::{Domain, ObjectId, World};
use goodbot_formats::task_text::GroundAtomText;
use goodbot_lesson::world::robot::Robot;

/// An object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// Its name in the file.
    pub name: String,
    /// Its attributes and class, `red kitchen lamp`; empty if they are its name.
    pub looks: String,
    /// The present facts about it that actions can change: `lift at floor: office floor`.
    pub holds: Vec<String>,
}

/// A place that has coordinates.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spot {
    /// Its coordinates to the east and to the north.
    pub at: (i32, i32),
    /// Its attributes, without the coordinates.
    pub looks: String,
    /// The names of the things in it: a fact about each has this place as its last object.
    pub here: Vec<String>,
}

/// The attributes that are coordinates.
const COORDINATES: [&str; 2] = ["x", "y"];

/// The places of a world that have coordinates.
fn places(robot: &Robot<'_>, facts: &[GroundAtomText]) -> Vec<Spot> {
    let World { schema, objects } = robot.world();
    let [x, y] = COORDINATES.map(|name| schema.attributes.iter().position(|attribute| attribute.name == name));
    let (Some(x), Some(y)) = (x, y) else { return vec![] };
    let place = |id: ObjectId| {
        let at = (objects.value(id, x).parse().ok()?, objects.value(id, y).parse().ok()?);
        let values = (0..schema.attributes.len())
            .filter(|&attribute| attribute != x && attribute != y)
            .map(|attribute| objects.value(id, attribute));
        let values: Vec<&str> = values.filter(|value| !value.is_empty()).collect();
        let looks = if values.is_empty() { objects.name(id).to_owned() } else { values.join(" ") };
        let is_here = |fact: &&GroundAtomText| matches!(fact.arguments(), [_, .., last] if last == objects.name(id));
        let here = facts.iter().filter(is_here).filter_map(|fact| fact.arguments().first().cloned()).collect();
        Some(Spot { at, looks, here })
    };
    objects.iter().filter_map(|(id, _)| place(id)).collect()
}

/// A world in its present state.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// Its name.
    pub name: String,
    /// The present facts that actions can change, as in a log.
    pub facts: Vec<GroundAtomText>,
    /// Its places: objects with whole numbers as attributes `x` and `y`.
    pub places: Vec<Spot>,
    /// Its objects, those with facts that can change first.
    pub rows: Vec<Row>,
}

/// A world in a state.
pub fn table(robot: &Robot<'_>, state: u64) -> Table {
    let facts: Vec<GroundAtomText> = robot.facts(state).into_iter().filter(|fact| robot.changes(fact)).collect();
    let objects = robot.world().objects;
    let row = |name: &str, looks: String| {
        let of_it = |fact: &&GroundAtomText| fact.arguments().first().is_some_and(|first| first == name);
        let told = |fact: &GroundAtomText| {
            let others = fact.arguments().iter().skip(1).filter_map(|other| objects.find(other)).map(|other| self::looks(robot, other));
            let others: Vec<String> = others.collect();
            let what = in_plain_words(fact.function());
            if others.is_empty() { what } else { format!("{what}: {}", others.join(", ")) }
        };
        Row {
            name: name.to_owned(),
            looks: if looks == name { String::new() } else { looks },
            holds: facts.iter().filter(of_it).map(told).collect(),
        }
    };
    let mut rows: Vec<Row> = objects.iter().map(|(object, _)| row(objects.name(object), looks(robot, object))).collect();
    rows.sort_by_key(|row| row.holds.is_empty());
    Table { name: robot.file().name.clone(), places: places(robot, &facts), facts, rows }
}
