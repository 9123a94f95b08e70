//! The parts that both programs for the micro:bit have: the pages of the flash for the learned model, and reports on the serial line.

use crate::serial::print;
use embedded_storage::nor_flash::{NorFlashError, NorFlashErrorKind};

/// The end of the flash. V2 has more, which stays free.
pub const FLASH: u32 = 256 * 1_024;
/// The start of the two slots: the linker keeps the program out of them.
pub const START: u32 = 0x3_E000;
pub const SLOT: u32 = 4_096;
const _: () = assert!(START + 2 * SLOT == FLASH);

/// The flash refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refused;

impl NorFlashError for Refused {
    fn kind(&self) -> NorFlashErrorKind {
        NorFlashErrorKind::OutOfBounds
    }
}

/// Checks that a range lies where models are stored.
pub fn check(from: u32, bytes: usize) -> Result<(), Refused> {
    let end = u64::from(from) + bytes as u64;
    if from >= START && end <= u64::from(FLASH) { Ok(()) } else { Err(Refused) }
}

/// Reads from the slots.
pub fn read(offset: u32, bytes: &mut [u8]) -> Result<(), Refused> {
    check(offset, bytes.len())?;
    for (byte, at) in bytes.iter_mut().zip(offset..) {
        // SAFETY: this is within the flash, which is always readable, and no part of the program.
        *byte = unsafe { (at as *const u8).read_volatile() };
    }
    Ok(())
}

/// The words to write, each with its address.
pub fn words(offset: u32, bytes: &[u8]) -> Result<impl Iterator<Item = (*mut u32, u32)>, Refused> {
    check(offset, bytes.len())?;
    let (words, rest) = bytes.as_chunks::<4>();
    if !offset.is_multiple_of(4) || !rest.is_empty() {
        return Err(Refused);
    }
    Ok((offset..).step_by(4).map(|at| at as *mut u32).zip(words.iter().map(|word| u32::from_le_bytes(*word))))
}

/// A model in the flash, as memory.
pub fn model(at: u32, length: usize) -> Option<&'static [u8]> {
    check(at, length).ok()?;
    // SAFETY: this is within the flash, which is always readable, and nobody writes there while the robot restores.
    Some(unsafe { core::slice::from_raw_parts(at as *const u8, length) })
}

/// Sends a number.
pub fn print_number(number: i32) {
    let mut digits = [b'0'; 10];
    let (mut rest, mut length) = (number.unsigned_abs(), 0_usize);
    for digit in digits.iter_mut().rev() {
        *digit = b'0' + (rest % 10) as u8;
        rest /= 10;
        length += 1;
        if rest == 0 {
            break;
        }
    }
    print(if number < 0 { "-" } else { "" });
    if let Some(text) = digits.get(digits.len().saturating_sub(length)..).and_then(|digits| core::str::from_utf8(digits).ok()) {
        print(text);
    }
}

/// Sends several texts and ends the line.
pub fn say(parts: &[&str]) {
    parts.iter().for_each(|part| print(part));
    print("\r\n");
}
