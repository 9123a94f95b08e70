//! What this crate is tried with, on the host and on an emulated controller, and a beginning for a simulation of one's own.
//!
//! - [`World`]: a home with a robot in it whose wheels slip and whose sensors are noisy;
//! - [`course`]: the paper's lessons, acted out there.

mod course;
mod world;

pub use course::{SimulationError, Tally, course};
pub use world::{LIMITS, World};
