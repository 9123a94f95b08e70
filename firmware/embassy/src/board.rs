//! The functions of this board that the fault handler of all boards calls.

use crate::serial;

/// Says a text on the serial line.
pub fn print(text: &str) {
    serial::print(text);
}

/// Ends for good.
pub fn exit(_code: u8) -> ! {
    serial::say(&["error: the robot has stopped; press reset, it still knows what it stored"]);
    loop {
        cortex_m::asm::wfi();
    }
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    exit(101)
}
