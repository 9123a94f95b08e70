//! Whether to act on a reading: one calibrated probability, from a model that was trained on what people say.
//!
//! "Turn left after lunch" and "turn left after the table" differ in no rule that is short; what people mean by such words is learned from
//! sentences instead. A log-linear model (Berger, Della Pietra and Della Pietra 1996, *A maximum entropy approach to natural language
//! processing*) weighs each [reading](super::Reading) of an utterance: P = 1 / (1 + exp(-(b + sum of w f))), with the features f of
//! [`Clues`]. They are classes of words and their places, never words themselves, so one model serves all worlds and languages. The robot
//! takes the most probable reading, and acts on it if P is above [`ACTS_FROM`].
//!
//! - `clues`: the features; `weights`: the trained weights, which `goodbot acts` writes.

mod clues;
mod weights;

pub use clues::{CLUES, Clues, clue_name};
pub(super) use clues::{Sorts, asks, clear_from};
pub use weights::{BIAS, SCALE, WEIGHTS};

/// The cost of a wrong act, if that of a question is 1.
const COST: f32 = 5.0;

/// The robot acts on a reading that is more probable than this: then acting costs less than asking, (1 - P) `COST` < 1.
pub const ACTS_FROM: f32 = 1.0 - 1.0 / COST;

/// The probability that a reading with these clues is what was meant: a number from 0 to 1.
pub(super) fn probability(clues: &Clues) -> f32 {
    let mut sum = BIAS;
    clues.for_each(&mut |clue, value| {
        if let Ok(at) = WEIGHTS.binary_search_by_key(&clue, |&(clue, _)| clue) {
            sum += WEIGHTS.get(at).map_or(0.0, |&(_, weight)| f32::from(weight)) * SCALE * value;
        }
    });
    1.0 / (1.0 + libm::expf(-sum))
}
