//! The functions of this board that the fault handler of all boards calls.

use crate::lights::{self, FULL};
use crate::serial;

/// Says a text on the serial line.
pub fn print(text: &str) {
    serial::print(text);
}

/// Ends for good: every light is on until somebody presses reset.
pub fn exit(_code: u8) -> ! {
    serial::say(&["error: the robot has stopped; press reset, it still knows what it stored"]);
    lights::show(&[[FULL; 5]; 5]);
    (0..=u32::MAX).cycle().for_each(lights::refresh);
    loop {}
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    exit(101)
}
