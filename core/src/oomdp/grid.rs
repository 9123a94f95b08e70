//! Robots that go about in a grid of cells.

use super::Action;

/// How the places of a robot lie in a row of bits: line of cells after line of cells. See [`Domain::grid`](super::Domain::grid).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    /// Bits from a cell to its neighbour in the next line. At least one bit more than a line has cells, so that nothing steps from the end of
    /// a line to the beginning of another.
    pub width: usize,
    /// Bits up to the last cell.
    pub bits: usize,
    /// The actions that go to the next line, to the line before, to the next cell of the line and to the cell before.
    pub directions: [Action; 4],
}

impl Grid {
    /// By how many bits a direction, in the order of [`directions`](Self::directions), goes on.
    pub fn shift(&self, direction: usize) -> isize {
        let width = isize::try_from(self.width).unwrap_or(0);
        match direction {
            0 => width,
            1 => width.wrapping_neg(),
            2 => 1,
            _ => -1,
        }
    }
}
