//! The 25 lights, shown one row of pins after the other, each light for a part of its row's time.

use crate::wiring::{Pins, wiring};
use core::sync::atomic::{AtomicU8, Ordering::Relaxed};

/// How bright each light is, from 0 to [`FULL`]; the top row first, each from the left.
pub type Picture = [[u8; 5]; 5];

/// The brightest light: on for all of its row's time.
pub const FULL: u8 = 16;
/// All lights off.
pub const DARK: Picture = [[0; 5]; 5];

static SHOWN: [AtomicU8; 25] = [const { AtomicU8::new(0) }; 25];

/// Makes the pins outputs.
pub fn begin() {
    let mut pins = Pins::default();
    for &(row, columns) in wiring().rows {
        pins.add(row);
        columns.iter().for_each(|&(column, _)| pins.add(column));
    }
    pins.make_outputs();
}

/// Shows a picture from now on.
pub fn show(picture: &Picture) {
    for (light, &level) in SHOWN.iter().zip(picture.iter().flatten()) {
        light.store(level, Relaxed);
    }
}

/// Shows the part of the picture for one moment; the clock calls it, moment after moment.
pub fn refresh(moment: u32) {
    let rows = wiring().rows;
    let (part, turn) = ((moment % u32::from(FULL)) as u8, moment / u32::from(FULL));
    let Some(&(row, columns)) = turn.checked_rem(rows.len() as u32).and_then(|row| rows.get(row as usize)) else { return };
    let mut high = Pins::default();
    high.add(row);
    for &(column, light) in columns {
        if SHOWN.get(usize::from(light)).is_some_and(|level| level.load(Relaxed) <= part) {
            high.add(column);
        }
    }
    high.make_high();
}
