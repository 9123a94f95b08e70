//! The emulated board: a counter of instructions, text output, and the exit.

use core::ffi::CStr;
use semihosting::sys::arm_compat::{ExitReason, sys_exit_extended, sys_write0};

#[cfg_attr(target_arch = "arm", path = "board/cortex_m.rs")]
#[cfg_attr(target_arch = "riscv32", path = "board/riscv.rs")]
mod processor;
pub use processor::*;

/// The longest period, in instructions.
pub const MOST_PERIOD: u32 = 10_000_000;

/// Prints a text.
pub fn print(text: &str) {
    let mut bytes = text.bytes();
    loop {
        // In pieces that end with the 0 that the emulator wants.
        let mut piece = [0_u8; 33];
        let mut any = false;
        for (slot, byte) in piece.iter_mut().take(32).zip(&mut bytes) {
            (*slot, any) = (byte, true);
        }
        let Some(piece) = CStr::from_bytes_until_nul(&piece).ok().filter(|_| any) else { return };
        sys_write0(piece);
    }
}

/// Prints a number.
pub fn print_number(number: u32) {
    let mut digits = [0_u8; 10];
    let (mut rest, mut length) = (number, 0_usize);
    for slot in digits.iter_mut().rev() {
        *slot = b'0'.wrapping_add((rest % 10) as u8);
        rest /= 10;
        length = length.wrapping_add(1);
        if rest == 0 {
            break;
        }
    }
    let from = digits.len().wrapping_sub(length);
    if let Some(text) = digits.get(from..).and_then(|digits| core::str::from_utf8(digits).ok()) {
        print(text);
    }
}

/// Prints `name number` as a line of its own.
pub fn report(name: &str, number: u32) {
    print(name);
    print(" ");
    print_number(number);
    print("\n");
}

/// Ends the emulator with an exit code.
pub fn exit(code: u8) -> ! {
    loop {
        sys_exit_extended(ExitReason::ADP_Stopped_ApplicationExit, usize::from(code));
    }
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    exit(101)
}
