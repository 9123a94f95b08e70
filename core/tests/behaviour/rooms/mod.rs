//! The home of these tests.

use goodbot::home::{self, Area, Cell, Home, HomeBuilder, HomeState, Moves};
use goodbot::memory::{AgentMemory, HomeArrays, HomeMemory};
use goodbot::{Agent, Capacities, Options};

goodbot::memory! { pub struct Memory = Capacities::SMALL; }

/// A green room and a red one above a blue one, in which the robot is at (4, 1).
pub fn begun<M: HomeMemory>(memory: M) -> HomeBuilder<M> {
    let mut builder = HomeBuilder::new(memory);
    builder.room("room0", Area::new(0, 0, 8, 4), "blue").unwrap();
    builder.room("room1", Area::new(0, 4, 4, 8), "green").unwrap();
    builder.room("room2", Area::new(4, 4, 8, 8), "red").unwrap();
    builder.door("door0", Area::new(2, 4, 2, 4)).unwrap();
    builder.door("door1", Area::new(6, 4, 6, 4)).unwrap();
    builder.agent("agent0", Cell::new(4, 1)).unwrap();
    builder
}

/// These rooms, with a block if a cell is given.
pub fn rooms<M: HomeMemory>(memory: M, block: Option<Cell>) -> (Home<M>, HomeState) {
    let mut builder = begun(memory);
    if let Some(cell) = block {
        builder.block("block0", cell, "yellow", "chair").unwrap();
    }
    builder.build(Moves::Push).unwrap()
}

/// These rooms, the state at the start, and an agent in this memory.
pub fn robot<M: AgentMemory>(memory: M, block: Option<Cell>, options: Options) -> (Home<HomeArrays<Memory>>, HomeState, Agent<M>) {
    let (home, start) = rooms(Memory::new().home, block);
    (home, start, Agent::new(memory, &home::paper_tasks().unwrap(), options).unwrap())
}
