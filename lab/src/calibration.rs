//! Means with intervals, and calibration: are answers with 80 % certainty right in 8 of 10 cases? Counts answers by certainty, and draws them.

use crate::canvas::{GREEN, chart, draw as canvas};
use plotters::prelude::*;
use std::error::Error;

/// The number of ranges of equal width.
pub const RANGES: usize = 10;

/// The answers of one range of certainty.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Range {
    /// The number of answers.
    pub count: usize,
    /// How many of them were right.
    pub right: usize,
    /// The sum of the predictions' probabilities.
    certainty: f64,
}

impl Range {
    /// The mean probability of the predictions.
    pub fn certainty(&self) -> f64 {
        self.certainty / self.count.max(1) as f64
    }

    /// The share of right answers.
    pub fn accuracy(&self) -> f64 {
        self.right as f64 / self.count.max(1) as f64
    }
}

/// Counts answers in ranges. Each answer has the probability of its prediction, and whether it was right.
pub fn ranges(answers: impl Iterator<Item = (f64, bool)>) -> [Range; RANGES] {
    let mut ranges = [Range::default(); RANGES];
    for (probability, right) in answers {
        let at = ((probability * RANGES as f64) as usize).min(RANGES - 1);
        if let Some(range) = ranges.get_mut(at) {
            range.count += 1;
            range.right += usize::from(right);
            range.certainty += probability;
        }
    }
    ranges
}

/// The expected calibration error: the mean difference between certainty and accuracy over all answers.
pub fn error(ranges: &[Range]) -> f64 {
    let all: usize = ranges.iter().map(|range| range.count).sum();
    let apart = |range: &Range| range.count as f64 * (range.certainty() - range.accuracy()).abs();
    ranges.iter().map(apart).sum::<f64>() / all.max(1) as f64
}

/// A reliability diagram as SVG: the share of right answers, with its 95 % interval, against their certainty. Calibrated answers are on the
/// diagonal. The number above each point is the number of answers. `across` and `up` describe the axes.
///
/// # Errors
/// The plotting library's error.
pub fn draw(ranges: &[Range], caption: &str, across: &str, up: &str) -> Result<String, Box<dyn Error>> {
    canvas((560, 560), |area| {
        let mut chart = chart(area, caption, [(across, 100.0), (up, 108.0)])?;
        let gray = RGBColor(150, 150, 150);
        chart.draw_series(LineSeries::new([(0.0, 0.0), (100.0, 100.0)], gray.stroke_width(1)))?;
        for range in ranges.iter().filter(|range| range.count > 0) {
            let (x, y) = (100.0 * range.certainty(), 100.0 * range.accuracy());
            let (low, high) = wilson(range.right, range.count);
            chart.draw_series(LineSeries::new([(x, 100.0 * low), (x, 100.0 * high)], GREEN.stroke_width(1)))?;
            chart.draw_series(std::iter::once(Circle::new((x, y), 4, GREEN.filled())))?;
            let label = Text::new(range.count.to_string(), (x - 1.5, (100.0 * high + 4.0).min(107.0)), ("sans-serif", 12));
            chart.draw_series(std::iter::once(label))?;
        }
        Ok(())
    })
}

/// A mean over all runs.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mean {
    /// The mean.
    pub mean: f64,
    /// Half of its 95 % interval.
    pub half: f64,
}

impl Mean {
    /// The mean of these values.
    pub fn of(values: impl Iterator<Item = f64> + Clone) -> Self {
        let count = values.clone().count().max(1) as f64;
        let mean = values.clone().sum::<f64>() / count;
        let variance = values.map(|value| (value - mean) * (value - mean)).sum::<f64>() / (count - 1.0).max(1.0);
        Self { mean, half: 1.959_964 * (variance / count).sqrt() }
    }
}

/// Wilson's 95 % interval of a share.
pub fn wilson(right: usize, all: usize) -> (f64, f64) {
    if all == 0 {
        return (0.0, 1.0);
    }
    let (n, z) = (all as f64, 1.959_964);
    let p = right as f64 / n;
    let middle = p + z * z / (2.0 * n);
    let half = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
    let whole = 1.0 + z * z / n;
    // Rounding must not lead outside 0 to 1.
    (((middle - half) / whole).max(0.0), ((middle + half) / whole).min(1.0))
}

#[cfg(test)]
mod tests {
    use super::{wilson, *};

    #[test]
    fn who_is_80_percent_sure_and_right_in_8_of_10_is_calibrated() {
        let answers = (0..10).map(|number| (0.8, number < 8));
        assert!(error(&ranges(answers.clone())) < 1e-6);
        let overconfident = ranges(answers.map(|(_, right)| (1.0, right)));
        assert!((error(&overconfident) - 0.2).abs() < 1e-6);
        assert_eq!(overconfident[RANGES - 1].count, 10);
    }

    #[test]
    fn the_interval_of_a_share_is_of_shares() {
        for all in 0..2_000 {
            let ((least, _), (_, most)) = (wilson(0, all), wilson(all, all));
            assert!(least >= 0.0 && most <= 1.0, "of {all}: {least}, {most}");
        }
    }
}
