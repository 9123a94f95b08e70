//! The tests that were right as a picture: a panel for each course and trainer, with a bar and its interval for each agent.

use super::plan::Plan;
use super::summary::{Column, Row};
use super::table;
use crate::canvas::{BLUE, Canvas, Drawn, GREEN, INK, PALE, draw, write};
use crate::mean::Mean;
use crate::study::agent::Learns;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;
use std::error::Error;

/// Panels beside each other.
const PANELS: usize = 2;
// In pixels: the names of agents, the bars, the numbers after them, and the height of a bar.
const LEFT: i32 = 130;
const WIDE: i32 = 240;
const RIGHT: i32 = 110;
const HIGH: i32 = 20;

/// Draws them.
pub fn of(plan: &Plan, rows: &[Row]) -> Result<String, Box<dyn Error>> {
    let agents = plan.agents.len();
    let groups: Vec<&[Row]> = rows.chunks(agents).collect();
    let most = rows.iter().map(|row| row.mean(Column::Tests)).map(|Mean { mean, half }| mean + half).fold(1e-9, f64::max);
    let (across, down) = (LEFT + WIDE + RIGHT, 46 + agents as i32 * HIGH);
    let size = ((across * PANELS as i32 + 20) as u32, (80 + down * groups.len().div_ceil(PANELS) as i32) as u32);
    draw(size, |canvas| {
        let title = format!("{}: {} seeds, means with 95 % intervals", Column::Tests.head(), plan.runs);
        write(canvas, &title, (20, 28), 18, HPos::Left, INK)?;
        write(canvas, "blue: goodbot as it is used; green: an inference and a language", (20, 54), 13, HPos::Left, INK)?;
        for (number, group) in groups.iter().enumerate() {
            let corner = ((number % PANELS) as i32 * across, 80 + (number / PANELS) as i32 * down);
            panel(canvas, plan, group, most, corner)?;
        }
        Ok(())
    })
}

fn panel(canvas: &Canvas<'_>, plan: &Plan, group: &[Row], most: f64, corner: (i32, i32)) -> Drawn {
    let Some(first) = group.first() else { return Ok(()) };
    let left = corner.0 + LEFT;
    write(canvas, &format!("{}: {}", first.course.name(), first.trainer), (left, corner.1 + 10), 14, HPos::Left, INK)?;
    let at = |value: f64| left + (value.max(0.0) / most * f64::from(WIDE)).round() as i32;
    for ((row, contestant), y) in group.iter().zip(&plan.agents).zip((corner.1 + 22..).step_by(HIGH as usize)) {
        let middle = y + HIGH / 2;
        write(canvas, row.agent, (left - 8, middle), 12, HPos::Right, INK)?;
        canvas.draw(&Rectangle::new([(left, y + 3), (left + WIDE, y + HIGH - 3)], PALE.filled()))?;
        let Mean { mean, half } = row.mean(Column::Tests);
        let color = if matches!(contestant.learns, Learns::Whole(_)) { BLUE } else { GREEN };
        canvas.draw(&Rectangle::new([(left, y + 3), (at(mean), y + HIGH - 3)], color.filled()))?;
        canvas.draw(&PathElement::new([(at(mean - half), middle), (at(mean + half), middle)], INK.stroke_width(2)))?;
        write(canvas, &table::mean(Mean { mean, half }), (left + WIDE + 6, middle), 12, HPos::Left, INK)?;
    }
    Ok(())
}
