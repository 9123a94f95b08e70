//! A world from a file: its places as a plan, if they have coordinates; and its objects, with the facts about each.

use super::super::palette::Palette;
use super::super::table::{Row, Spot, Table};
use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::text::Line;
use ratatui::widgets::Paragraph;

/// The least columns of a table.
const LEAST_COLUMNS: u16 = 24;

/// An object's looks; its name if it has none.
fn called(row: &Row) -> &str {
    if row.looks.is_empty() { &row.name } else { &row.looks }
}

/// The indent of an object's facts.
const INDENT: &str = "  ";

/// The columns of a place, with the gap to the next.
const PLACE: usize = 12;
/// The rows of a place: its name, and the things in it.
const PLACE_ROWS: usize = 2;
/// The most columns and rows of a plan. A larger one is not drawn.
const MOST_PLACES: i32 = 16;

/// The places row by row, the northernmost first; empty if they have no coordinates, or are too far apart.
fn plan(table: &Table) -> Vec<Vec<Option<&Spot>>> {
    let [xs, ys]: [Vec<i32>; 2] = [table.places.iter().map(|it| it.at.0).collect(), table.places.iter().map(|it| it.at.1).collect()];
    let bounds = |of: &[i32]| Some((*of.iter().min()?, *of.iter().max()?));
    let (Some((west, east)), Some((south, north))) = (bounds(&xs), bounds(&ys)) else { return vec![] };
    if east.saturating_sub(west) >= MOST_PLACES || north.saturating_sub(south) >= MOST_PLACES {
        return vec![];
    }
    let spot = |at: (i32, i32)| table.places.iter().find(|spot| spot.at == at);
    (south..=north).rev().map(|y| (west..=east).map(|x| spot((x, y))).collect()).collect()
}

/// A text of a place, cut to its columns.
fn cell(text: &str) -> String {
    let shown: String = text.chars().take(PLACE - 1).collect();
    format!("{shown:PLACE$}")
}

/// The columns and rows of the whole table.
pub fn wanted(table: &Table) -> (u16, u16) {
    let plan = plan(table);
    let told = |row: &Row| row.holds.iter().map(|fact| INDENT.len() + fact.chars().count()).chain([called(row).chars().count()]).max();
    let columns = table.rows.iter().filter_map(told).max().unwrap_or(0).max(plan.first().map_or(0, |row| row.len() * PLACE));
    let rows = table.rows.iter().map(|row| 1 + row.holds.len()).sum::<usize>() + plan.len() * PLACE_ROWS;
    let [columns, rows] = [columns, rows].map(|count| u16::try_from(count).unwrap_or(u16::MAX));
    (columns.max(LEAST_COLUMNS), rows)
}

/// Draws the plan and the table. Objects without facts that can change come last, and are left out first.
pub fn draw(frame: &mut Frame<'_>, area: Rect, table: &Table, palette: Palette) {
    let lines = |row: &Row| {
        let style = if row.holds.is_empty() { palette.quiet() } else { palette.strong() };
        let facts = row.holds.iter().map(|fact| Line::raw(format!("{INDENT}{fact}")));
        std::iter::once(Line::styled(called(row).to_owned(), style)).chain(facts).collect::<Vec<_>>()
    };
    let row = |places: &Vec<Option<&Spot>>| {
        let text = |tell: fn(&Spot) -> String| places.iter().map(|spot| cell(&spot.map_or_else(String::new, tell))).collect::<String>();
        let here = |spot: &Spot| if spot.here.is_empty() { String::new() } else { format!("@{}", spot.here.join(" ")) };
        [Line::styled(text(|spot| format!("[{}]", spot.looks)), palette.quiet()), Line::styled(text(here), palette.strong())]
    };
    let plan = plan(table);
    let all: Vec<Line<'_>> = plan.iter().flat_map(row).chain(table.rows.iter().flat_map(lines)).collect();
    frame.render_widget(Paragraph::new(all), area);
}
