//! The course's homes at random: other sizes, colours, doors and places in each, turned and mirrored, and always solvable.

use super::solvable::is_solvable;
use super::{BlockPlan, Homes, Layout, ROOMS, lend};
use crate::exercise::{Exercise, HomeName, LESSONS, TESTS};
use goodbot::feedback::simulated::below;
use goodbot::home::{Area, Cell, HomeMemory};
use rand_core::Rng;

/// The colours of rooms.
const COLORS: [&str; ROOMS] = ["red", "green", "blue", "yellow"];
/// How often a layout is drawn anew before the fixed one is taken instead.
const DRAWS: usize = 1_000;
/// The coordinate of the walls to the east and north; those to the west and south are at 0.
const SIDE: i32 = 8;

impl Homes {
    /// Homes at random. In each, every command that is given there can be obeyed and is not obeyed yet, and the agent does not start in a
    /// room that one of them speaks of. `memory` is where the homes are tried out.
    pub fn random<R: Rng + ?Sized>(random: &mut R, memory: &mut HomeMemory<'_>) -> Self {
        let mut homes = Self::FIXED;
        let names = [HomeName::A, HomeName::B, HomeName::C, HomeName::D, HomeName::E, HomeName::F];
        for (layout, name) in homes.lessons.iter_mut().zip(names) {
            *layout = solvable_layout(name, layout, random, memory);
        }
        homes.test = solvable_layout(HomeName::Test, &homes.test, random, memory);
        homes
    }
}

/// The exercises of a home.
fn exercises(home: HomeName) -> impl Iterator<Item = &'static Exercise> + Clone {
    LESSONS.iter().chain(&TESTS).filter(move |exercise| exercise.home == home)
}

fn solvable_layout<R: Rng + ?Sized>(name: HomeName, drawn: &Layout, random: &mut R, memory: &mut HomeMemory<'_>) -> Layout {
    for _ in 0..DRAWS {
        let Some(layout) = layout(name, drawn, random) else { continue };
        let Ok((home, start)) = layout.build(lend(memory)) else { continue };
        if exercises(name).all(|exercise| is_solvable(&home, &start, &exercise.intention)) {
            return layout;
        }
    }
    *drawn
}

/// A layout with rooms and blocks for the exercises of a home. `None` where no room is left for the agent to start in.
fn layout<R: Rng + ?Sized>(name: HomeName, drawn: &Layout, random: &mut R) -> Option<Layout> {
    let mut layout = if name == HomeName::Test { four_rooms(random) } else { three_rooms(random) };
    let mut colors = COLORS;
    shuffle(&mut colors, random);
    for (room, color) in layout.rooms.iter_mut().flatten().zip(colors) {
        room.1 = color;
    }
    // The tests speak of all rooms; there it is enough that the agent itself need not stay where it is.
    let is_spoken_of = |color: &str| {
        exercises(name).any(|exercise| exercise.intention.room == color && (name != HomeName::Test || exercise.intention.block.is_none()))
    };
    layout.agent = cell_in(&layout, |color| !is_spoken_of(color), random)?;
    for (slot, block) in layout.blocks.iter_mut().zip(drawn.blocks) {
        if let Some(block) = block {
            *slot = Some(BlockPlan { cell: Cell::new(0, 0), ..block });
        }
    }
    for position in 0..layout.blocks.len() {
        let cell = cell_in(&layout, |_| true, random)?;
        if let Some(Some(block)) = layout.blocks.get_mut(position) {
            block.cell = cell;
        }
    }
    Some(turned(layout, random))
}

/// A number from `first` to `last`.
fn between<R: Rng + ?Sized>(first: i32, last: i32, random: &mut R) -> i32 {
    let count = usize::try_from(last.saturating_sub(first).saturating_add(1)).unwrap_or(1);
    first.saturating_add(below(count, random) as i32)
}

/// One room over the whole width, two beside each other behind it; a door to each, and sometimes one between the two.
fn three_rooms<R: Rng + ?Sized>(random: &mut R) -> Layout {
    let (wide, split) = (between(3, 5, random), between(3, 5, random));
    let between_the_two = Cell::new(split, between(wide + 1, SIDE - 1, random));
    Layout {
        rooms: [
            Some((Area::new(0, 0, SIDE, wide), "")),
            Some((Area::new(0, wide, split, SIDE), "")),
            Some((Area::new(split, wide, SIDE, SIDE), "")),
            None,
        ],
        doors: [
            Some(Cell::new(between(1, split - 1, random), wide)),
            Some(Cell::new(between(split + 1, SIDE - 1, random), wide)),
            Some(between_the_two).filter(|_| below(2, random) == 0),
            None,
        ],
        agent: Cell::new(0, 0),
        blocks: [None; 2],
    }
}

/// Two rooms beside each other and two behind them, each with a door to both its neighbours.
fn four_rooms<R: Rng + ?Sized>(random: &mut R) -> Layout {
    let (middle, front, back) = (between(3, SIDE - 3, random), between(3, SIDE - 3, random), between(3, SIDE - 3, random));
    Layout {
        rooms: [
            Some((Area::new(0, 0, front, middle), "")),
            Some((Area::new(front, 0, SIDE, middle), "")),
            Some((Area::new(0, middle, back, SIDE), "")),
            Some((Area::new(back, middle, SIDE, SIDE), "")),
        ],
        doors: [
            Some(Cell::new(front, between(1, middle - 1, random))),
            Some(Cell::new(back, between(middle + 1, SIDE - 1, random))),
            Some(Cell::new(between(1, front.min(back) - 1, random), middle)),
            Some(Cell::new(between(front.max(back) + 1, SIDE - 1, random), middle)),
        ],
        agent: Cell::new(0, 0),
        blocks: [None; 2],
    }
}

/// A free cell inside a room of a colour that will do.
fn cell_in<R: Rng + ?Sized>(layout: &Layout, will_do: impl Fn(&str) -> bool, random: &mut R) -> Option<Cell> {
    let rooms = || layout.rooms.iter().flatten().filter(|(_, color)| will_do(color));
    let (area, _) = rooms().nth(below(rooms().count(), random))?;
    let cell = Cell::new(between(area.left + 1, area.right - 1, random), between(area.bottom + 1, area.top - 1, random));
    let taken = layout.agent == cell || layout.blocks.iter().flatten().any(|block| block.cell == cell);
    (!taken).then_some(cell)
}

fn shuffle<T, R: Rng + ?Sized>(items: &mut [T], random: &mut R) {
    for last in (1..items.len()).rev() {
        items.swap(last, below(last + 1, random));
    }
}

/// The layout turned and mirrored at random: eight ways to lay it on the floor.
fn turned<R: Rng + ?Sized>(layout: Layout, random: &mut R) -> Layout {
    let way = below(8, random);
    let cell = |cell: Cell| {
        let x = if way & 1 == 0 { cell.x } else { SIDE - cell.x };
        let y = if way & 2 == 0 { cell.y } else { SIDE - cell.y };
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
