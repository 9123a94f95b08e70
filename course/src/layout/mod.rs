//! The homes of the course.
//!
//! - [`fixed`]: seven drawn homes;
//! - [`random`]: seven random homes, each solvable;
//! - [`solvable`]: whether a task can be done.

pub mod fixed;
pub mod random;
pub mod solvable;

use crate::exercise::{HomeName, Intention};
use goodbot::home::{Area, Cell, Home, HomeBuilder, HomeError, HomeState, Moves};
use goodbot::memory::HomeMemory;

/// The most rooms of a layout, and the most doors.
pub const ROOMS: usize = 4;
/// The most blocks of a layout.
pub const BLOCKS: usize = 2;

/// A block of a layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BlockPlan {
    /// Its cell.
    pub cell: Cell,
    /// Its colour.
    pub color: &'static str,
    /// Its shape.
    pub shape: &'static str,
}

/// One home as plain data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// The rooms: box and colour.
    pub rooms: [Option<(Area, &'static str)>; ROOMS],
    /// The doors.
    pub doors: [Option<Cell>; ROOMS],
    /// The agent's cell.
    pub agent: Cell,
    /// The blocks.
    pub blocks: [Option<BlockPlan>; BLOCKS],
}

const ROOM_NAMES: [&str; ROOMS] = ["room0", "room1", "room2", "room3"];
const DOOR_NAMES: [&str; ROOMS] = ["door0", "door1", "door2", "door3"];
const BLOCK_NAMES: [&str; BLOCKS] = ["block0", "block1"];

impl Layout {
    /// Builds the home in this memory.
    ///
    /// # Errors
    /// [`HomeError`] if the layout is no valid home or the memory is too small.
    pub fn build<M: HomeMemory>(&self, memory: M) -> Result<(Home<M>, HomeState), HomeError> {
        let mut builder = HomeBuilder::new(memory);
        for (name, room) in ROOM_NAMES.iter().zip(&self.rooms) {
            if let Some((area, color)) = room {
                builder.room(name, *area, color)?;
            }
        }
        for (name, door) in DOOR_NAMES.iter().zip(&self.doors) {
            if let Some(cell) = door {
                builder.door(name, Area::new(cell.x, cell.y, cell.x, cell.y))?;
            }
        }
        for (name, block) in BLOCK_NAMES.iter().zip(&self.blocks) {
            if let Some(block) = block {
                builder.block(name, block.cell, block.color, block.shape)?;
            }
        }
        builder.agent("agent0", self.agent)?;
        builder.build(Moves::Push)
    }

    /// The teachable tasks: to go to each room, and to take each block to each room, except those done already.
    pub fn teachable(&self) -> impl Iterator<Item = Intention> + '_ {
        let others = |cell: Cell| self.rooms.iter().flatten().filter(move |(area, _)| !area.holds_strictly(cell)).map(|&(_, color)| color);
        let take = move |block: &BlockPlan| {
            let BlockPlan { color, shape, cell } = *block;
            others(cell).map(move |room| Intention::take(color, shape, room))
        };
        others(self.agent).map(Intention::go).chain(self.blocks.iter().flatten().flat_map(take))
    }

    /// The number of rooms, doors and blocks.
    fn size(&self) -> usize {
        self.rooms.iter().flatten().count() + self.doors.iter().flatten().count() + self.blocks.iter().flatten().count()
    }
}

/// The seven homes of a course.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Homes {
    /// The homes of the lessons, `A` to `F`.
    pub lessons: [Layout; 6],
    /// The home of the tests.
    pub test: Layout,
}

impl Homes {
    /// The layout of one of them.
    pub const fn layout(&self, name: HomeName) -> &Layout {
        let [a, b, c, d, e, f] = &self.lessons;
        match name {
            HomeName::A => a,
            HomeName::B => b,
            HomeName::C => c,
            HomeName::D => d,
            HomeName::E => e,
            HomeName::F => f,
            HomeName::Test => &self.test,
        }
    }

    /// The teachable tasks of these homes, the simplest home first: the home, and the intended task.
    ///
    /// ```
    /// use goodbot_course::{HomeName, Homes};
    /// let lessons: Vec<String> = Homes::FIXED.teachable().map(|(home, meant)| format!("{home:?}: {meant}")).collect();
    /// assert_eq!(lessons[0], "A: go to the green room");
    /// assert!(lessons.contains(&"D: take the blue chair to the yellow room".to_owned()));
    /// ```
    pub fn teachable(&self) -> impl Iterator<Item = (HomeName, Intention)> + '_ {
        let mut homes = HomeName::ALL;
        homes.sort_unstable_by_key(|&home| (self.layout(home).size(), home as usize));
        homes.into_iter().flat_map(|home| self.layout(home).teachable().map(move |meant| (home, meant)))
    }
}
