//! The homes of the course.
//!
//! Seven are drawn, and [`random`] makes seven random ones, each solvable.

pub mod random;

use crate::exercise::{HomeName, Intention};
use goodbot::home::{Area, BLOCK_IN_ROOM, COLOR, Cell, Home, HomeBuilder, HomeError, HomeState, Moves, ROOM, SHAPE};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Action, CellId, Domain, GroundProposition, Piece, PushGrid};

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

/// Three rooms: one below, two above, with a door each. The agent starts below.
const fn lesson(below: &'static str, left: &'static str, right: &'static str, agent: Cell, block: Option<BlockPlan>) -> Layout {
    Layout {
        rooms: [Some((Area::new(0, 0, 8, 4), below)), Some((Area::new(0, 4, 4, 8), left)), Some((Area::new(4, 4, 8, 8), right)), None],
        doors: [Some(Cell::new(2, 4)), Some(Cell::new(6, 4)), None, None],
        agent,
        blocks: [block, None],
    }
}

const fn block(x: i32, y: i32, color: &'static str, shape: &'static str) -> Option<BlockPlan> {
    Some(BlockPlan { cell: Cell::new(x, y), color, shape })
}

impl Homes {
    /// The homes as drawn.
    pub const FIXED: Self = Self {
        lessons: [
            lesson("blue", "green", "red", Cell::new(4, 2), None),
            lesson("green", "red", "blue", Cell::new(4, 2), None),
            lesson("red", "blue", "yellow", Cell::new(4, 2), None),
            lesson("red", "green", "yellow", Cell::new(4, 1), block(4, 2, "blue", "chair")),
            lesson("green", "blue", "red", Cell::new(6, 1), block(4, 2, "purple", "bag")),
            lesson("blue", "yellow", "red", Cell::new(2, 3), block(4, 2, "yellow", "bag")),
        ],
        test: Layout {
            rooms: [
                Some((Area::new(0, 0, 4, 4), "yellow")),
                Some((Area::new(4, 0, 8, 4), "red")),
                Some((Area::new(0, 4, 4, 8), "green")),
                Some((Area::new(4, 4, 8, 8), "blue")),
            ],
            doors: [Some(Cell::new(4, 2)), Some(Cell::new(2, 4)), Some(Cell::new(6, 4)), Some(Cell::new(4, 6))],
            agent: Cell::new(1, 1),
            blocks: [block(6, 2, "purple", "chair"), block(6, 6, "blue", "bag")],
        },
    };
}

/// The most free cells of a home for [`is_solvable`]: one bit each.
pub const CELLS: usize = 64;

/// Reached places of the agent and of one block, and those not handled yet: a row for each place of the block, a bit for each place of the
/// agent.
struct Reached([[u64; 2]; CELLS]);

impl Reached {
    fn add(&mut self, (block, agent): (usize, usize)) {
        if let Some([reached, open]) = self.0.get_mut(block) {
            let new = 1_u64.checked_shl(agent as u32).unwrap_or(0) & !*reached;
            (*reached, *open) = (*reached | new, *open | new);
        }
    }

    /// Takes a place that is not handled yet.
    fn take(&mut self) -> Option<(usize, usize)> {
        let (block, [_, open]) = self.0.iter_mut().enumerate().find(|(_, [_, open])| *open != 0)?;
        let agent = open.trailing_zeros() as usize;
        *open &= open.wrapping_sub(1);
        Some((block, agent))
    }
}

/// The goal of an intention in a home, `None` if its objects are missing.
fn goal(home: &Home<impl HomeMemory>, intention: &Intention) -> Option<GroundProposition> {
    let objects = home.world().objects;
    let room = objects.of_class(ROOM).find(|&room| objects.value(room, COLOR) == intention.room)?;
    let subject = match intention.block {
        None => home.agent(),
        Some((color, shape)) => {
            *home.blocks().iter().find(|&&block| objects.value(block, COLOR) == color && objects.value(block, SHAPE) == shape)?
        }
    };
    Some(GroundProposition::new(intention.proposition, &[subject, room]))
}

/// Whether the intended task can be done and is not done yet. All reachable places of the agent and of the block in question are tried,
/// while the other blocks stay in place. A home of more than [`CELLS`] free cells counts as unsolvable.
pub fn is_solvable(home: &Home<impl HomeMemory>, start: &HomeState, intention: &Intention) -> bool {
    let Some(goal) = goal(home, intention) else { return false };
    if home.places().len() > CELLS || home.holds(&goal, start) {
        return false;
    }
    // The block that moves; if the agent itself is meant, every block stays.
    let moving = if goal.proposition == BLOCK_IN_ROOM { home.piece_of(&goal) } else { None };
    let cell = |state: &HomeState, piece: Piece| home.cell(state, piece).index();
    let place = |state: &HomeState| (moving.map_or(0, |piece| cell(state, piece)), cell(state, Piece::ROBOT));
    let mut reached = Reached([[0; 2]; CELLS]);
    reached.add(place(start));
    while let Some((block, agent)) = reached.take() {
        let at = home.put(start, Piece::ROBOT, CellId::new(agent as u16));
        let at = moving.map_or(at, |piece| home.put(&at, piece, CellId::new(block as u16)));
        for action in 0..home.actions().len() {
            let Some(next) = home.step(&at, Action::new(action as u8)) else { continue };
            let mut others = (1..home.pieces()).map(|piece| Piece::new(piece as u8)).filter(|&piece| Some(piece) != moving);
            if others.all(|piece| home.cell(&next, piece) == home.cell(start, piece)) {
                if home.holds(&goal, &next) {
                    return true;
                }
                reached.add(place(&next));
            }
        }
    }
    false
}
