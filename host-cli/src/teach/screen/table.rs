//! A world from a file: a line for each object, with what holds of it.

use super::super::palette::Palette;
use super::super::table::{Row, Table};
use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Paragraph, Wrap};

/// The columns that a table takes at least.
const LEAST_COLUMNS: u16 = 24;

/// An object as it is called: by its looks, or by its name where it has none.
fn called(row: &Row) -> &str {
    if row.looks.is_empty() { &row.name } else { &row.looks }
}

fn text(row: &Row) -> String {
    if row.holds.is_empty() { String::new() } else { format!("  {}", row.holds.join("; ")) }
}

/// The columns and rows that the table takes at its best.
pub fn wanted(table: &Table) -> (u16, u16) {
    let columns = table.rows.iter().map(|row| called(row).chars().count() + text(row).chars().count()).max().unwrap_or(0);
    let [columns, rows] = [columns, table.rows.len()].map(|count| u16::try_from(count).unwrap_or(u16::MAX));
    (columns.max(LEAST_COLUMNS), rows)
}

/// Draws the table. Objects of which nothing holds that can change come last, and are left out first.
pub fn draw(frame: &mut Frame<'_>, area: Rect, table: &Table, palette: Palette) {
    let line = |row: &Row| {
        let name = Span::styled(called(row).to_owned(), if row.holds.is_empty() { palette.quiet() } else { palette.strong() });
        Line::from(vec![name, Span::raw(text(row))])
    };
    let lines: Vec<Line<'_>> = table.rows.iter().map(line).collect();
    frame.render_widget(Paragraph::new(lines).wrap(Wrap { trim: true }), area);
}
