//! The test bed of this crate, on the host and on an emulated controller, and a starting point for your own simulation.
//!
//! - [`World`]: a home with a robot whose wheels slip and whose sensors are noisy;
//! - [`course`]: the paper's lessons, acted out there.

mod course;
mod world;

pub use course::{SimulationError, Tally, course};
pub use world::{LIMITS, World};
