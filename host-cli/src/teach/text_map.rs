//! A home drawn as text.
//!
//! `#` is wall, `+` a doorway, `@` the robot, a lower-case letter the floor of a room and its colour, a capital letter a block. Each room is
//! the box around cells that hang together without a doorway. Lines below the drawing say what letters cannot: `room teal 4 4 8 8` with the
//! room's box, `block blue chair 4 2` with the block's cell. The south-west corner of the drawing is cell 0 0.

use goodbot_formats::environment::{EnvironmentFile, ObjectRecord};

const COLORS: [(char, &str); 8] =
    [('r', "red"), ('g', "green"), ('b', "blue"), ('y', "yellow"), ('p', "purple"), ('o', "orange"), ('t', "teal"), ('m', "magenta")];
const SHAPES: [(char, &str); 6] = [('C', "chair"), ('B', "bag"), ('K', "backpack"), ('T', "basket"), ('S', "star"), ('A', "ball")];

/// The colour of a block about which nothing more is said.
const PLAIN_BLOCK: &str = "yellow";

struct Drawing<'a> {
    rows: Vec<&'a str>,
}

impl Drawing<'_> {
    fn at(&self, x: usize, y: usize) -> char {
        let row = self.rows.len().checked_sub(y + 1).and_then(|row| self.rows.get(row));
        row.and_then(|row| row.chars().nth(x)).unwrap_or(' ')
    }

    fn width(&self) -> usize {
        self.rows.iter().map(|row| row.chars().count()).max().unwrap_or(0)
    }

    /// The cells, from west to east and south to north.
    fn cells(&self) -> impl Iterator<Item = (usize, usize)> {
        let width = self.width();
        (0..self.rows.len()).flat_map(move |y| (0..width).map(move |x| (x, y)))
    }
}

const fn is_floor(letter: char) -> bool {
    !matches!(letter, '#' | '+' | ' ')
}

fn meaning(table: &[(char, &'static str)], letter: char) -> Option<&'static str> {
    table.iter().find(|(known, _)| *known == letter).map(|(_, word)| *word)
}

/// Whether a text is a drawing and not JSON.
pub fn is_drawing(text: &str) -> bool {
    !text.trim_start_matches('\u{feff}').trim_start().starts_with('{')
}

/// Reads a drawing.
///
/// # Errors
/// What is wrong, with its line, and what to do.
pub fn parse(text: &str) -> Result<EnvironmentFile, String> {
    let is_note = |row: &str| row.starts_with("room ") || row.starts_with("block ");
    let drawing = Drawing { rows: text.lines().map(str::trim_end).filter(|row| !row.is_empty() && !is_note(row)).collect() };
    for (row, line) in text.lines().zip(1..).filter(|(row, _)| !is_note(row)) {
        if let Some(letter) = row.trim_end().chars().find(|&letter| !is_known(letter)) {
            return Err(format!(
                "line {line}: {letter:?} means nothing in a drawing; write # + @, a lower-case colour letter ({}) or a capital ({})",
                letters(&COLORS),
                letters(&SHAPES)
            ));
        }
    }
    if !drawing.cells().any(|(x, y)| drawing.at(x, y) == '@') {
        return Err("there is no @, the robot; draw it in a room".to_owned());
    }
    let mut objects = rooms(&drawing)?;
    objects.extend(things(&drawing));
    for (row, line) in text.lines().zip(1..).filter(|(row, _)| is_note(row)) {
        note(row, &mut objects).map_err(|error| format!("line {line}: {error}"))?;
    }
    Ok(EnvironmentFile::new(objects))
}

fn letters(table: &[(char, &str)]) -> String {
    table.iter().map(|(letter, word)| format!("{letter} {word}")).collect::<Vec<_>>().join(", ")
}

fn is_known(letter: char) -> bool {
    matches!(letter, '#' | '+' | ' ' | '@' | '.') || meaning(&COLORS, letter).is_some() || meaning(&SHAPES, letter).is_some()
}

/// The rooms: cells that hang together, and a wall around them.
fn rooms(drawing: &Drawing<'_>) -> Result<Vec<ObjectRecord>, String> {
    let (mut seen, mut rooms) = (std::collections::BTreeSet::new(), Vec::new());
    for start in drawing.cells() {
        if !is_floor(drawing.at(start.0, start.1)) || !seen.insert(start) {
            continue;
        }
        let (mut low, mut high, mut color) = (start, start, None);
        let mut open = vec![start];
        while let Some((x, y)) = open.pop() {
            (low, high) = ((low.0.min(x), low.1.min(y)), (high.0.max(x), high.1.max(y)));
            color = color.or(meaning(&COLORS, drawing.at(x, y)));
            let beside = [Some((x + 1, y)), x.checked_sub(1).map(|x| (x, y)), Some((x, y + 1)), y.checked_sub(1).map(|y| (x, y))];
            open.extend(beside.into_iter().flatten().filter(|&(x, y)| is_floor(drawing.at(x, y)) && seen.insert((x, y))));
        }
        let color = color.ok_or_else(|| format!("the room at {} {} has no colour; write a letter such as r on its floor", low.0, low.1))?;
        rooms.push(ObjectRecord::Room {
            name: format!("room{}", rooms.len()),
            left: number(low.0) - 1,
            bottom: number(low.1) - 1,
            right: number(high.0) + 1,
            top: number(high.1) + 1,
            color: color.to_owned(),
        });
    }
    Ok(rooms)
}

/// The doors, the blocks and the robot.
fn things(drawing: &Drawing<'_>) -> Vec<ObjectRecord> {
    let (mut doors, mut blocks, mut robot) = (Vec::new(), Vec::new(), Vec::new());
    for (column, row) in drawing.cells() {
        let (x, y) = (number(column), number(row));
        match drawing.at(column, row) {
            '+' => doors.push(ObjectRecord::Door { name: format!("door{}", doors.len()), left: x, bottom: y, right: x, top: y }),
            '@' => robot.push(ObjectRecord::Agent { name: format!("agent{}", robot.len()), x, y }),
            letter => {
                if let Some(shape) = meaning(&SHAPES, letter) {
                    let (color, shape) = (PLAIN_BLOCK.to_owned(), shape.to_owned());
                    blocks.push(ObjectRecord::Block { name: format!("block{}", blocks.len()), x, y, color, shape });
                }
            }
        }
    }
    doors.into_iter().chain(blocks).chain(robot).collect()
}

fn number(cell: usize) -> i32 {
    i32::try_from(cell).unwrap_or(i32::MAX)
}

/// What a line below the drawing says.
fn note(line: &str, objects: &mut [ObjectRecord]) -> Result<(), String> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let numbers = |words: &[&str]| words.iter().map(|word| word.parse::<i32>().ok()).collect::<Option<Vec<i32>>>();
    match words.as_slice() {
        ["room", said, corners @ ..] if corners.len() == 4 => {
            let wanted = numbers(corners).ok_or("the corners of a room are four whole numbers: left, bottom, right, top")?;
            let found = objects.iter_mut().find_map(|object| match object {
                ObjectRecord::Room { left, bottom, right, top, color, .. } if [*left, *bottom, *right, *top] == *wanted => Some(color),
                _ => None,
            });
            *found.ok_or("there is no room with these corners in the drawing; count from 0 0, the south-west corner")? = (*said).to_owned();
        }
        ["block", said, form, cell @ ..] if cell.len() == 2 => {
            let wanted = numbers(cell).ok_or("the cell of a block is two whole numbers: x, y")?;
            let found = objects.iter_mut().find_map(|object| match object {
                ObjectRecord::Block { x, y, color, shape, .. } if [*x, *y] == *wanted => Some((color, shape)),
                _ => None,
            });
            let (color, shape) = found.ok_or("there is no block at this cell in the drawing; count from 0 0, the south-west corner")?;
            (*color, *shape) = ((*said).to_owned(), (*form).to_owned());
        }
        _ => return Err("write `room COLOUR LEFT BOTTOM RIGHT TOP` or `block COLOUR SHAPE X Y`".to_owned()),
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOME: &str = "\
#########
#ggg#rrr#
#g@g+rCr#
#########
room teal 4 0 8 3
block blue chair 6 1
";

    #[test]
    fn a_drawing_is_a_home() {
        let home = parse(HOME).unwrap();
        let expected = concat!(
            r#"{"version":1,"objects":[{"class":"room","name":"room0","left":0,"bottom":0,"right":4,"top":3,"color":"green"},"#,
            r#"{"class":"room","name":"room1","left":4,"bottom":0,"right":8,"top":3,"color":"teal"},"#,
            r#"{"class":"door","name":"door0","left":4,"bottom":1,"right":4,"top":1},"#,
            r#"{"class":"block","name":"block0","x":6,"y":1,"color":"blue","shape":"chair"},"#,
            r#"{"class":"agent","name":"agent0","x":2,"y":1}]}"#
        );
        assert_eq!(home.to_json_line(), expected);
    }

    #[test]
    fn what_means_nothing_is_named_with_its_line() {
        assert!(parse("####\n#r?#\n#@r#\n####").unwrap_err().starts_with("line 2: '?' means nothing"));
        assert!(parse("###\n#r#\n###").unwrap_err().contains("there is no @"));
        assert!(parse("###\n#@#\n###").unwrap_err().contains("has no colour"));
        assert!(parse("####\n#@r#\n####\nblock blue chair 1 1").unwrap_err().starts_with("line 4: there is no block"));
    }
}
