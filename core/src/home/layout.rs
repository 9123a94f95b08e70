//! The places of a home's rooms and doors, and its cells without wall.

use crate::oomdp::CellId;
/// A free cell of a home. Its region is the room that has it inside, or else the door.
pub use crate::oomdp::FloorCell as Place;

/// The largest distance of a coordinate from the origin, in cells.
pub const FARTHEST: i32 = 255;

/// A box of cells, its edge included.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Area {
    /// The smallest x.
    pub left: i32,
    /// The smallest y.
    pub bottom: i32,
    /// The largest x.
    pub right: i32,
    /// The largest y.
    pub top: i32,
}

impl Area {
    /// A box without cells.
    pub(crate) const NOWHERE: Self = Self { left: 0, bottom: 0, right: -1, top: -1 };

    /// The box with these sides.
    pub const fn new(left: i32, bottom: i32, right: i32, top: i32) -> Self {
        Self { left, bottom, right, top }
    }

    /// Whether the box holds the cell, its edge included.
    pub const fn holds(&self, cell: Cell) -> bool {
        cell.x >= self.left && cell.x <= self.right && cell.y >= self.bottom && cell.y <= self.top
    }

    /// Whether the cell is inside the box, its edge excluded.
    pub const fn holds_strictly(&self, cell: Cell) -> bool {
        cell.x > self.left && cell.x < self.right && cell.y > self.bottom && cell.y < self.top
    }

    /// Whether the boxes have a cell in common, their edges included.
    pub const fn meets(&self, other: Self) -> bool {
        self.left <= other.right && other.left <= self.right && self.bottom <= other.top && other.bottom <= self.top
    }

    pub(super) const fn is_within_reach(&self) -> bool {
        Cell::new(self.left, self.bottom).is_within_reach() && Cell::new(self.right, self.top).is_within_reach()
    }
}

/// A box in the memory of a home: no side is beyond [`FARTHEST`], so half the bytes are enough.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[doc(hidden)]
pub struct StoredArea([i16; 4]);

impl StoredArea {
    /// The value of unused memory.
    pub const UNUSED: Self = Self([0; 4]);

    /// Stores a box that is within reach.
    pub(super) const fn of(area: Area) -> Self {
        Self([area.left as i16, area.bottom as i16, area.right as i16, area.top as i16])
    }

    /// The box.
    pub(super) const fn area(self) -> Area {
        let [left, bottom, right, top] = self.0;
        Area::new(left as i32, bottom as i32, right as i32, top as i32)
    }
}

/// One cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Cell {
    /// To the east.
    pub x: i32,
    /// To the north.
    pub y: i32,
}

impl Cell {
    /// The cell at x and y.
    pub const fn new(x: i32, y: i32) -> Self {
        Self { x, y }
    }

    pub(super) const fn is_within_reach(&self) -> bool {
        self.x >= -FARTHEST && self.x <= FARTHEST && self.y >= -FARTHEST && self.y <= FARTHEST
    }
}

impl Place {
    /// The cell.
    pub const fn cell(&self) -> Cell {
        Cell::new(self.x as i32, self.y as i32)
    }
}

/// Whether a cell is wall: on the border of a room and in no door, or outside all rooms' boxes.
pub(super) fn is_wall(cell: Cell, rooms: impl Iterator<Item = Area>, mut doors: impl Iterator<Item = Area>) -> bool {
    let (mut on_border, mut in_room) = (false, false);
    for room in rooms {
        if room.holds(cell) {
            in_room = true;
            on_border |= !room.holds_strictly(cell);
        }
    }
    !in_room || (on_border && !doors.any(|door| door.holds(cell)))
}

/// Finds the cell among the places, which are sorted by rows from the south, and from the west within a row.
pub(super) fn find(places: &[Place], cell: Cell) -> Option<CellId> {
    places.binary_search_by_key(&(cell.y, cell.x), |place| (i32::from(place.y), i32::from(place.x))).ok().map(|found| CellId(found as u16))
}
