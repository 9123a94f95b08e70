//! The homes and the commands of the course: four rooms of nine cells around four doorways.

use goodbot::home::{Area, Cell, Home, HomeBuilder, HomeError, HomeMemory, HomeState, Moves};

/// A block: colour, shape, cell.
pub type Block = (&'static str, &'static str, Cell);

/// One command in one home.
#[derive(Clone, Copy, Debug)]
pub struct Lesson {
    /// What the trainer says.
    pub command: &'static str,
    /// Where the robot starts.
    pub agent: Cell,
    /// The blocks.
    pub blocks: &'static [Block],
    /// The block to be brought, by position; none where the robot itself is to go.
    pub block: Option<usize>,
    /// The room to go or bring it to, by position in [`ROOMS`].
    pub room: usize,
}

/// The rooms: colour and border.
pub const ROOMS: [(&str, &str, Area); 4] = [
    ("room0", "red", Area::new(0, 0, 4, 4)),
    ("room1", "green", Area::new(4, 0, 8, 4)),
    ("room2", "blue", Area::new(0, 4, 4, 8)),
    ("room3", "yellow", Area::new(4, 4, 8, 8)),
];

const DOORS: [(&str, Cell); 4] =
    [("door0", Cell::new(4, 2)), ("door1", Cell::new(2, 4)), ("door2", Cell::new(6, 4)), ("door3", Cell::new(4, 6))];

const BLUE_CHAIR: [Block; 1] = [("blue", "chair", Cell::new(2, 2))];
const PURPLE_BAG: [Block; 1] = [("purple", "bag", Cell::new(6, 2))];
const YELLOW_BAG: [Block; 1] = [("yellow", "bag", Cell::new(6, 6))];
const BOTH: [Block; 2] = [("purple", "chair", Cell::new(2, 2)), ("blue", "bag", Cell::new(2, 6))];

const fn go(command: &'static str, agent: Cell, room: usize) -> Lesson {
    Lesson { command, agent, blocks: &[], block: None, room }
}

const fn bring(command: &'static str, blocks: &'static [Block], block: usize, room: usize) -> Lesson {
    Lesson { command, agent: Cell::new(1, 1), blocks, block: Some(block), room }
}

/// The seven lessons.
pub const LESSONS: [Lesson; 7] = [
    go("go to the green room", Cell::new(1, 1), 1),
    go("go to the red room", Cell::new(6, 6), 0),
    go("go to the blue room", Cell::new(6, 2), 2),
    go("go to the yellow room", Cell::new(2, 2), 3),
    bring("take the blue chair to the yellow room", &BLUE_CHAIR, 0, 3),
    bring("take the purple bag to the blue room", &PURPLE_BAG, 0, 2),
    bring("take the yellow bag to the red room", &YELLOW_BAG, 0, 0),
];

/// The five tests.
pub const TESTS: [Lesson; 5] = [
    bring("take the purple chair to the green room", &BOTH, 0, 1),
    bring("take the blue bag to the yellow room", &BOTH, 1, 3),
    Lesson { blocks: &BOTH, ..go("go to the green room", Cell::new(6, 6), 1) },
    Lesson { blocks: &BOTH, ..go("go to the red room", Cell::new(6, 6), 0) },
    Lesson { blocks: &BOTH, ..go("go to the blue room", Cell::new(6, 6), 2) },
];

/// The home of a lesson.
///
/// # Errors
/// Where the memory is too small.
pub fn home<'m>(lesson: &Lesson, memory: HomeMemory<'m>) -> Result<(Home<'m>, HomeState), HomeError> {
    let mut builder = HomeBuilder::new(memory);
    for (name, color, area) in ROOMS {
        builder.room(name, area, color)?;
    }
    for (name, cell) in DOORS {
        builder.door(name, Area::new(cell.x, cell.y, cell.x, cell.y))?;
    }
    for (name, &(color, shape, cell)) in ["block0", "block1"].into_iter().zip(lesson.blocks) {
        builder.block(name, cell, color, shape)?;
    }
    builder.agent("agent0", lesson.agent)?;
    builder.build(Moves::Push)
}
