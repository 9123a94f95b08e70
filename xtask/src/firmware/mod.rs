//! The firmware: built for each board and preset, run in the emulator.
//!
//! - [`board`]: the boards and how the emulator is told of them;
//! - [`image`]: one linked firmware, its sizes and symbols;
//! - [`trial`]: everything that was built and run, once in a run of this program;
//! - [`microbit`]: the file for a BBC micro:bit, to be dragged onto it;
//! - [`alone`]: programs for one board alone: a robot of one's own, plans for tasks with ways, lessons on wheels that slip;
//! - [`digests`]: the same run on this machine and in WebAssembly.

pub mod alone;
pub mod board;
pub mod digests;
pub mod image;
pub mod microbit;
pub mod trial;

pub use alone::Alone;
pub use trial::{Trial, images, trials};
