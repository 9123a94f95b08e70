//! Logistic regression with an L1 price on the weights, so that few remain, one weight after the other (Genkin, Lewis and Madigan
//! 2007, *Large-scale Bayesian logistic regression for text categorization*): the same data give the same weights.

/// How often each weight is fitted.
const ROUNDS: usize = 40;
/// A clue that fewer readings have gets no weight.
const LEAST: usize = 4;

/// A reading.
#[derive(Clone, Copy, Debug)]
pub struct Example<'e> {
    /// Its clues, each with its value.
    pub clues: &'e [(u16, f32)],
    /// Whether it is right.
    pub holds: bool,
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
    /// The probability of a reading with these clues.
    pub fn probability(&self, clues: &[(u16, f32)]) -> f64 {
        let sum: f64 =
            clues.iter().map(|&(clue, value)| self.weights.get(usize::from(clue)).copied().unwrap_or(0.0) * f64::from(value)).sum();
        1.0 / (1.0 + libm::exp(-(self.bias + sum)))
    }
}

/// Fits weights for `size` clues: the least sum of the examples' negative log likelihoods and `price` times the weights' absolute values.
pub fn fit(examples: &[Example<'_>], size: usize, price: f64) -> Fitted {
    // Each clue's examples, with its value there; the last is the bias, which has no price.
    let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::new(); size + 1];
    for (at, example) in examples.iter().enumerate() {
        for &(clue, value) in example.clues {
            columns[usize::from(clue)].push((at, f64::from(value)));
        }
        columns[size].push((at, 1.0));
    }
    let (mut weights, mut sums, mut most) = (vec![0.0; size + 1], vec![0.0; examples.len()], vec![1.0_f64; size + 1]);
    let mut chance = vec![0.5; examples.len()];
    for _ in 0..ROUNDS {
        for (clue, column) in columns.iter().enumerate().filter(|(_, column)| column.len() >= LEAST) {
            let (mut slope, mut curve) = (0.0, 1e-9);
            for &(at, value) in column {
                slope += (chance[at] - f64::from(u8::from(examples[at].holds))) * value;
                curve += chance[at] * (1.0 - chance[at]) * value * value;
            }
            let price = if clue == size { 0.0 } else { price };
            let weight: f64 = weights[clue];
            let aim = weight - slope / curve;
            let aim = aim.signum() * (aim.abs() - price / curve).max(0.0);
            // Within this distance the curve is trusted.
            let step = (aim - weight).clamp(-most[clue], most[clue]);
            most[clue] = (2.0 * step.abs()).max(most[clue] / 2.0);
            if step == 0.0 {
                continue;
            }
            weights[clue] += step;
            for &(at, value) in column {
                sums[at] += step * value;
                chance[at] = 1.0 / (1.0 + libm::exp(-sums[at]));
            }
        }
    }
    let bias = weights.pop().unwrap_or(0.0);
    Fitted { weights, bias }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clue_of_right_readings_gets_a_weight_and_one_without_meaning_gets_none() {
        let right: Vec<(u16, f32)> = vec![(0, 1.0), (2, 1.0)];
        let wrong: Vec<(u16, f32)> = vec![(1, 1.0), (2, 1.0)];
        let examples: Vec<Example<'_>> =
            (0..40).map(|at| Example { clues: if at % 2 == 0 { &right } else { &wrong }, holds: at % 2 == 0 }).collect();
        let fitted = fit(&examples, 3, 1.0);
        assert!(fitted.weights[0] > 0.5 || fitted.weights[1] < -0.5, "{fitted:?}");
        assert!(fitted.weights[2].abs() < 1e-6 && fitted.probability(&right) > 0.8 && fitted.probability(&wrong) < 0.2, "{fitted:?}");
    }
}
