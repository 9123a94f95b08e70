//! Building a home from its objects, and checking it.

use super::layout::{Area, Cell, Place, StoredArea, find, is_wall};
use super::moves::{Home, HomeState, Moves, cell_bits};
use super::{AGENT, BLOCK, DOOR, ROOM};
use crate::capacity::{BLOCKS, Capacity, CapacityError};
use crate::memory::HomeMemory;
use crate::oomdp::objects::{ObjectCount, ObjectError};
use crate::oomdp::{CellId, ClassId, ObjectId, ObjectSet, Objects, StateKey};
use crate::planning::Progress;

/// The most objects of a home.
const MOST_OBJECTS: usize = if cfg!(feature = "alloc") { 96 } else { 32 };

/// A problem with a home.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// There is no agent.
    #[error("there is no agent; add one, inside a room")]
    NoAgent,
    /// There is an agent already.
    #[error("there is an agent already; a home has one")]
    SecondAgent,
    /// There is no room.
    #[error("there is no room; add one")]
    NoRoom,
    /// The room has no cell inside: it must be at least two cells wide and high from border to border.
    #[error("the room has no cell inside; its right must be at least left + 2 and its top at least bottom + 2")]
    RoomOfNoArea,
    /// The door's right is left of its left, or its top below its bottom.
    #[error("the door has no cell; its right must be at least its left and its top at least its bottom")]
    DoorOfNoArea,
    /// The agent or block is in a wall, or outside every room.
    #[error("it is in a wall or outside every room; move it inside a room or into a doorway")]
    InWall,
    /// The agent or block is on the cell of another block or of the agent.
    #[error("it is where the agent or another block is; move one of them")]
    OnAnother,
    /// A coordinate is further from the origin than [`FARTHEST`](super::layout::FARTHEST).
    #[error("a coordinate is beyond -255 to 255; move the home nearer to the origin")]
    TooFar,
    /// The free cells and the blocks together have more states than an agent can tell apart: see [`StateKey`].
    #[error("the free cells and the blocks have more states together than can be numbered; take blocks or cells away")]
    TooManyStates,
    /// Another object has this name.
    #[error("another object has this name; give each its own")]
    DuplicateName,
    /// The name is empty.
    #[error("its name is empty; give it one")]
    EmptyName,
    /// A table was full.
    #[error(transparent)]
    Capacity(CapacityError),
}

/// A problem with a home, and the object that has it, if it is a single one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HomeError {
    /// The problem.
    pub problem: Problem,
    /// The object's position, in the order in which objects were added.
    pub object: Option<u16>,
}

impl core::fmt::Display for HomeError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        if let Some(object) = self.object {
            write!(f, "object {object}: ")?;
        }
        self.problem.fmt(f)
    }
}

impl core::error::Error for HomeError {}

/// Collects the objects of a home; [`build`](Self::build) checks them as a whole.
///
/// ```
/// use goodbot::home::{Area, Cell, HomeBuilder, Moves};
/// goodbot::memory! { struct Memory = goodbot::Capacities::SMALL; }
/// let mut memory = Memory::new();
/// let mut builder = HomeBuilder::new(&mut memory.home);
/// builder.room("room0", Area::new(0, 0, 8, 4), "red")?;
/// builder.room("room1", Area::new(0, 4, 8, 8), "green")?;
/// builder.door("door0", Area::new(2, 4, 2, 4))?;
/// builder.block("block0", Cell::new(2, 2), "yellow", "chair")?;
/// builder.agent("agent0", Cell::new(4, 2))?;
/// let (home, start) = builder.build(Moves::Push)?;
/// assert_eq!(home.agent_cell(&start), Cell::new(4, 2));
/// # Ok::<(), goodbot::home::HomeError>(())
/// ```
#[derive(Debug)]
pub struct HomeBuilder<M> {
    memory: M,
    count: ObjectCount,
    agent: Option<ObjectId>,
    cells: Cells,
}

/// The progress of the search for free cells.
#[derive(Clone, Copy, Debug)]
struct Cells {
    /// The number of cells looked at, in the box around all rooms.
    seen: u32,
    /// The number of free ones among them.
    free: usize,
    /// The number of free cells with known neighbours.
    joined: usize,
}

impl Cells {
    const NONE: Self = Self { seen: 0, free: 0, joined: 0 };
}

impl<M> HomeBuilder<M> {
    /// An empty home in this memory: `memory.home`, `&mut memory.home` or any other [`HomeMemory`].
    pub const fn new(memory: M) -> Self {
        Self { memory, count: ObjectCount::NONE, agent: None, cells: Cells::NONE }
    }

    /// Returns the memory, for another home.
    pub fn into_memory(self) -> M {
        self.memory
    }
}

impl<M: HomeMemory> HomeBuilder<M> {
    fn objects(&self) -> Objects<'_> {
        Objects::new(self.memory.read().objects, self.count)
    }

    fn here(&self, problem: Problem) -> HomeError {
        HomeError { problem, object: Some(self.objects().len() as u16) }
    }

    fn add(&mut self, class: ClassId, name: &str, area: Area, values: &[&str]) -> Result<ObjectId, HomeError> {
        if !area.is_within_reach() {
            return Err(self.here(Problem::TooFar));
        }
        self.cells = Cells::NONE;
        let limit = self.memory.read().areas.len().min(MOST_OBJECTS);
        if self.objects().len() >= limit {
            return Err(self.here(Problem::Capacity(CapacityError::full(Capacity::Objects, limit))));
        }
        let mut objects = ObjectSet::with(self.memory.lend().objects, self.count);
        let added = objects.add(class, name, values);
        self.count = objects.count();
        let id = added.map_err(|error| {
            self.here(match error {
                ObjectError::DuplicateName => Problem::DuplicateName,
                ObjectError::EmptyName => Problem::EmptyName,
                ObjectError::Capacity(error) => Problem::Capacity(error),
            })
        })?;
        if let Some(slot) = self.memory.lend().areas.get_mut(id.index()) {
            *slot = StoredArea::of(area);
        }
        Ok(id)
    }

    /// Adds a room with its colour. Its box includes the border, whose cells are wall except in doors.
    ///
    /// # Errors
    /// [`HomeError`]; the home is then unchanged.
    pub fn room(&mut self, name: &str, area: Area, color: &str) -> Result<ObjectId, HomeError> {
        if area.right.saturating_sub(area.left) < 2 || area.top.saturating_sub(area.bottom) < 2 {
            return Err(self.here(Problem::RoomOfNoArea));
        }
        self.add(ROOM, name, area, &[color, ""])
    }

    /// Adds a door: a box of cells without walls.
    ///
    /// # Errors
    /// [`HomeError`]; the home is then unchanged.
    pub fn door(&mut self, name: &str, area: Area) -> Result<ObjectId, HomeError> {
        if area.right < area.left || area.top < area.bottom {
            return Err(self.here(Problem::DoorOfNoArea));
        }
        self.add(DOOR, name, area, &["", ""])
    }

    /// Adds a block.
    ///
    /// # Errors
    /// [`HomeError`]; the home is then unchanged.
    pub fn block(&mut self, name: &str, cell: Cell, color: &str, shape: &str) -> Result<ObjectId, HomeError> {
        if self.objects().of_class(BLOCK).count() >= BLOCKS {
            return Err(self.here(Problem::Capacity(CapacityError::full(Capacity::Blocks, BLOCKS))));
        }
        self.add(BLOCK, name, Area::new(cell.x, cell.y, cell.x, cell.y), &[color, shape])
    }

    /// Adds the agent.
    ///
    /// # Errors
    /// [`HomeError`]; the home is then unchanged.
    pub fn agent(&mut self, name: &str, cell: Cell) -> Result<ObjectId, HomeError> {
        if self.agent.is_some() {
            return Err(self.here(Problem::SecondAgent));
        }
        let id = self.add(AGENT, name, Area::new(cell.x, cell.y, cell.x, cell.y), &["", ""])?;
        self.agent = Some(id);
        Ok(id)
    }

    fn areas_of(&self, class: ClassId) -> impl Iterator<Item = (ObjectId, Area)> + use<'_, M> {
        let areas = self.memory.read().areas;
        self.objects().of_class(class).filter_map(move |id| Some((id, areas.get(id.index())?.area())))
    }

    /// Finds the free cells and their neighbours, with at most `budget` cells of work. [`build`](Self::build) does the remaining work. A
    /// control loop can so continue while a large home is built. Adding an object restarts the search.
    ///
    /// ```
    /// use goodbot::home::{Area, Cell, HomeBuilder, Moves};
    /// use goodbot::planning::Progress;
    /// goodbot::memory! { struct Memory = goodbot::Capacities::SMALL; }
    /// let mut memory = Memory::new();
    /// let mut builder = HomeBuilder::new(&mut memory.home);
    /// builder.room("room0", Area::new(0, 0, 8, 4), "red")?;
    /// builder.agent("agent0", Cell::new(4, 2))?;
    /// while builder.find_cells(16)? == Progress::Working {
    ///     // the rest of the control loop
    /// }
    /// let (home, start) = builder.build(Moves::Push)?;
    /// # Ok::<(), goodbot::home::HomeError>(())
    /// ```
    ///
    /// # Errors
    /// [`HomeError`]: no room, or more free cells than the memory holds.
    pub fn find_cells(&mut self, budget: u32) -> Result<Progress, HomeError> {
        let whole = |problem| HomeError { problem, object: None };
        let mut bounds: Option<Area> = None;
        for (_, room) in self.areas_of(ROOM) {
            let old = bounds.unwrap_or(room);
            bounds =
                Some(Area::new(old.left.min(room.left), old.bottom.min(room.bottom), old.right.max(room.right), old.top.max(room.top)));
        }
        let Some(bounds) = bounds else { return Err(whole(Problem::NoRoom)) };
        let width = bounds.right.saturating_sub(bounds.left).saturating_add(1).max(1) as u32;
        let all = width.saturating_mul(bounds.top.saturating_sub(bounds.bottom).saturating_add(1) as u32);
        for _ in 0..budget.max(1) {
            if self.cells.seen < all {
                let (x, y) = (self.cells.seen.checked_rem(width).unwrap_or(0), self.cells.seen.checked_div(width).unwrap_or(0));
                let cell = Cell::new(bounds.left.saturating_add(x as i32), bounds.bottom.saturating_add(y as i32));
                self.see_cell(cell).map_err(|error| whole(Problem::Capacity(error)))?;
                self.cells.seen = self.cells.seen.saturating_add(1);
            } else if self.cells.joined < self.cells.free {
                self.join_neighbours(self.cells.joined, self.cells.free);
                self.cells.joined = self.cells.joined.saturating_add(1);
            } else {
                return Ok(Progress::Done);
            }
        }
        Ok(Progress::Working)
    }

    /// Checks the home as a whole and returns it with its initial state.
    ///
    /// # Errors
    /// [`HomeError`]: no agent or room, the agent or a block in a wall or on another, more free cells than the memory holds, or too many
    /// states.
    pub fn build(self, moves: Moves) -> Result<(Home<M>, HomeState), HomeError> {
        self.try_build(moves).map_err(|(error, _)| error)
    }

    /// As [`build`](Self::build), but returns the memory if building fails.
    ///
    /// # Errors
    /// As [`build`](Self::build), with the memory.
    pub fn try_build(mut self, moves: Moves) -> Result<(Home<M>, HomeState), (HomeError, M)> {
        match self.check() {
            Ok((count, agent, start, blocks)) => {
                let block_count = self.objects().of_class(BLOCK).count();
                Ok((Home::new(self.memory, self.count, count, agent, blocks, block_count, moves), start))
            }
            Err(error) => Err((error, self.memory)),
        }
    }

    /// Finds the free cells and the cell of each thing. Returns the number of cells, the agent, the initial state, and the blocks.
    fn check(&mut self) -> Result<(usize, ObjectId, HomeState, [ObjectId; BLOCKS]), HomeError> {
        let whole = |problem| HomeError { problem, object: None };
        let Some(agent) = self.agent else { return Err(whole(Problem::NoAgent)) };
        while self.find_cells(u32::MAX)? == Progress::Working {}
        let count = self.cells.free;
        let (start, blocks) = self.start(agent, count)?;
        let block_count = self.objects().of_class(BLOCK).count();
        // If numbers overflowed, the search would take two states for one.
        let is_numbered = (0..block_count).try_fold(count as u64, |states, _| states.checked_mul(count as u64)).is_some();
        let bits = cell_bits(count).saturating_mul(block_count.saturating_add(1));
        if !is_numbered && (cfg!(not(feature = "alloc")) || bits > StateKey::BITS) {
            return Err(whole(Problem::TooManyStates));
        }
        Ok((count, agent, start, blocks))
    }

    /// Adds a cell if it is free.
    fn see_cell(&mut self, cell: Cell) -> Result<(), CapacityError> {
        if is_wall(cell, self.areas_of(ROOM).map(|(_, area)| area), self.areas_of(DOOR).map(|(_, area)| area)) {
            return Ok(());
        }
        let inside = self.areas_of(ROOM).find(|(_, area)| area.holds_strictly(cell));
        let region = inside.or_else(|| self.areas_of(DOOR).find(|(_, area)| area.holds(cell))).map_or(0, |(id, _)| id.0);
        let (limit, count) = (self.memory.read().places.len().min(CellId::NONE.index()), self.cells.free);
        let Some(slot) = self.memory.lend().places.get_mut(count).filter(|_| count < limit) else {
            return Err(CapacityError::full(Capacity::Cells, limit));
        };
        *slot = Place { x: cell.x as i16, y: cell.y as i16, neighbours: [CellId::NONE; 4], region };
        self.cells.free = count.saturating_add(1);
        Ok(())
    }

    /// Sets the neighbours of a free cell.
    fn join_neighbours(&mut self, position: usize, count: usize) {
        let free = self.memory.read().places.get(..count).unwrap_or(&[]);
        let Some(cell) = free.get(position).map(Place::cell) else { return };
        let neighbours =
            [(0, 1), (0, -1), (1, 0), (-1, 0)].map(|(x, y)| find(free, Cell::new(cell.x + x, cell.y + y)).unwrap_or(CellId::NONE));
        if let Some(place) = self.memory.lend().places.get_mut(position) {
            place.neighbours = neighbours;
        }
    }

    fn start(&self, agent: ObjectId, count: usize) -> Result<(HomeState, [ObjectId; BLOCKS]), HomeError> {
        let free = self.memory.read().places.get(..count).unwrap_or(&[]);
        let cell_of = |id: ObjectId| {
            let area = self.memory.read().areas.get(id.index()).map_or(Area::NOWHERE, |area| area.area());
            find(free, Cell::new(area.left, area.bottom)).ok_or(HomeError { problem: Problem::InWall, object: Some(u16::from(id.0)) })
        };
        let mut state = HomeState { agent: cell_of(agent)?, blocks: [CellId::NONE; BLOCKS] };
        let mut ids = [ObjectId(u8::MAX); BLOCKS];
        for (position, id) in self.objects().of_class(BLOCK).enumerate() {
            let here = cell_of(id)?;
            if here == state.agent || state.blocks.contains(&here) {
                return Err(HomeError { problem: Problem::OnAnother, object: Some(u16::from(id.0)) });
            }
            if let (Some(place), Some(slot)) = (state.blocks.get_mut(position), ids.get_mut(position)) {
                (*place, *slot) = (here, id);
            }
        }
        Ok((state, ids))
    }
}
