//! The place of a robot: a home (`Floor`), or another world from a file (`Other`); and how it is shown, a home as a [`Scene`], another world
//! as a [`Table`].

use crate::words::{in_plain_words, looks};
use goodbot::home::{COLOR, Cell, Home, HomeState, Map, ROOM};
use goodbot::memory::{HomeHeap, HomeMemory};
use goodbot::oomdp::{Domain, Either, ObjectId, World};
use goodbot_formats::FormatError;
use goodbot_formats::environment::{EnvironmentFile, ObjectRecord};
use goodbot_formats::session::RecordedSession;
use goodbot_formats::task_text::GroundAtomText;
use goodbot_formats::world::{SessionInWorld, WorldFile};
use goodbot_lesson::home::environment;
use goodbot_lesson::world::robot::Robot;
use std::sync::Arc;

/// The file of a place.
pub type Setting = Either<EnvironmentFile, Arc<WorldFile>>;

/// The place.
pub type Site = Either<Home<HomeHeap>, Robot<'static>>;

/// The state of the place; in a world from a file, a number.
pub type SiteState = <Site as Domain>::State;

/// A session as a log has it.
pub type Recorded = Either<RecordedSession, SessionInWorld>;

/// The session in a record.
pub const fn session(recorded: &Recorded) -> &RecordedSession {
    match recorded {
        Recorded::Floor(session) => session,
        Recorded::Other(recorded) => &recorded.session,
    }
}

/// The session in a record, to be changed.
pub const fn session_mut(recorded: &mut Recorded) -> &mut RecordedSession {
    match recorded {
        Recorded::Floor(session) => session,
        Recorded::Other(recorded) => &mut recorded.session,
    }
}

/// The place in its present state, as it is shown.
pub type Shown = Either<Scene, Table>;

/// The lines of a log.
///
/// # Errors
/// An error if the session could not be read again.
pub fn lines(recorded: &Recorded) -> Result<Vec<String>, FormatError> {
    match recorded {
        Recorded::Floor(session) => session.to_lines(),
        Recorded::Other(recorded) => recorded.to_lines(),
    }
}

/// The ground of one cell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ground {
    /// Outside of every room.
    Nothing,
    /// A wall.
    Wall,
    /// A gap in the walls.
    Door,
    /// The floor of a room of this colour.
    Floor(String),
}

/// The home in its present state.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Its objects at their present places, in order.
    pub environment: EnvironmentFile,
    /// Its cells, row by row; the first row is the northernmost.
    pub ground: Vec<Vec<Ground>>,
    /// The home as text: `#` is wall.
    pub map: String,
    west: i32,
    north: i32,
}

impl Scene {
    /// The robot's column and row in [`ground`](Self::ground).
    pub fn robot(&self) -> (usize, usize) {
        let robot = |object: &ObjectRecord| if let ObjectRecord::Agent { x, y, .. } = object { Some((*x, *y)) } else { None };
        self.environment.objects.iter().find_map(robot).map_or((0, 0), |(x, y)| self.at(x, y))
    }

    /// The blocks: column, row, colour and shape.
    pub fn blocks(&self) -> impl Iterator<Item = (usize, usize, &str, &str)> {
        self.environment.objects.iter().filter_map(|object| {
            let ObjectRecord::Block { x, y, color, shape, .. } = object else { return None };
            let (column, row) = self.at(*x, *y);
            Some((column, row, color.as_str(), shape.as_str()))
        })
    }

    /// The colours of the rooms, in their order.
    pub fn room_colors(&self) -> impl Iterator<Item = &str> {
        self.environment
            .objects
            .iter()
            .filter_map(|object| if let ObjectRecord::Room { color, .. } = object { Some(color.as_str()) } else { None })
    }

    fn at(&self, x: i32, y: i32) -> (usize, usize) {
        let offset = |far: i64| usize::try_from(far).unwrap_or(0);
        (offset(i64::from(x) - i64::from(self.west)), offset(i64::from(self.north) - i64::from(y)))
    }
}

/// The home in a state.
pub fn scene(home: &Home<impl HomeMemory>, state: &HomeState) -> Scene {
    let map = Map::new(home, state);
    let bounds = map.bounds();
    let ground =
        (bounds.bottom..=bounds.top).rev().map(|y| (bounds.left..=bounds.right).map(|x| ground(home, &map, Cell::new(x, y))).collect());
    Scene { environment: environment(home, state), ground: ground.collect(), map: map.to_string(), west: bounds.left, north: bounds.top }
}

fn ground(home: &Home<impl HomeMemory>, map: &Map<'_, impl HomeMemory>, cell: Cell) -> Ground {
    match map.character(cell) {
        '#' => return Ground::Wall,
        ' ' => return Ground::Nothing,
        _ => {}
    }
    let objects = home.world().objects;
    let room = objects.of_class(ROOM).find(|&room| home.area(room).holds_strictly(cell));
    room.map_or(Ground::Door, |room| Ground::Floor(objects.value(room, COLOR).to_owned()))
}

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
