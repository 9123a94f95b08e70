//! The home in its present state, to be shown.

use goodbot::home::Map;
use goodbot::home::{COLOR, Cell, Home, HomeState, ROOM};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::Domain;
use goodbot_formats::environment::{EnvironmentFile, ObjectRecord};
use goodbot_lesson::home::environment;

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
