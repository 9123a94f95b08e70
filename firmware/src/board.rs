//! The emulated board: a counter of instructions, text out, and the way out.

use core::ffi::CStr;
use core::sync::atomic::{AtomicU32, Ordering};
use cortex_m_rt::exception;
use semihosting::sys::arm_compat::{ExitReason, sys_exit_extended, sys_write0};

/// SysTick's control, reload and current value registers.
const CONTROL: *mut u32 = 0xE000_E010 as *mut u32;
const RELOAD: *mut u32 = 0xE000_E014 as *mut u32;
const CURRENT: *mut u32 = 0xE000_E018 as *mut u32;

/// Instructions for each tick of the processor clock, times 2^16. The emulator is told that an instruction takes 64 ns.
#[cfg(not(feature = "microbit"))]
const PER_TICK: u64 = 40_960; // 25 MHz: 40 / 64
#[cfg(feature = "microbit")]
const PER_TICK: u64 = 64_000; // 16 MHz: 62.5 / 64

/// The longest period, in instructions.
pub const MOST_PERIOD: u32 = 10_000_000;

static PERIODS: AtomicU32 = AtomicU32::new(0);
/// Ticks of the processor clock in a period.
static PERIOD: AtomicU32 = AtomicU32::new(1);

#[exception]
fn SysTick() {
    PERIODS.store(PERIODS.load(Ordering::Relaxed).wrapping_add(1), Ordering::Relaxed);
}

/// Periods since the counter was started.
#[allow(dead_code, reason = "only the fixed tick asks for it")]
pub fn periods() -> u32 {
    PERIODS.load(Ordering::Relaxed)
}

/// Sleeps until the period that comes after `period` begins.
#[allow(dead_code, reason = "only the fixed tick sleeps")]
pub fn sleep_through(period: u32) {
    while periods() == period {
        // SAFETY: waits for an interrupt; the counter's comes once a period.
        unsafe { core::arch::asm!("wfi", options(nomem, nostack, preserves_flags)) };
    }
}

/// Starts the counter. `period` is in instructions, at most [`MOST_PERIOD`].
pub fn start_counter(period: u32) {
    let ticks = ((u64::from(period.min(MOST_PERIOD)) << 16) / PER_TICK) as u32;
    PERIOD.store(ticks, Ordering::Relaxed);
    // SAFETY: every Cortex-M that this runs on has these registers, and nothing else uses them.
    unsafe {
        RELOAD.write_volatile(ticks.wrapping_sub(1));
        CURRENT.write_volatile(0);
        CONTROL.write_volatile(0b111);
    }
}

/// Instructions since the counter was started.
pub fn instructions() -> u64 {
    let period = PERIOD.load(Ordering::Relaxed);
    loop {
        let before = periods();
        // SAFETY: as above; reading has no effect but on a flag that is not used.
        let left = unsafe { CURRENT.read_volatile() };
        if periods() == before {
            let ticks = u64::from(before).wrapping_mul(u64::from(period)).wrapping_add(u64::from(period.wrapping_sub(left)));
            return ticks.wrapping_mul(PER_TICK) >> 16;
        }
    }
}

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
