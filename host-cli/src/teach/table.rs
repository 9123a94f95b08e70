//! A world from a file as it is now, for those who look on: its objects, and what holds of them.

use super::plain_names::{in_plain_words, looks};
use goodbot::oomdp::Domain;
use goodbot_formats::task_text::GroundAtomText;
use goodbot_lesson::world::robot::Robot;

/// An object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// Its name in the file.
    pub name: String,
    /// What can be said of it at any time: `red kitchen lamp`; empty where that is its name.
    pub looks: String,
    /// What holds of it now, and the actions can change: `lift at floor: office floor`.
    pub holds: Vec<String>,
}

/// A world as it is now.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// Its name.
    pub name: String,
    /// What holds, as a log has it, and the actions can change.
    pub facts: Vec<GroundAtomText>,
    /// Its objects, those first of which something holds that can change.
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
    Table { name: robot.file().name.clone(), facts, rows }
}
