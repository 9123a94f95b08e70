//! A Cortex-M: SysTick counts.

use core::sync::atomic::{AtomicU32, Ordering};
use cortex_m_rt::exception;

pub use cortex_m_rt::entry;

/// SysTick's control, reload and current value registers.
const CONTROL: *mut u32 = 0xE000_E010 as *mut u32;
const RELOAD: *mut u32 = 0xE000_E014 as *mut u32;
const CURRENT: *mut u32 = 0xE000_E018 as *mut u32;

/// Instructions for each tick of the processor clock, times 2^16. The emulator is told that an instruction takes 64 ns.
const PER_TICK: u64 = if cfg!(feature = "microbit") {
    64_000 // 16 MHz: 62.5 / 64
} else if cfg!(feature = "mps2-an505") {
    51_200 // 20 MHz: 50 / 64
} else {
    40_960 // 25 MHz: 40 / 64
};

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

/// Starts the counter. `period` is in instructions, at most [`super::MOST_PERIOD`].
pub fn start_counter(period: u32) {
    let ticks = ((u64::from(period.min(super::MOST_PERIOD)) << 16) / PER_TICK) as u32;
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
