//! The cell of a pose, and the cell that an action leads to.

use crate::error::DriveError;
use crate::pose::Pose;
use goodbot::home::Cell;
use goodbot::oomdp::Action;
use micromath::F32Ext;

/// The home's action to the north.
pub const NORTH: Action = Action::new(0);
/// The home's action to the south.
pub const SOUTH: Action = Action::new(1);
/// The home's action to the east.
pub const EAST: Action = Action::new(2);
/// The home's action to the west.
pub const WEST: Action = Action::new(3);

/// The direction of an action, in cells to the east and to the north; `None` if it does not move the robot to a neighbour.
pub const fn direction(action: Action) -> Option<(i32, i32)> {
    match action {
        NORTH => Some((0, 1)),
        SOUTH => Some((0, -1)),
        EAST => Some((1, 0)),
        WEST => Some((-1, 0)),
        _ => None,
    }
}

/// The floor as square cells, with (0, 0) around the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    size: f32,
    hysteresis: f32,
}

impl Grid {
    /// Cells with sides of `size` metres. The cell changes only if the robot is `hysteresis` of a cell beyond the border, so a robot on the
    /// border does not flicker between two cells.
    ///
    /// # Errors
    /// [`DriveError::CellSize`] unless the size is above 0; [`DriveError::Hysteresis`] unless that is from 0 to below a half.
    pub fn new(size: f32, hysteresis: f32) -> Result<Self, DriveError> {
        if !(size > 0.0 && size.is_finite()) {
            return Err(DriveError::CellSize(size));
        }
        if !(0.0..0.5).contains(&hysteresis) {
            return Err(DriveError::Hysteresis(hysteresis));
        }
        Ok(Self { size, hysteresis })
    }

    /// The length of a cell's side, metres.
    pub const fn size(&self) -> f32 {
        self.size
    }

    /// The middle of a cell; the heading is east.
    pub const fn centre(&self, cell: Cell) -> Pose {
        Pose { x: cell.x as f32 * self.size, y: cell.y as f32 * self.size, heading: 0.0 }
    }

    /// The cell of a pose, given the previous cell. A pose that is not finite keeps the cell.
    #[must_use]
    pub fn cell(&self, pose: Pose, before: Cell) -> Cell {
        if !(pose.x.is_finite() && pose.y.is_finite()) {
            return before;
        }
        let along = |at: f32, before: i32| {
            let at = at / self.size;
            let border = 0.5 + self.hysteresis;
            if (-border..=border).contains(&(at - before as f32)) { before } else { F32Ext::floor(at + 0.5) as i32 }
        };
        Cell::new(along(pose.x, before.x), along(pose.y, before.y))
    }
}
