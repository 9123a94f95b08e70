//! The trainers to expect: a population of strategies, fitted to the feedback of real people.
//!
//! The paper's agent expects one trainer, silent seven times out of ten. Real people are quieter and make more mistakes. These parameters
//! maximise the likelihood of the words of twelve recorded workers (`goodbot fit-trainers`; `docs/appendix/trainers.md` describes the fit and its
//! accuracy).
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

use super::strategy::Strategy;
pub use fitted::{ENDING, STRATEGIES};

/// The probability that an exact trainer takes right for wrong: a slip of the finger.
const SLIP: f32 = 0.02;

/// Trainers who judge nearly every step rightly, with their shares of 1: by both words, by "good bot" alone, by "bad bot" alone; and those
/// who judge every other step. Their judgement of a move inside the goal is unknown: it counts as half right.
pub fn exact() -> impl Iterator<Item = (Strategy, f32)> {
    let of = |plus, minus| Strategy::of_people([plus, minus, SLIP], [plus, minus, SLIP, 0.5], Strategy::NO_LAG);
    [(of(0.05, 0.05), 0.4), (of(0.05, 1.0), 0.2), (of(1.0, 0.05), 0.2), (of(0.5, 0.5), 0.2)].into_iter()
}

/// The share by which the belief about a trainer drifts back to the population from one command to the next: people change how they train,
/// and another person may have taken over.
pub const DRIFT: f32 = 0.1;
