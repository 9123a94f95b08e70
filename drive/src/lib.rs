//! From wheels to cells and back, for a robot with two wheels that learns commands with [`goodbot`].
//!
//! - [`pose`]: the robot's pose, from the distance that each wheel has rolled;
//! - [`grid`]: the cell of a pose, and the cell that an action leads to;
//! - [`drive`]: the wheel speeds that carry out an action;
//! - [`wheel`]: encoders that wrap around, calibration, and the motor's duty for a speed;
//! - `hal`, with the feature `embedded-hal`: all of it on a board's pins, in one call for each turn of the control loop;
//! - `simulation`, with the feature of that name: a robot with slipping wheels, for tests.
//!
//! Lengths are metres, angles radians, times seconds. East is along x, north along y, and headings turn from east to north. Sines and
//! square roots are those of `micromath`: approximate, small, and the same on every target. They are called through their trait, because
//! the standard library's own would take precedence where it is linked.
//!
//! ```
//! use goodbot::home::Cell;
//! use goodbot_drive::{Drive, Grid, Limits, Motion, Pose};
//! let grid = Grid::new(0.3, 0.1)?;
//! let limits = Limits { track: 0.15, speed: 0.25, turn: 2.0, acceleration: 0.8, slowest: 0.3, silence: 0.5, patience: 10.0 };
//! let mut drive = Drive::new(limits)?;
//! // The robot stands on cell (1, 1) and faces east. It is sure of the command, and goes north.
//! let (mut pose, mut cell) = (grid.centre(Cell::new(1, 1)), Cell::new(1, 1));
//! drive.go(cell, goodbot_drive::NORTH, 0.95)?;
//! loop {
//!     drive.heard();
//!     let step = drive.step(&grid, pose, 0.01);
//!     if step.motion == Motion::Arrived { break }
//!     // A real robot reads its encoders here.
//!     pose = pose.rolled(step.wheels.left * 0.01, step.wheels.right * 0.01, limits.track);
//!     cell = grid.cell(pose, cell);
//! }
//! assert_eq!(cell, Cell::new(1, 2));
//! # Ok::<(), goodbot_drive::DriveError>(())
//! ```

#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]
#![deny(clippy::indexing_slicing, clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::unreachable)]

pub mod drive;
mod error;
pub mod grid;
#[cfg(feature = "embedded-hal")]
pub mod hal;
pub mod pose;
#[cfg(feature = "simulation")]
pub mod simulation;
pub mod wheel;

pub use drive::{Drive, Limits, Motion, Step, Wheels};
pub use error::DriveError;
pub use grid::{EAST, Grid, NORTH, SOUTH, WEST};
pub use pose::Pose;
pub use wheel::{Calibration, Encoder, Gains, SpeedControl};
