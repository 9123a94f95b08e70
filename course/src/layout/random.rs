//! Random homes for the course: each with other sizes, colours, doors and places, turned and mirrored, and always solvable.
//!
//! Rooms are at least three cells wide and high, with doors and blocks away from the corners, so that a block pushed into a room can be
//! pushed out again. Otherwise a block in the intended room would often be stuck there. Then no other task could be done any more, no
//! action would be wrong for them, and the trainer's feedback at the goal could not distinguish the intended task from the rest.

use super::{BlockPlan, Homes, Layout, ROOMS, is_solvable};
use crate::exercise::{Exercise, HomeName, LESSONS, TESTS};
use goodbot::home::{Area, Cell};
use goodbot::memory::HomeMemory;
use goodbot::random::below;
use rand_core::Rng;

/// The colours of rooms.
const COLORS: [&str; ROOMS] = ["red", "green", "blue", "yellow"];
/// The number of draws before the fixed layout is used instead.
const DRAWS: usize = 1_000;

impl Homes {
    /// Random homes. In each, every command that is given there can be obeyed and is not obeyed yet. They are built in `memory` to check
    /// this.
    pub fn random<R: Rng + ?Sized>(random: &mut R, memory: &mut impl HomeMemory) -> Self {
        let mut homes = Self::FIXED;
        let names = [HomeName::A, HomeName::B, HomeName::C, HomeName::D, HomeName::E, HomeName::F];
        for (layout, name) in homes.lessons.iter_mut().zip(names) {
            *layout = solvable_layout(name, layout, random, memory);
        }
        homes.test = solvable_layout(HomeName::Test, &homes.test, random, memory);
        homes
    }
}

impl Layout {
    /// One of the course's homes at random. Every command that is given there can be obeyed and is not obeyed yet. It is built in `memory`
    /// to check this.
    pub fn random<R: Rng + ?Sized>(name: HomeName, random: &mut R, memory: &mut impl HomeMemory) -> Self {
        solvable_layout(name, Homes::FIXED.layout(name), random, memory)
    }
}

/// The exercises of a home.
fn exercises(home: HomeName) -> impl Iterator<Item = &'static Exercise> + Clone {
    LESSONS.iter().chain(&TESTS).filter(move |exercise| exercise.home == home)
}

fn solvable_layout<R: Rng + ?Sized>(name: HomeName, drawn: &Layout, random: &mut R, memory: &mut impl HomeMemory) -> Layout {
    for _ in 0..DRAWS {
        let Some(layout) = layout(name, drawn, random) else { continue };
        let Ok((home, start)) = layout.build(&mut *memory) else { continue };
        if exercises(name).all(|exercise| is_solvable(&home, &start, &exercise.intention)) {
            return layout;
        }
    }
    *drawn
}

/// A layout with rooms and blocks for the exercises of a home. `None` if two things would share a cell.
fn layout<R: Rng + ?Sized>(name: HomeName, drawn: &Layout, random: &mut R) -> Option<Layout> {
    let Plan { mut layout, east, north, start } = if name == HomeName::Test { four_rooms(random) } else { three_rooms(random) };
    let mut colors = COLORS;
    shuffle(&mut colors, random);
    for (room, color) in layout.rooms.iter_mut().flatten().zip(colors) {
        room.1 = color;
    }
    layout.agent = cell_in(&layout, start, 1, random)?;
    for (position, block) in drawn.blocks.into_iter().enumerate() {
        let Some(block) = block else { continue };
        // A block at a wall cannot be pushed in every direction.
        let cell = cell_in(&layout, start, 2, random)?;
        if let Some(slot) = layout.blocks.get_mut(position) {
            *slot = Some(BlockPlan { cell, ..block });
        }
    }
    Some(turned(layout, east, north, random))
}

/// A number from `first` to `last`.
fn between<R: Rng + ?Sized>(first: i32, last: i32, random: &mut R) -> i32 {
    let count = usize::try_from(last.saturating_sub(first).saturating_add(1)).unwrap_or(1);
    first.saturating_add(below(count, random) as i32)
}

/// Rooms without colours, and the coordinates of the walls to the east and north; those to the west and south are at 0.
struct Plan {
    layout: Layout,
    east: i32,
    north: i32,
    /// The room where agent and block start, `None` for any.
    start: Option<usize>,
}

/// The place of a wall across a home of this length, with at least three cells on each side.
fn wall<R: Rng + ?Sized>(length: i32, random: &mut R) -> i32 {
    between(4, length - 4, random)
}

/// A place for a door between two corners: not next to a corner, where a block pushed through would be stuck.
fn door<R: Rng + ?Sized>(from: i32, to: i32, random: &mut R) -> i32 {
    between(from + 2, to - 2, random)
}

/// One room over the whole width, and two side by side above it. One of the three has a door to each of the others; there the agent and
/// the block start, so that no room lies on the way to another. At most 49 cells are free: a controller can plan for a block in them.
fn three_rooms<R: Rng + ?Sized>(random: &mut R) -> Plan {
    let (east, north) = [(8, 8), (8, 9), (9, 8)].get(below(3, random)).copied().unwrap_or((8, 8));
    let (middle, split) = (wall(north, random), wall(east, random));
    let wide_to_left = Cell::new(door(0, split, random), middle);
    let wide_to_right = Cell::new(door(split, east, random), middle);
    let left_to_right = Cell::new(split, door(middle, north, random));
    let (start, one, other) = match below(3, random) {
        0 => (0, wide_to_left, wide_to_right),
        1 => (1, wide_to_left, left_to_right),
        _ => (2, wide_to_right, left_to_right),
    };
    let layout = Layout {
        rooms: [
            Some((Area::new(0, 0, east, middle), "")),
            Some((Area::new(0, middle, split, north), "")),
            Some((Area::new(split, middle, east, north), "")),
            None,
        ],
        doors: [Some(one), Some(other), None, None],
        agent: Cell::new(0, 0),
        blocks: [None; 2],
    };
    Plan { layout, east, north, start: Some(start) }
}

/// Two rooms side by side and two above them, each with a door to both its neighbours.
fn four_rooms<R: Rng + ?Sized>(random: &mut R) -> Plan {
    let (east, north) = (between(8, 9, random), between(8, 9, random));
    let (middle, front, back) = (wall(north, random), wall(east, random), wall(east, random));
    let layout = Layout {
        rooms: [
            Some((Area::new(0, 0, front, middle), "")),
            Some((Area::new(front, 0, east, middle), "")),
            Some((Area::new(0, middle, back, north), "")),
            Some((Area::new(back, middle, east, north), "")),
        ],
        doors: [
            Some(Cell::new(front, door(0, middle, random))),
            Some(Cell::new(back, door(middle, north, random))),
            Some(Cell::new(door(0, front.min(back), random), middle)),
            Some(Cell::new(door(front.max(back), east, random), middle)),
        ],
        agent: Cell::new(0, 0),
        blocks: [None; 2],
    };
    Plan { layout, east, north, start: None }
}

/// A cell inside the given room, or any, at least `far` cells from its border. `None` if it is taken.
fn cell_in<R: Rng + ?Sized>(layout: &Layout, room: Option<usize>, far: i32, random: &mut R) -> Option<Cell> {
    let room = room.unwrap_or_else(|| below(layout.rooms.iter().flatten().count(), random));
    let (area, _) = layout.rooms.iter().flatten().nth(room)?;
    let cell = Cell::new(between(area.left + far, area.right - far, random), between(area.bottom + far, area.top - far, random));
    let taken = layout.agent == cell || layout.blocks.iter().flatten().any(|block| block.cell == cell);
    (!taken).then_some(cell)
}

fn shuffle<T, R: Rng + ?Sized>(items: &mut [T], random: &mut R) {
    for last in (1..items.len()).rev() {
        items.swap(last, below(last + 1, random));
    }
}

/// The layout turned and mirrored at random: eight ways to lay it on the floor.
fn turned<R: Rng + ?Sized>(layout: Layout, east: i32, north: i32, random: &mut R) -> Layout {
    let way = below(8, random);
    let cell = |cell: Cell| {
        let x = if way & 1 == 0 { cell.x } else { east - cell.x };
        let y = if way & 2 == 0 { cell.y } else { north - cell.y };
        if way & 4 == 0 { Cell::new(x, y) } else { Cell::new(y, x) }
    };
    let area = |area: Area| {
        let (a, b) = (cell(Cell::new(area.left, area.bottom)), cell(Cell::new(area.right, area.top)));
        Area::new(a.x.min(b.x), a.y.min(b.y), a.x.max(b.x), a.y.max(b.y))
    };
    Layout {
        rooms: layout.rooms.map(|room| room.map(|(it, color)| (area(it), color))),
        doors: layout.doors.map(|door| door.map(cell)),
        agent: cell(layout.agent),
        blocks: layout.blocks.map(|block| block.map(|block| BlockPlan { cell: cell(block.cell), ..block })),
    }
}
