//! The paper's home environment (section 4): rooms with walls and doors, blocks that can be pushed about, one agent.
//!
//! - `layout`: the rooms and doors, and the free cells;
//! - `builder`: builds a home from its objects, and checks it;
//! - `moves`: the effects of north, south, east, west and pull, and the propositions that hold;
//! - `derived`: facts about rooms and blocks that follow from their places, such as leftmost (feature `ways`);
//! - `map`: a home drawn as text.
//!
//! Cells are integer pairs, x to the east, y to the north.

pub(crate) mod builder;
#[cfg(feature = "ways")]
mod derived;
pub(crate) mod layout;
pub(crate) mod map;
pub(crate) mod moves;

pub use builder::{HomeBuilder, HomeError, Problem};
pub use layout::{Area, Cell, FARTHEST, Place, StoredArea};
pub use map::Map;
pub use moves::{Home, HomeState, Moves};

use crate::capacity::{Capacity, CapacityError, LIFTED_TASKS};
use crate::oomdp::{Attribute, Carrier, Class, ClassId, Proposition, PropositionId, Schema};
use crate::task::{Clause, LiftedTask, TaskTextError};
use heapless::Vec;

/// The class of the agent.
pub const AGENT: ClassId = ClassId(0);
/// The class of rooms.
pub const ROOM: ClassId = ClassId(1);
/// The class of doors.
pub const DOOR: ClassId = ClassId(2);
/// The class of blocks.
pub const BLOCK: ClassId = ClassId(3);

/// `agentInRoom(agent, room)`: the agent is strictly inside the room; a doorway is in no room.
pub const AGENT_IN_ROOM: PropositionId = PropositionId(0);
/// `blockInRoom(block, room)`: the block is strictly inside the room.
pub const BLOCK_IN_ROOM: PropositionId = PropositionId(1);
/// `agentInDoor(agent, door)`: the agent is in the door's box, its edge included.
pub const AGENT_IN_DOOR: PropositionId = PropositionId(2);
/// `blockInDoor(block, door)`: the block is in the door's box, its edge included.
pub const BLOCK_IN_DOOR: PropositionId = PropositionId(3);

/// The position of `color` among a home's attributes.
pub const COLOR: usize = 0;
/// The position of `shape` among a home's attributes.
pub const SHAPE: usize = 1;

/// The classes, attributes and propositional functions of every home. Colours and shapes are data.
pub const SCHEMA: Schema<'static> = Schema {
    classes: &[Class::new("agent"), Class::new("room"), Class::new("door"), Class::new("block")],
    attributes: &[
        Attribute::new("color", &[Carrier::new(ROOM, "roomIs"), Carrier::new(BLOCK, "blockIs")]),
        Attribute::new("shape", &[Carrier::new(BLOCK, "shape")]),
    ],
    propositions: &[
        Proposition::new("agentInRoom", &[AGENT, ROOM]),
        Proposition::new("blockInRoom", &[BLOCK, ROOM]),
        Proposition::new("agentInDoor", &[AGENT, DOOR]),
        Proposition::new("blockInDoor", &[BLOCK, DOOR]),
    ],
};

/// The paper's two lifted tasks: `agentInRoom(?a, ?r)` and `blockInRoom(?o, ?r)`.
///
/// # Errors
/// None in this version: the schema has both.
pub fn paper_tasks() -> Result<[LiftedTask; 2], TaskTextError> {
    Ok([LiftedTask::single(AGENT_IN_ROOM, &SCHEMA)?, LiftedTask::single(BLOCK_IN_ROOM, &SCHEMA)?])
}

/// These lifted tasks, and each with the ways of a robot that moves from room to room: through a room, avoiding a room, through one of two
/// rooms. A task with a way gets no further one.
///
/// ```
/// use goodbot::home::{paper_tasks, with_routes};
/// assert_eq!(with_routes(&paper_tasks()?)?.len(), 8);
/// # Ok::<(), goodbot::task::TaskTextError>(())
/// ```
///
/// # Errors
/// [`TaskTextError::Capacity`] if there are more than [`LIFTED_TASKS`], and [`TaskTextError::NoWays`] if the library was built without
/// ways.
pub fn with_routes(tasks: &[LiftedTask]) -> Result<Vec<LiftedTask, LIFTED_TASKS>, TaskTextError> {
    let full = |_| CapacityError::full(Capacity::LiftedTasks, LIFTED_TASKS);
    let mut all = Vec::new();
    for task in tasks {
        all.push(task.clone()).map_err(full)?;
    }
    for task in tasks.iter().filter(|task| !task.has_way()) {
        for (clause, rooms) in [(Clause::Through, 1), (Clause::Avoiding, 1), (Clause::Through, 2)] {
            all.push(task.with_clause(clause, AGENT_IN_ROOM, rooms, &SCHEMA)?).map_err(full)?;
        }
    }
    Ok(all)
}
