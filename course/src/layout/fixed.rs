//! The course's homes as drawn: one wide room below and two above for the lessons, four rooms around a cross for the tests.

use super::{BlockPlan, Homes, Layout};
use goodbot::home::{Area, Cell};

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
