//! The shares of commands that robots understood, against the number of lessons.

use super::{Robots, Test, WaysOptions};
use crate::canvas::{BLUE, GREEN, INK, chart, draw as canvas};
use plotters::prelude::*;
use std::error::Error;

/// One line for robots that never ask, and one for those that do. Vertical strokes are 95 % intervals over robots.
pub fn draw(robots: &[Robots; 2], options: &WaysOptions) -> Result<String, Box<dyn Error>> {
    canvas((720, 440), |area| {
        let caption = format!("Commands that say how, understood by {} robots after lessons", options.runs);
        let right = format!("% right of {} commands", options.tests);
        let mut chart = chart(area, &caption, [("lessons", options.lessons.max(1) as f64), (&right, 100.0)])?;
        for (robots, color, name) in [(&robots[0], BLUE, "never asks"), (&robots[1], GREEN, "asks")] {
            let at =
                |test: &Test, shift: f64| (test.lessons as f64, (100.0 * (test.share.mean + shift * test.share.half)).clamp(0.0, 100.0));
            let line = LineSeries::new(robots.tests.iter().map(|test| at(test, 0.0)), color.stroke_width(2));
            chart.draw_series(line)?.label(name).legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], color.stroke_width(2)));
            let intervals = robots.tests.iter().map(|test| PathElement::new([at(test, -1.0), at(test, 1.0)], color.stroke_width(1)));
            chart.draw_series(intervals)?;
            chart.draw_series(robots.tests.iter().map(|test| Circle::new(at(test, 0.0), 3, color.filled())))?;
        }
        chart.configure_series_labels().position(SeriesLabelPosition::UpperLeft).border_style(INK).background_style(WHITE).draw()?;
        Ok(())
    })
}
