//! Trainers who judge every step rightly. None was recorded, but a careful player is one.
//!
//! With recorded trainers, their silence refutes the exact ones, so these cost almost nothing. Without them, a robot takes five right words
//! in a row for the noise of a talkative trainer.

use super::believing::{self, Expectation};
use crate::recorded::Walk;
use goodbot::feedback::{Strategy, population};

/// The shares of exact trainers to try: none of twelve recorded trainers was exact, so at most about one in ten.
const SHARES: [f32; 3] = [0.02, 0.05, 0.1];
/// The most log loss that they may cost recorded trainers.
const COST: f64 = 0.01;

/// The strategies with exact ones added, which get this share.
fn with_share(strategies: &[(Strategy, f32)], share: f32) -> Vec<(Strategy, f32)> {
    let thousandth = |share: f32| (share * 1_000.0).round() / 1_000.0;
    let fitted = strategies.iter().map(|&(strategy, part)| (strategy, thousandth(part * (1.0 - share))));
    fitted.chain(population::exact().map(|(strategy, part)| (strategy, thousandth(part * share)))).collect()
}

/// The strategies with exact ones added, with the largest share that costs the trainers of these sessions almost nothing.
pub fn added(expected: &Expectation, walks: &[&Walk]) -> Vec<(Strategy, f32)> {
    let loss = |strategies: Vec<(Strategy, f32)>| {
        believing::replay(walks.iter().copied(), &Expectation { strategies, ..expected.clone() }).log_loss()
    };
    let without = loss(expected.strategies.clone());
    let share = SHARES.into_iter().rev().find(|&share| loss(with_share(&expected.strategies, share)) <= without + COST);
    share.map_or_else(|| expected.strategies.clone(), |share| with_share(&expected.strategies, share))
}
