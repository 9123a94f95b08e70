//! Whether to act on a reading: one calibrated probability, from a model that was trained on what people say.
//!
//! "Turn left after lunch" and "turn left after the table" differ in no rule that is short; what people mean by such words is learned from
//! sentences instead. A log-linear model (Berger, Della Pietra and Della Pietra 1996, *A maximum entropy approach to natural language
//! processing*) gives each [reading](super::Reading) r of an utterance its odds exp(s(r)), s(r) = b + sum of w f, with the features f of
//! [`Clues`] and of its [words](Spoken), and "nothing is to be done" the odds 1. P(tasks) is the sum of the odds of all readings with these
//! tasks, divided by the sum of all odds. The robot takes the most probable tasks, and acts on them if P is above [`ACTS_FROM`].
//!
//! - `clues`: the features that no word tells; `words`: those of words; `weights`: the file of trained weights.

mod clues;
mod weights;
mod words;

pub use clues::{CLUES, Clues, KINDS, KINDS_OF_WORDS, clue_name};
pub(super) use clues::{Sorts, asks, clear_from};
pub use weights::{SENSES, Trained, Weights, WeightsError};
pub(super) use words::{BETWEEN, FAR, OTHER, TURNING};
pub use words::{HASHED, Spoken};

/// The robot acts on a reading that is more probable than this, as if a wrong act cost as much as five questions: then acting
/// costs less than asking. `docs/talk.md` tells how often it is wrong with people whom it never heard.
pub const ACTS_FROM: f32 = 0.8;

/// The robot answers that all is done already if that is more probable than this: the answer moves nothing, so a wrong one costs as much
/// as three questions.
pub(super) const DONE_FROM: f32 = 0.67;

/// The largest log odds.
const MOST: f32 = 30.0;

/// The odds of a reading with these clues against nothing that is to be done: a finite number above 0.
pub(super) fn odds(clues: &Clues<'_>) -> f32 {
    let (to_kind, weights) = (clues.to_kind(), clues.spoken().weights());
    let says = |spoken: &Spoken<'_>| spoken.says(clues.kind_of_words());
    let mut sum = weights.bias() + says(clues.spoken()) + clues.between().map_or(0.0, says);
    clues.for_each(&mut |clue, value| {
        for clue in [clue, clue.saturating_add(to_kind)] {
            sum += weights.of_clue(clue) * value;
        }
    });
    libm::expf(sum.clamp(-MOST, MOST))
}
