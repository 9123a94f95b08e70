//! Tests with hostile input: one function for each fuzz target, called by `tests/fuzz/fuzz_targets` and by the tests alike.
//!
//! Each takes any bytes. None may panic, and the results must be sound: no NaN, no probability outside [0, 1].

mod belief;
mod bounds;
mod budgets;
mod bytes;
mod calls;
mod capi;
mod commands;
mod environment;
mod made;
mod model;
mod session;
mod tables;
mod tokenizer;

pub use belief::belief;
pub use bounds::{Seen, bounds, compare};
pub use budgets::budgets;
pub use bytes::Bytes;
pub use calls::calls;
pub use capi::capi;
pub use commands::{COMMANDS, PICTURES, Place, Program, Run, TRIES, assert_harmless, commands};
pub use environment::environment;
pub use made::{corpus, made};
pub use model::{model, sign};
pub use session::session;
pub use tables::{Harmless, named, read_by_c, table, tables, world};
pub use tokenizer::tokenizer;

use goodbot::Agent;
use goodbot::memory::AgentMemory;

/// A fuzz target: its name, which is also that of its corpus, and its function.
pub type Target = (&'static str, fn(&[u8]));

/// All fuzz targets.
pub const TARGETS: [Target; 9] = [
    ("environment", environment),
    ("session", session),
    ("model", model),
    ("tokenizer", tokenizer),
    ("calls", calls),
    ("capi", capi),
    ("budgets", budgets),
    ("belief", belief),
    ("bounds", bounds),
];

/// A fuzz target that needs the command line, which this crate does not depend on.
pub type TargetWithProgram = (&'static str, fn(&[u8], &Program<'_>));

/// All fuzz targets that need the command line.
pub const TARGETS_WITH_PROGRAM: [TargetWithProgram; 2] = [("commands", commands), ("tables", tables)];

/// Asserts that every belief and parameter of an agent is a probability, and that the posterior sums to 1.
fn assert_sound(agent: &Agent<impl AgentMemory>) {
    let probability = |what: &str, value: f32| assert!((0.0..=1.0).contains(&value), "{what} is {value}");
    let belief = agent.belief();
    let sum: f32 = (0..belief.tasks()).map(|task| belief.probability(task)).sum();
    assert!(belief.tasks() == 0 || belief.whole().is_zero() || (sum - 1.0).abs() < 1e-4, "the posterior sums to {sum}");
    for task in 0..belief.tasks() {
        probability("a task's posterior", belief.probability(task));
    }
    for strategy in 0..belief.strategies().len() {
        probability("a strategy's posterior", belief.strategy_probability(strategy));
    }
    if agent.language().is_training() {
        return;
    }
    // A quotient of two rounded sums may be slightly above 1.
    let parameter = |what: &str, value: f32| assert!((0.0..=1.0 + 4.0 * f32::EPSILON).contains(&value), "{what} is {value}");
    let (language, tables) = (agent.language(), agent.language().tables());
    for (token, _) in language.tokens().iter() {
        for (word, _) in language.words().iter() {
            parameter("a translation", tables.translation(word, Some(token)));
        }
    }
    for lengths in tables.length_pairs() {
        for i in 0..usize::from(lengths.english) {
            for j in 0..=usize::from(lengths.machine) {
                parameter("an alignment", tables.alignment(j, i, usize::from(lengths.machine), usize::from(lengths.english)));
            }
        }
    }
}
