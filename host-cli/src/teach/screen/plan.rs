//! The home from above: two columns for each cell if they fit, otherwise one. A home that is still too large is seen through a window
//! around the robot.

use super::super::palette::Palette;
use super::super::scene::{Ground, Scene};
use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::Paragraph;

/// The least columns of the legend.
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
