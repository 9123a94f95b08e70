//! The paper's course as one run that every target repeats bit for bit. An observer can count the cost of each part of the work.
//!
//! - [`run()`]: the run: seven lessons by a simulated trainer, then five commands that are only heard;
//! - [`stop()`]: "stop" at many moments of a lesson;
//! - [`digest`]: all posteriors as one number.

#![no_std]
#![deny(missing_docs)]

#[cfg(target_arch = "wasm32")]
extern crate std;

pub mod digest;
pub mod run;
pub mod stop;
#[cfg(target_arch = "wasm32")]
mod wasm;

pub use digest::Digest;
pub use run::{Budget, LESSONS, Outcome, SEED, Watch, Work, run};
pub use stop::{Stops, stop};
