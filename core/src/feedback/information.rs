//! The expected information of a word, in bits, about whether an action was right.
//!
//! With c the probability that an action is right, the trainer's word F has the information g = H(F) - c H(F|right) - (1 - c) H(F|wrong).
//!
//! The logarithm is `libm`'s: it uses only `+ - * /` and operations on bits, and so gives the same bits on every target. A table would be
//! as large, and coarser.

use super::belief::BeliefRef;
use super::strategy::Feedback;

/// The entropy of a binary choice, in bits: 1 if both are equally probable, 0 if one is certain.
///
/// ```
/// use goodbot::feedback::binary_entropy;
/// assert_eq!((binary_entropy(0.0), binary_entropy(0.5), binary_entropy(1.0)), (0.0, 1.0, 0.0));
/// ```
pub fn binary_entropy(probability: f32) -> f32 {
    surprise(probability) + surprise(1.0 - probability)
}

/// The contribution of an outcome of this probability to an entropy, in bits: -p log2 p.
pub(crate) fn surprise(probability: f32) -> f32 {
    if probability > 0.0 && probability < 1.0 { -probability * libm::log2f(probability) } else { 0.0 }
}

/// The expected feedback to right and to wrong actions, over all strategies.
#[derive(Clone, Copy, Debug)]
pub struct Words {
    right: [f32; 3],
    wrong: [f32; 3],
    /// H(F|right) and H(F|wrong), in bits.
    left: [f32; 2],
}

impl Words {
    /// The feedback expected by this belief.
    pub fn expected(belief: BeliefRef<'_>) -> Self {
        let (mut right, mut wrong) = ([0.0; 3], [0.0; 3]);
        let whole = belief.whole();
        for (position, (strategy, _)) in belief.strategies().iter().enumerate() {
            let share = belief.strategy_among(position, whole);
            let words = [Feedback::Reward, Feedback::Punish, Feedback::Neutral];
            for ((right, wrong), word) in right.iter_mut().zip(&mut wrong).zip(words) {
                *right += share * strategy.probability(word, true);
                *wrong += share * strategy.probability(word, false);
            }
        }
        let entropy = |words: &[f32; 3]| words.iter().fold(0.0, |sum, &word| sum + surprise(word));
        Self { right, wrong, left: [entropy(&right), entropy(&wrong)] }
    }

    /// The expected information, in bits, of a word about an action that is right with probability `right`.
    pub fn information(&self, right: f32) -> f32 {
        let wrong = 1.0 - right;
        let said = self
            .right
            .iter()
            .zip(&self.wrong)
            .fold(0.0, |sum, (after_right, after_wrong)| sum + surprise(right * after_right + wrong * after_wrong));
        let [left_right, left_wrong] = self.left;
        (said - right * left_right - wrong * left_wrong).max(0.0)
    }
}
