//! Trainers who judge every step rightly: none was recorded, but who plays with the robot carefully is one.
//!
//! Beside recorded ones they would be refuted by their silence, so they cost next to nothing; and without them a robot reads five right words
//! in a row as the noise of somebody who talks much.

use super::believing::{self, Expectation};
use crate::recorded::Walk;
use goodbot::feedback::{Strategy, population};

/// The shares of all trainers that exact ones may have: none of twelve was recorded, so not more than about one in ten.
const SHARES: [f32; 3] = [0.02, 0.05, 0.1];
/// What they may cost recorded trainers, in log loss.
const COST: f64 = 0.01;

/// The strategies with exact ones among them, which have this share of all together.
fn with_share(strategies: &[(Strategy, f32)], share: f32) -> Vec<(Strategy, f32)> {
    let thousandth = |share: f32| (share * 1_000.0).round() / 1_000.0;
    let fitted = strategies.iter().map(|&(strategy, part)| (strategy, thousandth(part * (1.0 - share))));
    fitted.chain(population::exact().map(|(strategy, part)| (strategy, thousandth(part * share)))).collect()
}

/// The strategies with exact ones among them: the largest of their shares that costs the trainers of these sessions next to nothing.
pub fn added(expected: &Expectation, walks: &[&Walk]) -> Vec<(Strategy, f32)> {
    let loss = |strategies: Vec<(Strategy, f32)>| {
        believing::replay(walks.iter().copied(), &Expectation { strategies, ..expected.clone() }).log_loss()
    };
    let without = loss(expected.strategies.clone());
    let share = SHARES.into_iter().rev().find(|&share| loss(with_share(&expected.strategies, share)) <= without + COST);
    share.map_or_else(|| expected.strategies.clone(), |share| with_share(&expected.strategies, share))
}
