//! A world from a file: its objects, and below each what holds of it.

use super::super::palette::Palette;
use super::super::table::{Row, Table};
use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::text::Line;
use ratatui::widgets::Paragraph;

/// The columns that a table takes at least.
const LEAST_COLUMNS: u16 = 24;

/// An object as it is called: by its looks, or by its name where it has none.
fn called(row: &Row) -> &str {
    if row.looks.is_empty() { &row.name } else { &row.looks }
}

/// How what holds of an object stands below it.
const INDENT: &str = "  ";

/// The columns and rows that the table takes at its best.
pub fn wanted(table: &Table) -> (u16, u16) {
    let told = |row: &Row| row.holds.iter().map(|fact| INDENT.len() + fact.chars().count()).chain([called(row).chars().count()]).max();
    let columns = table.rows.iter().filter_map(told).max().unwrap_or(0);
    let rows: usize = table.rows.iter().map(|row| 1 + row.holds.len()).sum();
    let [columns, rows] = [columns, rows].map(|count| u16::try_from(count).unwrap_or(u16::MAX));
    (columns.max(LEAST_COLUMNS), rows)
}

/// Draws the table. Objects of which nothing holds that can change come last, and are left out first.
pub fn draw(frame: &mut Frame<'_>, area: Rect, table: &Table, palette: Palette) {
    let lines = |row: &Row| {
        let style = if row.holds.is_empty() { palette.quiet() } else { palette.strong() };
        let facts = row.holds.iter().map(|fact| Line::raw(format!("{INDENT}{fact}")));
        std::iter::once(Line::styled(called(row).to_owned(), style)).chain(facts).collect::<Vec<_>>()
    };
    frame.render_widget(Paragraph::new(table.rows.iter().flat_map(lines).collect::<Vec<_>>()), area);
}
