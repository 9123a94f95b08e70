//! Picks a candidate by its score.

use goodbot::random::{below, unit};
use rand_core::Rng;

/// The candidate with the highest score. In a tie the earlier choice stays; otherwise one is drawn.
pub fn best<R: Rng + ?Sized>(scores: &[f32], before: Option<usize>, random: &mut R) -> usize {
    let most = scores.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let tied: Vec<usize> = (0..scores.len()).filter(|&at| scores[at] >= most).collect();
    match before.filter(|before| tied.contains(before)) {
        Some(before) => before,
        None => tied.get(below(tied.len(), random)).copied().unwrap_or(0),
    }
}

/// Probabilities proportional to the exponentials of these scores.
pub fn softmax(scores: &[f32]) -> Vec<f32> {
    let most = scores.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let parts: Vec<f32> = scores.iter().map(|score| libm::expf(score - most)).collect();
    let sum: f32 = parts.iter().sum();
    parts.into_iter().map(|part| part / sum).collect()
}

/// A random candidate, with these probabilities.
pub fn draw<R: Rng + ?Sized>(probabilities: &[f32], random: &mut R) -> usize {
    let mut left = unit(random);
    let found = probabilities.iter().position(|&probability| {
        left -= probability;
        left < 0.0
    });
    found.unwrap_or(probabilities.len().saturating_sub(1))
}
