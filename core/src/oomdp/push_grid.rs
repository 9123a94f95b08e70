//! Robots that move on a floor of cells and move pieces there.

use super::{Action, Domain, GroundProposition};
use crate::symbols::positions;

positions! {
    /// A cell, by its position in [`Floor::cells`].
    CellId(u16);
}

impl CellId {
    /// No cell: a wall, or the outside.
    pub const NONE: Self = Self(u16::MAX);
}

/// A cell of a floor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FloorCell {
    /// To the east.
    pub x: i16,
    /// To the north.
    pub y: i16,
    /// The cells to the north, south, east and west: those at distance 1, or [`CellId::NONE`].
    pub neighbours: [CellId; 4],
    /// The region of the cell, such as a room or a door. A floor without regions has 0 everywhere.
    pub region: u8,
}

impl FloorCell {
    /// The value of unused memory: zeros, so that a static needs no room in flash.
    pub const UNUSED: Self = Self { x: 0, y: 0, neighbours: [CellId(0); 4], region: 0 };
}

/// All cells where a robot or a piece can be.
#[derive(Clone, Copy, Debug)]
pub struct Floor<'a> {
    /// The cells, row by row from the south, each row from the west.
    pub cells: &'a [FloorCell],
    /// The actions that move to the north, south, east and west.
    pub directions: [Action; 4],
}

impl Floor<'_> {
    /// The cell next to `cell` in a direction (0 to 3), or [`CellId::NONE`].
    #[inline]
    pub(crate) fn neighbour(&self, cell: CellId, direction: usize) -> CellId {
        self.cells.get(cell.index()).and_then(|cell| cell.neighbours.get(direction)).copied().unwrap_or(CellId::NONE)
    }

    /// All cells, in order.
    pub(crate) fn ids(&self) -> impl Iterator<Item = CellId> + use<> {
        (0..self.cells.len().min(CellId::NONE.index())).map(|position| CellId(position as u16))
    }
}

/// Something on the floor that changes its cell: 0 is the robot, the others are the pieces that it moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Piece(pub(crate) u8);

impl Piece {
    /// The robot itself.
    pub const ROBOT: Self = Self(0);

    /// The piece with this number, below [`PushGrid::pieces`].
    pub const fn new(number: u8) -> Self {
        Self(number)
    }

    /// The position among the pieces.
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    /// The piece as a set, one bit each.
    #[inline]
    pub(crate) fn bit(self) -> u32 {
        1_u32.checked_shl(u32::from(self.0)).unwrap_or(0)
    }
}

/// Optional structure that makes planning fast: a robot on a floor of cells that moves other pieces.
///
/// These rules must hold; [`BitRows`](super::BitRows) relies on them:
/// - the state consists of the cells of the pieces, and nothing else;
/// - every action costs 1;
/// - a direction of the floor takes the robot to the neighbour cell if no piece is there, and changes nothing if there is no cell;
/// - toward a cell with a piece, a direction has the effect of [`step`](Domain::step);
/// - any other action changes nothing unless a piece is beside the robot;
/// - one action moves a piece by at most one cell.
pub trait PushGrid: Domain {
    /// Whether this domain is such a floor. One type may serve domains of several kinds, as [`Either`](super::Either) does; if this is
    /// false, states are expanded one by one, and the other functions are not called.
    fn is_floor(&self) -> bool {
        true
    }

    /// Whether [`number`](Domain::number) identifies states. If not, [`key`](Domain::key) does, and states are never searched one by one.
    fn is_numbered(&self) -> bool {
        true
    }

    /// The floor.
    fn floor(&self) -> Floor<'_>;

    /// The number of pieces, the robot included; at most 32.
    fn pieces(&self) -> usize;

    /// The cell of a piece.
    fn cell(&self, state: &Self::State, piece: Piece) -> CellId;

    /// The state with one piece moved to another cell; it need not be reachable.
    fn put(&self, state: &Self::State, piece: Piece, cell: CellId) -> Self::State;

    /// The only piece whose cell decides whether the proposition holds, or `None` if several matter.
    fn piece_of(&self, proposition: &GroundProposition) -> Option<Piece>;

    /// Whether the robot can move a piece without standing on the piece's far side, for instance by pulling. A robot that only pushes
    /// cannot move a piece out of a corner, and its planner knows that without a search.
    fn can_pull(&self) -> bool;

    /// Whether a direction toward a cell with a piece is a plain push: the piece moves to the next cell in that direction and the robot
    /// follows, or nothing changes if that cell is wall or has a piece. The planner then computes such pushes itself, with bits, which is
    /// faster than calling [`step`](Domain::step). If in doubt, return `false`.
    fn pushes_plainly(&self) -> bool {
        false
    }

    /// Whether each action that is no direction has no effect except to swap the robot with a piece beside it that has a wall or a piece on
    /// its far side, as pulling does; it need not work in every such place. If this holds, or there are only directions, and if pushes are
    /// plain, floors with more states than the memory holds also get exact plans. If in doubt, return `false`.
    fn swaps(&self) -> bool {
        false
    }
}
