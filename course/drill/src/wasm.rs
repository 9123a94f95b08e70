//! The drill for a WebAssembly engine: nothing is imported.

use crate::{Budget, SEED, run};
use std::boxed::Box;

goodbot::memory! { struct Memory = goodbot::Capacities::SMALL; }

/// The digest of the run; 0 if the run failed.
#[unsafe(no_mangle)]
pub extern "C" fn goodbot_drill_digest() -> u32 {
    let mut memory = Box::new(Memory::new());
    run(&mut memory.home, &mut memory.agent, SEED, Budget::ROUNDS, &mut ()).map_or(0, |outcome| outcome.digest.0)
}
