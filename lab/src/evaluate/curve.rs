//! Accuracy against the number of training sessions.

use super::folds::{ask, shuffled};
use super::method::Trained;
use crate::canvas::{GREEN, chart, draw as canvas};
use goodbot::language::Settings;
use goodbot_console::{Failure, Lesson, Starter, bar, training};
use plotters::prelude::*;
use rayon::prelude::*;
use std::error::Error;

/// Accuracy after a number of sessions.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Sessions trained on.
    pub sessions: usize,
    /// The mean accuracy on all others.
    pub mean: f64,
    /// The standard deviation between orders.
    pub deviation: f64,
}

/// The curve, averaged over `runs` orders of the sessions.
///
/// # Errors
/// [`Failure::Input`] if a command does not fit.
pub fn points(lessons: &[Lesson], starter: &Starter, settings: Settings, runs: usize, seed: u64) -> Result<Vec<Point>, Failure> {
    let most = lessons.len() * 9 / 10;
    let doubling = std::iter::successors(Some(2_usize), |size| Some(size * 2)).take_while(|&size| size < most);
    let sizes: Vec<usize> = doubling.chain([most]).collect();
    let progress = bar(sizes.len() * runs, "learning curve");
    let mut points = Vec::new();
    for sessions in sizes {
        let shares: Vec<f64> = (0..runs)
            .into_par_iter()
            .map_init(
                || training::memory(&[lessons, starter.lessons()].concat(), &settings),
                |memory, run| {
                    let order = shuffled(lessons.len(), seed.wrapping_add(run as u64));
                    let (taught, asked) = order.split_at(sessions);
                    let taught = taught.iter().filter_map(|&taught| lessons.get(taught)).chain(starter.beside(sessions));
                    let mut trained = Trained::on(memory, taught, settings)?;
                    let (mut right, mut all) = (0_usize, 0_usize);
                    for lesson in asked.iter().filter_map(|&asked| lessons.get(asked)) {
                        if let Some(answer) = ask(&mut trained, lesson)? {
                            (right, all) = (right + usize::from(answer.right), all + 1);
                        }
                    }
                    progress.inc(1);
                    Ok(right as f64 / all.max(1) as f64)
                },
            )
            .collect::<Result<_, Failure>>()?;
        let mean = shares.iter().sum::<f64>() / runs as f64;
        let variance = shares.iter().map(|share| (share - mean) * (share - mean)).sum::<f64>() / (runs.max(2) - 1) as f64;
        points.push(Point { sessions, mean, deviation: variance.sqrt() });
    }
    progress.finish_and_clear();
    Ok(points)
}

/// The curve as SVG: the mean, and one standard deviation on either side.
///
/// # Errors
/// The plotting library's error.
pub fn draw(points: &[Point], runs: usize) -> Result<String, Box<dyn Error>> {
    canvas((720, 440), |area| {
        let most = points.last().map_or(1, |point| point.sessions) as f64;
        let caption = format!("Commands understood, mean of {runs} orders of the sessions");
        let mut chart = chart(area, &caption, [("training sessions", most), ("% right of all others", 100.0)])?;
        let edge =
            |sign: f64| move |point: &Point| (point.sessions as f64, (100.0 * (point.mean + sign * point.deviation)).clamp(0.0, 100.0));
        let band: Vec<(f64, f64)> = points.iter().map(edge(1.0)).chain(points.iter().rev().map(edge(-1.0))).collect();
        chart.draw_series(std::iter::once(Polygon::new(band, GREEN.mix(0.2).filled())))?;
        chart.draw_series(LineSeries::new(points.iter().map(edge(0.0)), GREEN.stroke_width(2)))?;
        chart.draw_series(points.iter().map(|point| Circle::new(edge(0.0)(point), 3, GREEN.filled())))?;
        Ok(())
    })
}
