//! Calibration: are answers with 80 % certainty right in 8 of 10 cases? Counts answers by certainty, and draws them.

use crate::canvas::{GREEN, chart, draw as canvas};
use crate::mean::wilson;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_is_80_percent_sure_and_right_in_8_of_10_is_calibrated() {
        let answers = (0..10).map(|number| (0.8, number < 8));
        assert!(error(&ranges(answers.clone())) < 1e-6);
        let overconfident = ranges(answers.map(|(_, right)| (1.0, right)));
        assert!((error(&overconfident) - 0.2).abs() < 1e-6);
        assert_eq!(overconfident[RANGES - 1].count, 10);
    }
}
