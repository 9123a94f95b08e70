//! Logistic regression that keeps the clues that tell most. It is fitted twice, with all clues and then with the kept ones, the readings one
//! after another with a rate for each weight (Duchi, Hazan and Singer 2011, *Adaptive subgradient methods for online learning*). The same
//! data give the same weights.

/// How often each reading is seen.
const ROUNDS: usize = 8;
/// The rate of learning, and what slows the first steps.
const RATE: f64 = 0.05;
const SLOWLY: f64 = 1.0;

/// A reading.
#[derive(Clone, Copy, Debug)]
pub struct Example<'e> {
    /// Its clues.
    pub clues: &'e [u16],
    /// Their values.
    pub values: &'e [f32],
    /// The distance from each clue to that for its kind of reading alone.
    pub to_kind: u16,
    /// Whether it is right.
    pub holds: bool,
}

impl Example<'_> {
    /// The clues for all kinds of readings and for its own, with their values.
    fn each(&self) -> impl Iterator<Item = (usize, f64)> {
        let both =
            |(&clue, &value): (&u16, &f32)| [clue, clue.saturating_add(self.to_kind)].map(|clue| (usize::from(clue), f64::from(value)));
        self.clues.iter().zip(self.values).flat_map(both)
    }
}

/// How a model is fitted.
#[derive(Clone, Copy, Debug)]
pub struct Prices {
    /// The price of the square of a weight.
    pub square: f64,
    /// How many weights there may be.
    pub most: usize,
}

/// A trained model.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// The weight of each clue.
    pub weights: Vec<f64>,
    /// The weight of every reading.
    pub bias: f64,
}

impl Fitted {
    /// The probability of a reading.
    pub fn probability(&self, example: &Example<'_>) -> f64 {
        let sum: f64 = example.each().map(|(clue, value)| self.weights.get(clue).copied().unwrap_or(0.0) * value).sum();
        1.0 / (1.0 + libm::exp(-(self.bias + sum)))
    }
}

/// A weight while it is learned (McMahan et al. 2013, *Ad click prediction: a view from the trenches*, algorithm 1): what the readings ask
/// for, and the sum of the squares of their slopes.
#[derive(Clone, Copy, Default)]
struct Learned {
    asked: f64,
    squares: f64,
    weight: f64,
}

impl Learned {
    fn learn(&mut self, slope: f64, price: f64) {
        let (before, squares) = (self.squares.sqrt(), self.squares + slope * slope);
        self.asked += slope - (squares.sqrt() - before) / RATE * self.weight;
        self.squares = squares;
        self.weight = -self.asked / ((SLOWLY + squares.sqrt()) / RATE + price);
    }
}

/// Fits weights for `size` clues: about the least sum of the examples' negative log likelihoods and the prices of the weights.
pub fn fit(examples: &[Example<'_>], size: usize, prices: Prices) -> Fitted {
    let mut heights = vec![0.0; size];
    for (clue, value) in examples.iter().flat_map(Example::each) {
        if let Some(height) = heights.get_mut(clue) {
            *height += value * value;
        }
    }
    let all = fit_some(examples, &vec![true; size], prices.square);
    // What a weight tells in all: how far it moves the readings that have its clue.
    let tells = |clue: usize| all.weights[clue].abs() * f64::sqrt(heights[clue]);
    let mut clues: Vec<usize> = (0..size).filter(|&clue| tells(clue) > 0.0).collect();
    clues.sort_by(|&one, &other| tells(other).total_cmp(&tells(one)).then(one.cmp(&other)));
    let mut kept = vec![false; size];
    clues.into_iter().take(prices.most).for_each(|clue| kept[clue] = true);
    fit_some(examples, &kept, prices.square)
}

/// Fits the weights of these clues.
fn fit_some(examples: &[Example<'_>], kept: &[bool], price: f64) -> Fitted {
    let price = price * ROUNDS as f64;
    let (mut learned, mut bias) = (vec![Learned::default(); kept.len()], Learned::default());
    let mut order: Vec<usize> = (0..examples.len()).collect();
    let mut random = 1_u64;
    for _ in 0..ROUNDS {
        for at in (1..order.len()).rev() {
            // Knuth's generator: any order will do, but always the same.
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            order.swap(at, (random >> 33) as usize % (at + 1));
        }
        for example in order.iter().map(|&at| &examples[at]) {
            let sum: f64 = example.each().map(|(clue, value)| learned[clue].weight * value).sum();
            let slope = 1.0 / (1.0 + libm::exp(-(bias.weight + sum))) - f64::from(u8::from(example.holds));
            bias.learn(slope, 0.0);
            example.each().filter(|&(clue, _)| kept[clue]).for_each(|(clue, value)| learned[clue].learn(slope * value, price));
        }
    }
    Fitted { weights: learned.into_iter().map(|learned| learned.weight).collect(), bias: bias.weight }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clue_of_right_readings_gets_a_weight_and_one_without_meaning_gets_none() {
        let example = |at: usize| {
            let clues: &[u16] = if at.is_multiple_of(2) { &[0, 2] } else { &[1, 2] };
            Example { clues, values: &[1.0, 1.0], to_kind: 3, holds: at.is_multiple_of(2) }
        };
        let examples: Vec<Example<'_>> = (0..80).map(example).collect();
        let fitted = fit(&examples, 6, Prices { square: 0.01, most: 4 });
        let right_and_wrong = [fitted.probability(&example(0)), fitted.probability(&example(1))];
        assert!(fitted.weights[0] > 0.5 && fitted.weights[1] < -0.5 && fitted.weights[2] == 0.0, "{fitted:?}");
        assert!(right_and_wrong[0] > 0.8 && right_and_wrong[1] < 0.2, "{fitted:?}");
    }
}
