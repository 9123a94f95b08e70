//! A home from a drawing, as the core's `home::Map` draws it. A legend explains its letters, or notes explain single things, as the trainer
//! page writes them.

use crate::environment::{EnvironmentFile, ObjectRecord};
use std::collections::{BTreeMap, BTreeSet};

/// The most characters in a line of a drawing, and the most lines.
const MOST: usize = 200;

/// The colours of room letters without a legend.
const COLORS: [(char, &str); 7] =
    [('r', "red"), ('g', "green"), ('b', "blue"), ('y', "yellow"), ('p', "purple"), ('o', "orange"), ('t', "tan")];

/// The fault of a drawing, and its line.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {message}")]
pub struct MapFault {
    /// The line, from 1.
    pub line: usize,
    /// The fault, and the remedy.
    pub message: String,
}

/// Whether a text looks like a drawing.
pub fn is_map(text: &str) -> bool {
    let mut lines = text.trim_start_matches('\u{feff}').lines().filter(|line| !line.trim().is_empty());
    lines.next().is_some_and(|first| first.contains('#') && first.chars().all(|c| "#+ ".contains(c)))
}

/// Notes below a drawing about single things: `room teal 0 0 5 6` for the room with this box, `block blue chair 4 2` for the block in this
/// cell. Each has its line.
#[derive(Debug, Default)]
struct Notes {
    rooms: BTreeMap<[i32; 4], (usize, String)>,
    blocks: BTreeMap<[i32; 2], (usize, String)>,
}

impl Notes {
    /// Reads a line. Returns `true` if it is a note.
    fn take(&mut self, number: usize, line: &str) -> bool {
        fn numbers<const N: usize>(texts: &[&str]) -> Option<[i32; N]> {
            let numbers: Option<Vec<i32>> = texts.iter().map(|text| text.parse().ok()).collect();
            numbers?.try_into().ok()
        }
        let parts: Vec<&str> = line.split_whitespace().collect();
        match parts.as_slice() {
            ["room", color, place @ ..] => numbers(place).map(|place| self.rooms.insert(place, (number, (*color).to_owned()))).is_some(),
            ["block", color, shape, place @ ..] => {
                numbers(place).map(|cell| self.blocks.insert(cell, (number, format!("{color} {shape}")))).is_some()
            }
            _ => false,
        }
    }

    /// The error of a note about a room or block that is not drawn.
    fn idle(&self, objects: &[ObjectRecord]) -> Option<MapFault> {
        let room = |place: &[i32; 4]| {
            objects
                .iter()
                .any(|it| matches!(*it, ObjectRecord::Room { left, bottom, right, top, .. } if [left, bottom, right, top] == *place))
        };
        let block = |cell: &[i32; 2]| objects.iter().any(|it| matches!(*it, ObjectRecord::Block { x, y, .. } if [x, y] == *cell));
        let rooms =
            self.rooms.iter().filter(|(place, _)| !room(place)).map(|(_, (line, _))| (*line, "no room has this box, its walls included"));
        let blocks = self.blocks.iter().filter(|(cell, _)| !block(cell)).map(|(_, (line, _))| (*line, "no block is in this cell"));
        let (line, what) = rooms.chain(blocks).next()?;
        Some(MapFault { line, message: format!("{what}; mend the numbers, or leave the line out") })
    }
}

/// The parts of a drawing.
struct Drawing {
    /// The letter of each cell: x to the east, y to the north.
    cells: BTreeMap<(i32, i32), char>,
    legend: BTreeMap<char, (usize, String)>,
    notes: Notes,
    rows: i32,
    first: usize,
}

impl Drawing {
    fn line(&self, (_, y): (i32, i32)) -> usize {
        self.first + usize::try_from(self.rows - 1 - y).unwrap_or(0)
    }

    fn wrong<T>(&self, cell: (i32, i32), message: String) -> Result<T, MapFault> {
        Err(MapFault { line: self.line(cell), message })
    }
}

/// The home in a drawing.
///
/// # Errors
/// The fault, and its line.
pub fn parse(text: &str) -> Result<EnvironmentFile, MapFault> {
    let drawing = taken_apart(text)?;
    let mut objects = rooms(&drawing)?;
    let (mut doors, mut blocks, mut agents) = (Vec::new(), Vec::new(), Vec::new());
    for (&(x, y), &character) in &drawing.cells {
        if character == '+' {
            doors.push(ObjectRecord::Door { name: format!("door{}", doors.len()), left: x, bottom: y, right: x, top: y });
        } else if character == '@' {
            agents.push(ObjectRecord::Agent { name: format!("agent{}", agents.len()), x, y });
        } else if character.is_uppercase() {
            let said = drawing.notes.blocks.get(&[x, y]).or_else(|| drawing.legend.get(&character));
            let meaning = said.map(|(_, meaning)| meaning.split_whitespace().collect::<Vec<_>>());
            let Some([color, shape]) = meaning.as_deref() else {
                let message = format!("block {character} has no colour and shape; add a line such as \"{character}: yellow chair\"");
                return drawing.wrong((x, y), message);
            };
            let (color, shape) = ((*color).to_owned(), (*shape).to_owned());
            blocks.push(ObjectRecord::Block { name: format!("block{}", blocks.len()), x, y, color, shape });
        }
    }
    objects.extend(doors.into_iter().chain(agents).chain(blocks));
    match drawing.notes.idle(&objects) {
        Some(idle) => Err(idle),
        None => Ok(EnvironmentFile::new(objects)),
    }
}

fn taken_apart(text: &str) -> Result<Drawing, MapFault> {
    let (mut rows, mut legend, mut notes, mut first) = (Vec::new(), BTreeMap::new(), Notes::default(), 0);
    for (line, number) in text.trim_start_matches('\u{feff}').lines().zip(1..).filter(|(line, _)| !line.trim().is_empty()) {
        let line = line.trim_end();
        let mut letters = line.chars();
        let named = letters.next().zip(letters.as_str().split_once(':')).filter(|(_, (blank, _))| blank.trim().is_empty());
        if let Some((letter, (_, meaning))) = named {
            if let Some((before, _)) = legend.insert(letter, (number, meaning.trim().to_owned())) {
                return Err(MapFault {
                    line: number,
                    message: format!("{letter} was given on line {before} already; choose another letter"),
                });
            }
            continue;
        }
        if notes.take(number, line) {
            continue;
        }
        if line.chars().count() > MOST || rows.len() == MOST {
            return Err(MapFault { line: number, message: format!("the drawing has more than {MOST} lines or columns; make it smaller") });
        }
        if rows.is_empty() {
            first = number;
        }
        rows.push(line);
    }
    let height = rows.len() as i32;
    let mut cells = BTreeMap::new();
    for (row, y) in rows.iter().zip((0..height).rev()) {
        for (character, x) in row.chars().zip(0..).filter(|(character, _)| !character.is_whitespace()) {
            if !(character.is_alphabetic() || "#+@.".contains(character)) {
                let message =
                    format!("{character:?} means nothing here; write # for a wall, + for a door, @ for the robot, letters for the rest");
                return Err(MapFault { line: first + usize::try_from(height - 1 - y).unwrap_or(0), message });
            }
            cells.insert((x, y), character);
        }
    }
    Ok(Drawing { cells, legend, notes, rows: height, first })
}

/// The rooms. Each is a full rectangle of one small letter; the robot and blocks may be in it.
fn rooms(drawing: &Drawing) -> Result<Vec<ObjectRecord>, MapFault> {
    let inside = |cell: &(i32, i32)| drawing.cells.get(cell).copied().filter(|&c| c == '@' || c.is_alphabetic());
    let mut seen: BTreeSet<(i32, i32)> = BTreeSet::new();
    let mut rooms = Vec::new();
    for &start in drawing.cells.keys() {
        let Some(letter) = inside(&start).filter(|c| c.is_lowercase()) else { continue };
        if seen.contains(&start) {
            continue;
        }
        let mut room = BTreeSet::from([start]);
        let mut open = vec![start];
        while let Some((x, y)) = open.pop() {
            for next in [(x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)] {
                let Some(found) = inside(&next) else { continue };
                if found.is_lowercase() && found != letter {
                    return drawing.wrong(next, format!("rooms {letter} and {found} touch; put a wall (#) between them"));
                }
                if room.insert(next) {
                    open.push(next);
                }
            }
        }
        let (xs, ys) = (|| room.iter().map(|cell| cell.0), || room.iter().map(|cell| cell.1));
        let [left, right] = [xs().min(), xs().max()].map(|x| x.unwrap_or(0));
        let [bottom, top] = [ys().min(), ys().max()].map(|y| y.unwrap_or(0));
        if i64::from(right - left + 1) * i64::from(top - bottom + 1) != room.len() as i64 {
            return drawing.wrong(start, format!("room {letter} is no rectangle; fill it with {letter}, and wall it round"));
        }
        let said = drawing.notes.rooms.get(&[left - 1, bottom - 1, right + 1, top + 1]).or_else(|| drawing.legend.get(&letter));
        let named = said.map(|(_, meaning)| meaning.clone());
        let Some(color) = named.or_else(|| COLORS.iter().find(|(known, _)| *known == letter).map(|(_, color)| (*color).to_owned())) else {
            return drawing.wrong(start, format!("room {letter} has no colour; add a line such as \"{letter}: teal\""));
        };
        let name = format!("room{}", rooms.len());
        rooms.push(ObjectRecord::Room { name, left: left - 1, bottom: bottom - 1, right: right + 1, top: top + 1, color });
        seen.extend(room);
    }
    Ok(rooms)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawing_is_the_home_that_it_shows() {
        let drawn = parse("#####\n#rrr#\n##+##\n#g@C#\n#####\nC: blue chair\ng: teal\n").unwrap();
        let text = drawn.to_json_line();
        for part in [
            r#""name":"room0","left":0,"bottom":0,"right":4,"top":2,"color":"teal""#,
            r#""name":"room1","left":0,"bottom":2,"right":4,"top":4,"color":"red""#,
            r#""left":2,"bottom":2,"right":2,"top":2"#,
            r#""name":"agent0","x":2,"y":1"#,
            r#""x":3,"y":1,"color":"blue","shape":"chair""#,
        ] {
            assert!(text.contains(part), "{part} in {text}");
        }
    }

    #[test]
    fn a_drawing_of_the_trainer_page_is_read_with_its_notes() {
        let drawing = "#####\n#rrr#\n##+##\n#r@C#\n#####\n";
        let legend = parse(&format!("{drawing}r: red\nC: blue chair\n")).unwrap().to_json_line();
        let notes = parse(&format!("{drawing}\nroom teal 0 0 4 2\nroom red 0 2 4 4\nblock blue chair 3 1\n")).unwrap().to_json_line();
        assert_eq!(notes, legend.replacen("\"color\":\"red\"", "\"color\":\"teal\"", 1));
    }

    #[test]
    fn what_cannot_be_read_from_a_drawing_is_told_with_its_line() {
        for (drawing, line, message) in [
            ("#####\n#rCr#\n#####", 2, "C: yellow chair"),
            ("####\n#rg#\n####", 2, "touch"),
            ("####\n#zz#\n####", 2, "room z has no colour"),
            ("#####\n#rr##\n#rrr#\n#####", 3, "no rectangle"),
            ("####\n#r!#\n####", 2, "means nothing"),
            ("####\n#r@#\n####\nr: red\n\nr: teal", 6, "on line 4 already"),
            ("####\n#r@#\n####\nroom red 0 0 3 3", 4, "no room has this box"),
            ("####\n#r@#\n####\nblock red bag 1 1", 4, "no block is in"),
        ] {
            let wrong = parse(drawing).unwrap_err();
            assert!(wrong.line == line && wrong.message.contains(message), "{wrong:?}");
        }
    }
}
