//! The 25 lights: three rows of nine on the board's pins, shown one row after the other, each light for a part of its row's time.

use core::sync::atomic::{AtomicU8, Ordering::Relaxed};
use nrf51_pac::Peripherals;

/// How bright each light is, from 0 to [`FULL`]; the top row first, each from the left.
pub type Picture = [[u8; 5]; 5];

/// The brightest light: on for all of its row's time.
pub const FULL: u8 = 16;
/// All lights off.
pub const DARK: Picture = [[0; 5]; 5];

/// The pins of the nine columns, which light where they are low, and of the three rows, which light where they are high.
const FIRST_COLUMN: u32 = 4;
const FIRST_ROW: u32 = 13;
const COLUMNS: u32 = 0x1ff << FIRST_COLUMN;
const ROWS: u32 = 0b111 << FIRST_ROW;

/// Which light each column of each row is, by its position in the picture; the board has none at the last two of the second row.
const WIRED: [[Option<u8>; 9]; 3] = wired();

const fn wired() -> [[Option<u8>; 9]; 3] {
    /// The row and the column of each light.
    const LIGHTS: [[(usize, usize); 5]; 5] = [
        [(0, 0), (1, 3), (0, 1), (1, 4), (0, 2)],
        [(2, 3), (2, 4), (2, 5), (2, 6), (2, 7)],
        [(1, 1), (0, 8), (1, 2), (2, 8), (1, 0)],
        [(0, 7), (0, 6), (0, 5), (0, 4), (0, 3)],
        [(2, 2), (1, 6), (2, 0), (1, 5), (2, 1)],
    ];
    let mut wired = [[None; 9]; 3];
    let mut light = 0;
    while light < 25 {
        let (row, column) = LIGHTS[light / 5][light % 5];
        wired[row][column] = Some(light as u8);
        light += 1;
    }
    wired
}

static SHOWN: [AtomicU8; 25] = [const { AtomicU8::new(0) }; 25];

/// Makes the pins outputs.
pub fn begin(board: &Peripherals) {
    // SAFETY: any bits may be written here.
    board.GPIO.dirset.write(|pins| unsafe { pins.bits(COLUMNS | ROWS) });
}

/// Shows a picture from now on.
pub fn show(picture: &Picture) {
    for (light, &level) in SHOWN.iter().zip(picture.iter().flatten()) {
        light.store(level, Relaxed);
    }
}

/// Shows the part of the picture for one moment; the clock calls it, moment after moment.
pub fn refresh(board: &Peripherals, moment: u32) {
    let (part, row) = ((moment % u32::from(FULL)) as u8, (moment / u32::from(FULL)) % 3);
    let mut pins = COLUMNS | 1 << (FIRST_ROW + row);
    for (column, light) in WIRED.iter().nth(row as usize).into_iter().flatten().enumerate() {
        if light.and_then(|light| SHOWN.get(usize::from(light))).is_some_and(|light| light.load(Relaxed) > part) {
            pins &= !(1 << (FIRST_COLUMN + column as u32));
        }
    }
    // SAFETY: any bits may be written here.
    board.GPIO.out.write(|out| unsafe { out.bits(pins) });
}
