//! The emulator's RISC-V board `virt`: its timer counts.

use core::sync::atomic::{AtomicU32, Ordering};

pub use riscv_rt::entry;

/// The timer, in steps of 100 ns, and when it wakes the processor.
const TIME: *mut u32 = 0x0200_BFF8 as *mut u32;
#[allow(dead_code, reason = "only the fixed tick sleeps")]
const ALARM: *mut u32 = 0x0200_4000 as *mut u32;

/// Instructions for each step of the timer, times 16. The emulator is told that an instruction takes 64 ns.
const PER_STEP: u64 = 25; // 100 / 64

/// Steps of the timer in a period.
static PERIOD: AtomicU32 = AtomicU32::new(1);

/// The start-up code paints the stack with this value, so that its deepest word shows.
pub const STACK_PAINT_VALUE: u32 = 0xCCCC_CCCC;

core::arch::global_asm!(
    ".section .text.pre_init, \"ax\", @progbits",
    ".global __pre_init",
    "__pre_init:",
    // Physical memory protection forbids the 64 KiB below the RAM, which begins with the stack: the emulator ignores accesses there.
    "li t0, {guard}",
    "csrw pmpaddr0, t0",
    "li t0, {locked}",
    "csrw pmpcfg0, t0",
    "la t0, _stack_end",
    "li t1, {paint}",
    "0: bgeu t0, sp, 1f",
    "sw t1, 0(t0)",
    "addi t0, t0, 4",
    "j 0b",
    "1: ret",
    paint = const STACK_PAINT_VALUE,
    // A naturally aligned power of two: its address, and its size in the low bits.
    guard = const (0x7FFF_0000 >> 2) | ((0x1_0000 >> 3) - 1),
    // Locked, by power of two, neither read nor written nor executed.
    locked = const 0x98,
);

/// Steps of the timer since the counter was started.
fn steps() -> u64 {
    loop {
        // SAFETY: the board has this timer, and reading it has no effect.
        let [high, low, again] = unsafe { [TIME.add(1).read_volatile(), TIME.read_volatile(), TIME.add(1).read_volatile()] };
        if high == again {
            return u64::from(high) << 32 | u64::from(low);
        }
    }
}

/// Starts the counter. `period` is in instructions, at most [`super::MOST_PERIOD`].
pub fn start_counter(period: u32) {
    PERIOD.store(((u64::from(period.min(super::MOST_PERIOD)) << 4) / PER_STEP) as u32, Ordering::Relaxed);
    // SAFETY: the timer can be set, and nothing else uses it.
    unsafe {
        TIME.write_volatile(0);
        TIME.add(1).write_volatile(0);
    }
}

/// Periods since the counter was started.
#[allow(dead_code, reason = "only the fixed tick asks for it")]
pub fn periods() -> u32 {
    steps().checked_div(u64::from(PERIOD.load(Ordering::Relaxed))).unwrap_or(0) as u32
}

/// Sleeps until the period that comes after `period` begins.
#[allow(dead_code, reason = "only the fixed tick sleeps")]
pub fn sleep_through(period: u32) {
    let alarm = u64::from(PERIOD.load(Ordering::Relaxed)).wrapping_mul(u64::from(period).wrapping_add(1));
    // SAFETY: nothing else uses the alarm. No interrupt is taken: the processor only wakes. The high half is out of reach in between.
    unsafe {
        ALARM.add(1).write_volatile(u32::MAX);
        ALARM.write_volatile(alarm as u32);
        ALARM.add(1).write_volatile((alarm >> 32) as u32);
        core::arch::asm!("csrs mie, {timer}", timer = in(reg) 1_u32 << 7, options(nomem, nostack));
    }
    while periods() == period {
        // SAFETY: waits for the alarm.
        unsafe { core::arch::asm!("wfi", options(nomem, nostack, preserves_flags)) };
    }
}

/// Instructions since the counter was started.
pub fn instructions() -> u64 {
    steps().wrapping_mul(PER_STEP) >> 4
}
