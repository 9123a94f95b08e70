//! The home that the micro:bit has by itself, as large as its lights, and the commands to teach it.

use crate::memory::{Builder, Home, Rooms};
use goodbot::home::{Area, Cell, HomeError, HomeState, Moves};

/// The commands, in the order in which a long press chooses them. Who teaches the first three can ask for the fourth.
pub const COMMANDS: [&str; 4] =
    ["go to the green room", "go to the blue room", "take the chair to the green room", "take the chair to the blue room"];

/// A red room above; a green and a blue one below, each behind a door; a yellow chair in the red one. Inside its walls it has five times
/// five cells.
///
/// # Errors
/// None in this version: it is a home, and fits.
pub fn build(memory: Rooms) -> Result<(Home, HomeState), HomeError> {
    let mut builder = Builder::new(memory);
    builder.room("room0", Area::new(0, 3, 6, 6), "red")?;
    builder.room("room1", Area::new(0, 0, 3, 3), "green")?;
    builder.room("room2", Area::new(3, 0, 6, 3), "blue")?;
    builder.door("door0", Area::new(2, 3, 2, 3))?;
    builder.door("door1", Area::new(4, 3, 4, 3))?;
    builder.block("block0", Cell::new(3, 4), "yellow", "chair")?;
    builder.agent("agent0", Cell::new(1, 5))?;
    builder.build(Moves::Push)
}
