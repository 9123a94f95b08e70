//! A home drawn as text, for people, tests and error messages.

use super::layout::{Area, Cell};
use super::moves::{Home, HomeState};
use super::{BLOCK, COLOR, DOOR, ROOM, SHAPE};
use crate::memory::HomeMemory;
use crate::oomdp::{Domain, ObjectId};
use core::fmt;

/// A drawing of a home in a state, north up: `#` wall, `+` doorway, `@` the agent, a capital letter for a block (the first letter of its
/// shape), and in each room the first letter of its colour, in lower case.
///
/// ```
/// use goodbot::home::{Area, Cell, HomeBuilder, Map, Moves};
/// goodbot::memory! { struct Memory = goodbot::Capacities::SMALL; }
/// let mut memory = Memory::new();
/// let mut builder = HomeBuilder::new(&mut memory.home);
/// builder.room("room0", Area::new(0, 0, 4, 3), "red")?;
/// builder.room("room1", Area::new(4, 0, 8, 3), "green")?;
/// builder.door("door0", Area::new(4, 2, 4, 2))?;
/// builder.block("block0", Cell::new(5, 1), "yellow", "chair")?;
/// builder.agent("agent0", Cell::new(2, 1))?;
/// let (home, start) = builder.build(Moves::Push)?;
/// let drawing = ["#########", "#rrr+ggg#", "#r@r#Cgg#", "#########", ""].join("\n");
/// assert_eq!(Map::new(&home, &start).to_string(), drawing);
/// # Ok::<(), goodbot::home::HomeError>(())
/// ```
#[derive(Debug)]
pub struct Map<'a, M> {
    home: &'a Home<M>,
    state: &'a HomeState,
}

impl<'a, M: HomeMemory> Map<'a, M> {
    /// The drawing of `home` in `state`.
    pub fn new(home: &'a Home<M>, state: &'a HomeState) -> Self {
        Self { home, state }
    }

    /// The box of all rooms.
    pub fn bounds(&self) -> Area {
        let rooms = self.home.world().objects.of_class(ROOM).map(|room| self.home.area(room));
        rooms
            .reduce(|a, b| Area::new(a.left.min(b.left), a.bottom.min(b.bottom), a.right.max(b.right), a.top.max(b.top)))
            .unwrap_or(Area::NOWHERE)
    }

    /// The character of one cell.
    pub fn character(&self, cell: Cell) -> char {
        let objects = self.home.world().objects;
        let first = |id: ObjectId, attribute: usize| objects.value(id, attribute).chars().next();
        if self.home.agent_cell(self.state) == cell {
            return '@';
        }
        if let Some(block) = objects.of_class(BLOCK).find(|&block| self.home.block_cell(self.state, block) == Some(cell)) {
            return first(block, SHAPE).map_or('O', |letter| letter.to_ascii_uppercase());
        }
        if super::layout::find(self.home.places(), cell).is_none() {
            return if objects.of_class(ROOM).any(|room| self.home.area(room).holds(cell)) { '#' } else { ' ' };
        }
        if let Some(room) = objects.of_class(ROOM).find(|&room| self.home.area(room).holds_strictly(cell)) {
            return first(room, COLOR).map_or('.', |letter| letter.to_ascii_lowercase());
        }
        if objects.of_class(DOOR).any(|door| self.home.area(door).holds(cell)) { '+' } else { '.' }
    }
}

impl<M: HomeMemory> fmt::Display for Map<'_, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use fmt::Write;
        let bounds = self.bounds();
        for y in (bounds.bottom..=bounds.top).rev() {
            for x in bounds.left..=bounds.right {
                f.write_char(self.character(Cell::new(x, y)))?;
            }
            f.write_char('\n')?;
        }
        Ok(())
    }
}
