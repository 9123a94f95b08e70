//! The paper's course as one run that every target repeats bit for bit: seven lessons by a simulated trainer, then five commands that are
//! only heard. Who looks on may count what each part of the work costs.
//!
//! - [`lessons`]: the homes and the commands;
//! - [`run`]: the run itself;
//! - [`digest`]: all posteriors as one number.

#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod digest;
pub mod lessons;
pub mod run;

pub use digest::Digest;
pub use run::{Outcome, Watch, Work, run};
