//! Pictures as SVG: learned words for one run, shares of right answers for many.

use super::lexicon::Lexicon;
use super::options::PaperOptions;
use super::summary::Summary;
use goodbot_console::numbers::name_of;
use goodbot_course::{LESSONS, TESTS};
use goodbot_lab::canvas::{BLUE, GREEN, INK, PALE, draw, write};
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;
use std::error::Error;

/// A heat map: a row for each machine token, a column for each word, and darker cells for more probable words.
pub fn learned_words(lexicon: &Lexicon) -> Result<String, Box<dyn Error>> {
    let (left, top, wide, high) = (150, 90, 56, 26);
    let (columns, rows) = (lexicon.words.len() as i32, lexicon.rows.len() as i32);
    let size = ((left + columns * wide + 20) as u32, (top + rows * high + 20) as u32);
    draw(size, |canvas| {
        write(canvas, "What the agent learned: t(word | machine token)", (20, 28), 18, HPos::Left, INK)?;
        for (column, word) in (0..).zip(&lexicon.words) {
            write(canvas, word, (left + column * wide + wide / 2, top - 16), 13, HPos::Center, INK)?;
        }
        for (row, (token, probabilities)) in (0..).zip(&lexicon.rows) {
            let y = top + row * high;
            write(canvas, token, (left - 10, y + high / 2), 13, HPos::Right, INK)?;
            for (column, &probability) in (0..).zip(probabilities) {
                let x = left + column * wide;
                let box_style = shade(probability).filled();
                canvas.draw(&Rectangle::new([(x + 1, y + 1), (x + wide - 1, y + high - 1)], box_style))?;
                if probability >= 0.05 {
                    let ink = if probability > 0.35 { WHITE } else { INK };
                    write(canvas, &format!("{probability:.2}"), (x + wide / 2, y + high / 2), 12, HPos::Center, ink)?;
                }
            }
        }
        Ok(())
    })
}

/// From pale at 0 to the darkest colour at 0.6 and above.
fn shade(probability: f32) -> RGBColor {
    let depth = (probability / 0.6).clamp(0.0, 1.0);
    let mix = |pale: u8, dark: u8| (f32::from(pale) + (f32::from(dark) - f32::from(pale)) * depth).round() as u8;
    RGBColor(mix(PALE.0, 22), mix(PALE.1, 70), mix(PALE.2, 110))
}

/// A bar for each lesson and test: the share of agents that understood it.
pub fn shares(summary: &Summary, options: &PaperOptions) -> Result<String, Box<dyn Error>> {
    let (left, top, wide, high) = (330, 80, 400, 26);
    let share = |right: usize| right as f64 / summary.runs.max(1) as f64;
    let lessons = LESSONS.iter().zip(summary.train_right).map(|(exercise, right)| (exercise.command, share(right), BLUE));
    let tests = TESTS.iter().zip(summary.test_right).map(|(exercise, right)| (exercise.command, share(right), GREEN));
    let bars: Vec<_> = lessons.chain(tests).chain([("all five tests", share(summary.test_all_right), GREEN)]).collect();
    let size = ((left + wide + 80) as u32, (top + bars.len() as i32 * high + 60) as u32);
    draw(size, |canvas| {
        let title = format!("{} agents, trainer {}, {} homes", summary.runs, options.trainer.name, name_of(options.homes()));
        write(canvas, &title, (20, 28), 18, HPos::Left, INK)?;
        write(canvas, "blue: lessons understood before any feedback; green: tests right", (20, 54), 13, HPos::Left, INK)?;
        for (row, (command, share, color)) in (0..).zip(&bars) {
            // A gap between the lessons and the tests.
            let y = top + row * high + if row >= LESSONS.len() as i32 { 14 } else { 0 };
            let end = left + (share * f64::from(wide)).round() as i32;
            write(canvas, command, (left - 10, y + high / 2), 13, HPos::Right, INK)?;
            canvas.draw(&Rectangle::new([(left, y + 3), (left + wide, y + high - 3)], PALE.filled()))?;
            canvas.draw(&Rectangle::new([(left, y + 3), (end, y + high - 3)], color.filled()))?;
            write(canvas, &format!("{:.1} %", share * 100.0), (left + wide + 8, y + high / 2), 13, HPos::Left, INK)?;
        }
        Ok(())
    })
}
