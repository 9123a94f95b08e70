//! Pictures for the lights: the home, a running text, or a sign.

use crate::lights::{DARK, FULL, Picture};
use crate::memory::Home;
use goodbot::home::{Cell, HomeState, ROOM};
use microbit_text::font;
use tiny_led_matrix::Render;

/// How bright the rooms are, in the order in which they were described, and doors; walls are dark.
const ROOMS: [u8; 4] = [1, 4, 8, 2];
const DOOR: u8 = 2;
/// How long a block is bright, and then as dim as its room, in milliseconds.
const BLINK: u32 = 256;
/// How long each column of a running text is shown, in milliseconds.
const COLUMN: u32 = 90;
/// The columns of a letter, with the gap after it.
const LETTER: usize = 6;

/// The trainer said "good".
pub const GOOD: Picture = sign([0b00000, 0b01010, 0b00000, 0b10001, 0b01110]);
/// The trainer said "bad".
pub const BAD: Picture = sign([0b00000, 0b01010, 0b00000, 0b01110, 0b10001]);

const fn sign(rows: [u8; 5]) -> Picture {
    let mut picture = DARK;
    let mut light = 0;
    while light < 25 {
        picture[light / 5][light % 5] = FULL * (rows[light / 5] >> (4 - light % 5) & 1);
        light += 1;
    }
    picture
}

/// The home, or five times five cells of it around the robot: the robot bright, blocks blinking, the rooms more or less dim.
pub fn home(home: &Home, state: &HomeState, now: u32) -> Picture {
    let agent = home.agent_cell(state);
    // The first cell that is shown in one direction.
    let from = |of: &dyn Fn(Cell) -> i32| {
        let all = home.places().iter().map(|place| of(place.cell()));
        let (least, most) = all.fold((i32::MAX, i32::MIN), |(least, most), at| (least.min(at), most.max(at)));
        if most.saturating_sub(least) < 5 { least } else { of(agent).saturating_sub(2).min(most.saturating_sub(4)).max(least) }
    };
    let (left, bottom) = (from(&|cell| cell.x), from(&|cell| cell.y));
    let mut picture = DARK;
    let mut paint = |cell: Cell, level: u8| {
        let (row, column) = (bottom.saturating_add(4).saturating_sub(cell.y), cell.x.saturating_sub(left));
        let light = usize::try_from(row).ok().zip(usize::try_from(column).ok());
        if let Some(light) = light.and_then(|(row, column)| picture.get_mut(row)?.get_mut(column)) {
            *light = level;
        }
    };
    for place in home.places() {
        let room = home.objects().of_class(ROOM).position(|room| room.index() == usize::from(place.region));
        paint(place.cell(), room.map_or(DOOR, |room| ROOMS.get(room % ROOMS.len()).copied().unwrap_or(DOOR)));
    }
    if now / BLINK % 2 == 0 {
        home.blocks().iter().filter_map(|&block| home.block_cell(state, block)).for_each(|cell| paint(cell, FULL));
    }
    paint(agent, FULL);
    picture
}

/// A frame of a running text after some milliseconds; `None` after its end.
pub fn text(text: &str, since: u32) -> Option<Picture> {
    let first = (since / COLUMN) as usize;
    if first > text.len() * LETTER + 5 {
        return None;
    }
    let mut picture = DARK;
    for (y, row) in picture.iter_mut().enumerate() {
        for (x, light) in row.iter_mut().enumerate() {
            // It comes in from the right.
            let Some(column) = (first + x).checked_sub(5) else { continue };
            let letter = text.as_bytes().get(column / LETTER).filter(|_| column % LETTER < 5);
            if letter.is_some_and(|&letter| font::character(letter).brightness_at(column % LETTER, y) > 0) {
                *light = FULL;
            }
        }
    }
    Some(picture)
}

/// How long a text takes to run by.
pub fn duration(text: &str) -> u32 {
    (text.len() * LETTER + 6) as u32 * COLUMN
}

/// The robot is at work: a light that runs around the border.
pub fn work(now: u32) -> Picture {
    let mut picture = DARK;
    let at = now / 64 % 16;
    let (row, column) = match (at / 4, at as usize % 4) {
        (0, along) => (0, along),
        (1, along) => (along, 4),
        (2, along) => (4, 4 - along),
        (_, along) => (4 - along, 0),
    };
    if let Some(light) = picture.get_mut(row).and_then(|row| row.get_mut(column)) {
        *light = FULL;
    }
    picture
}
