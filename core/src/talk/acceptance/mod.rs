//! Whether to act on a reading: one calibrated probability, from a model that was trained on what people say.
//!
//! "Turn left after lunch" and "turn left after the table" differ in no rule that is short; what people mean by such words is learned from
//! sentences instead. A log-linear model (Berger, Della Pietra and Della Pietra 1996, *A maximum entropy approach to natural language
//! processing*) weighs each [reading](super::Reading) of an utterance: P = 1 / (1 + exp(-(b + sum of w f))), with the features f of
//! [`Clues`]. They are classes of words, their places and their order, never words themselves, so one model serves all worlds and languages.
//! The robot takes the most probable reading, and acts on it if P is above [`ACTS_FROM`].
//!
//! - `clues`: the features; `order`: those of the order of words; `weights`: the trained weights, which `goodbot acts` writes.

mod clues;
mod order;
mod weights;

pub use clues::{CLUES, Clues, clue_name};
pub(super) use clues::{Sorts, asks, clear_from};
use weights::{BIAS, KEYS, SCALE, STARTS, WEIGHTS};

/// The weights are found by blocks of this many clues, so that a clue takes one byte.
pub const CLUES_OF_BLOCK: usize = 256;
const _: () = assert!(STARTS.len() == CLUES.div_ceil(CLUES_OF_BLOCK) + 1);

/// The robot acts on a reading that is more probable than this, as if a wrong act cost as much as four and a half questions: then acting
/// costs less than asking. It is the least number, in hundredths, at which at most 1.5 % of the sentences of authors who were left out of
/// the training led to a wrong act, after 120 lessons.
pub const ACTS_FROM: f32 = 0.78;

/// The probability that a reading with these clues is what was meant: a number from 0 to 1.
pub(super) fn probability(clues: &Clues<'_>) -> f32 {
    let to_kind = clues.to_kind();
    let mut sum = BIAS;
    clues.for_each(&mut |clue, value| {
        for clue in [clue, clue.saturating_add(to_kind)] {
            sum += f32::from(weight(usize::from(clue))) * SCALE * value;
        }
    });
    1.0 / (1.0 + libm::expf(-sum))
}

/// The weight of a clue, in units of [`SCALE`]; 0 if it has none.
fn weight(clue: usize) -> i8 {
    let Some(&[begin, end]) = STARTS.get(clue / CLUES_OF_BLOCK..).and_then(|starts| starts.first_chunk()) else { return 0 };
    let of_block = |all: core::ops::Range<usize>| KEYS.get(all).unwrap_or(&[]);
    let found = of_block(usize::from(begin)..usize::from(end)).binary_search(&((clue % CLUES_OF_BLOCK) as u8));
    found.ok().and_then(|at| WEIGHTS.get(at.saturating_add(usize::from(begin)))).copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_weight_is_found_and_no_other() {
        let found = (0..=usize::from(u16::MAX)).filter(|&clue| weight(clue) != 0).count();
        assert_eq!(found, WEIGHTS.iter().filter(|&&weight| weight != 0).count());
        assert!(found > 1_000, "{found}");
    }
}
