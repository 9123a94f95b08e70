//! The robot's place. A home is seen from above: two columns for each cell if they fit, otherwise one; one that is still too large is seen
//! through a window around the robot. Another world has its places as a plan, if they have coordinates, and its objects with their facts.

use crate::teach::palette::Palette;
use crate::teach::site::{Ground, Row, Scene, Spot, Table};
use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::Paragraph;

/// The least columns of the legend, or of a table.
const LEAST_COLUMNS: u16 = 24;

/// The columns and rows of the home with its legend.
pub fn wanted(scene: &Scene) -> (u16, u16) {
    let columns = scene.ground.iter().map(Vec::len).max().unwrap_or(0) * 2;
    let rows = scene.ground.len() + legend(scene, columns.max(usize::from(LEAST_COLUMNS))).len();
    (u16::try_from(columns).unwrap_or(u16::MAX).max(LEAST_COLUMNS), u16::try_from(rows).unwrap_or(u16::MAX))
}

/// A letter for each word: the first of its letters, or else of the alphabet, that no earlier word has.
fn letters<'a>(words: impl Iterator<Item = &'a str>) -> Vec<(&'a str, char)> {
    let mut letters: Vec<(&str, char)> = Vec::new();
    for word in words {
        if letters.iter().any(|(known, _)| *known == word) {
            continue;
        }
        let free = |letter: &char| letters.iter().all(|(_, taken)| taken != letter);
        let letter = word.chars().flat_map(char::to_lowercase).chain('a'..='z').find(free).unwrap_or('.');
        letters.push((word, letter));
    }
    letters
}

fn letter_of(letters: &[(&str, char)], word: &str) -> char {
    letters.iter().find(|(known, _)| *known == word).map_or('.', |(_, letter)| *letter)
}

/// Letters for the colours of rooms and blocks.
fn colors(scene: &Scene) -> Vec<(&str, char)> {
    letters(scene.room_colors().chain(scene.blocks().map(|(_, _, color, _)| color)))
}

fn shapes(scene: &Scene) -> Vec<(&str, char)> {
    letters(scene.blocks().map(|(_, _, _, shape)| shape))
}

/// A block's two letters: its shape and its colour.
fn block_letters(scene: &Scene, color: &str, shape: &str) -> [char; 2] {
    let shape = letter_of(&shapes(scene), shape);
    [shape.to_uppercase().next().unwrap_or(shape), letter_of(&colors(scene), color)]
}

/// The meaning of the letters, in lines of at most this many columns.
fn legend(scene: &Scene, columns: usize) -> Vec<String> {
    let colors = colors(scene);
    let mut rooms: Vec<&str> = Vec::new();
    scene.room_colors().for_each(|color| {
        if !rooms.contains(&color) {
            rooms.push(color)
        }
    });
    let mut entries: Vec<String> = rooms.iter().map(|color| format!("{} {color}", letter_of(&colors, color))).collect();
    for (_, _, color, shape) in scene.blocks() {
        entries.push(format!("{} {color} {shape}", block_letters(scene, color, shape).iter().collect::<String>()));
    }
    entries.push("@ robot".to_owned());
    let mut lines: Vec<String> = Vec::new();
    for entry in entries {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 2 + entry.chars().count() <= columns => {
                line.push_str("  ");
                line.push_str(&entry);
            }
            _ => lines.push(entry),
        }
    }
    lines
}

/// Draws the home. `moved` is the robot's last action.
pub fn draw(frame: &mut Frame<'_>, area: Rect, scene: &Scene, moved: &str, palette: Palette) {
    let (width, height) = (usize::from(area.width), usize::from(area.height));
    let (columns, rows) = (scene.ground.iter().map(Vec::len).max().unwrap_or(0), scene.ground.len());
    let cell = if columns * 2 <= width { 2 } else { 1 };
    let (robot_column, robot_row) = scene.robot();
    let legend = legend(scene, width);
    let shown_rows = rows.min(height);
    let shown_columns = columns.min(width / cell);
    let first_column = first(robot_column, shown_columns, columns);
    let first_row = first(robot_row, shown_rows, rows);
    let colors = colors(scene);
    let mut lines: Vec<Line<'_>> = Vec::new();
    for (row, cells) in scene.ground.iter().enumerate().skip(first_row).take(shown_rows) {
        let spans = cells.iter().enumerate().skip(first_column).take(shown_columns).map(|(column, ground)| {
            let (text, style) = if (column, row) == (robot_column, robot_row) {
                (['@', arrow(moved)], palette.robot())
            } else if let Some((_, _, color, shape)) = scene.blocks().find(|&(x, y, ..)| (x, y) == (column, row)) {
                (block_letters(scene, color, shape), palette.block(color))
            } else {
                match ground {
                    Ground::Nothing => ([' ', ' '], Style::new()),
                    Ground::Wall => (['█', '█'], palette.wall()),
                    Ground::Door => (['+', ' '], palette.quiet()),
                    Ground::Floor(color) => ([letter_of(&colors, color), ' '], palette.floor(color)),
                }
            };
            Span::styled(text.iter().take(cell).collect::<String>(), style)
        });
        let margin = (width.saturating_sub(shown_columns * cell)) / 2;
        lines.push(Line::from(std::iter::once(Span::raw(" ".repeat(margin))).chain(spans).collect::<Vec<_>>()));
    }
    let room = height.saturating_sub(lines.len());
    lines.extend(legend.into_iter().take(room).map(|line| Line::styled(line, palette.quiet())));
    frame.render_widget(Paragraph::new(lines), area);
}

/// The first row or column of a window of `shown`, with `at` in its middle.
fn first(at: usize, shown: usize, all: usize) -> usize {
    at.saturating_sub(shown / 2).min(all.saturating_sub(shown))
}

fn arrow(action: &str) -> char {
    match action {
        "north" => '↑',
        "south" => '↓',
        "east" => '→',
        "west" => '←',
        _ => ' ',
    }
}

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
pub fn wanted_by_table(table: &Table) -> (u16, u16) {
    let plan = plan(table);
    let told = |row: &Row| row.holds.iter().map(|fact| INDENT.len() + fact.chars().count()).chain([called(row).chars().count()]).max();
    let columns = table.rows.iter().filter_map(told).max().unwrap_or(0).max(plan.first().map_or(0, |row| row.len() * PLACE));
    let rows = table.rows.iter().map(|row| 1 + row.holds.len()).sum::<usize>() + plan.len() * PLACE_ROWS;
    let [columns, rows] = [columns, rows].map(|count| u16::try_from(count).unwrap_or(u16::MAX));
    (columns.max(LEAST_COLUMNS), rows)
}

/// Draws the plan and the table. Objects without facts that can change come last, and are left out first.
pub fn draw_table(frame: &mut Frame<'_>, area: Rect, table: &Table, palette: Palette) {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_that_begin_alike_have_letters_of_their_own() {
        assert_eq!(letters(["bag", "basket", "backpack", "bag"].into_iter()), [("bag", 'b'), ("basket", 'a'), ("backpack", 'c')]);
        assert_eq!(letters(["a", "a", "aa"].into_iter()), [("a", 'a'), ("aa", 'b')]);
    }

    #[test]
    fn a_window_goes_with_the_robot_and_stays_inside() {
        assert_eq!([first(0, 5, 20), first(10, 5, 20), first(19, 5, 20), first(3, 9, 9)], [0, 8, 15, 0]);
    }
}
