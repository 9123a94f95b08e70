//! The trainers to expect: a population of strategies, fitted to what real people said.
//!
//! The paper's agent expects one trainer, silent seven times out of ten. Real people are quieter, mistake more, and a part of their words
//! comes a step late. These numbers make the words of twelve recorded workers most probable (`goodbot fit-trainers`; `docs/trainers.md`
//! describes the fit and its accuracy).
//!
//! ```
//! use goodbot::{Agent, Capacities, Options, feedback::population, home};
//! goodbot::memory! { struct Memory = Capacities { strategies: 16, beliefs: 160, ..Capacities::SMALL }; }
//! let mut memory = Memory::new();
//! let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks()?, Options::DEFAULT.for_people())?;
//! agent.set_strategies(&population::STRATEGIES)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod fitted;

pub use fitted::{ENDING, STRATEGIES};

/// The share by which the belief about a trainer drifts back to the population from one command to the next: people change how they train,
/// and somebody else may have taken over.
pub const DRIFT: f32 = 0.1;
