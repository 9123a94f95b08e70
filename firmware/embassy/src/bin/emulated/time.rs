//! The time of embassy, by SysTick: a thousand ticks a second.

use core::cell::RefCell;
use core::sync::atomic::{AtomicU32, Ordering};
use core::task::Waker;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_rt::exception;
use critical_section::Mutex;
use embassy_time_driver::{Driver, TICK_HZ};
use embassy_time_queue_utils::Queue;

/// What the board's processor does in a second.
const CLOCK: u32 = 25_000_000;

struct SysTickDriver {
    ticks: AtomicU32,
    queue: Mutex<RefCell<Queue>>,
}

embassy_time_driver::time_driver_impl!(static DRIVER: SysTickDriver = SysTickDriver {
    ticks: AtomicU32::new(0),
    queue: Mutex::new(RefCell::new(Queue::new())),
});

impl Driver for SysTickDriver {
    fn now(&self) -> u64 {
        u64::from(self.ticks.load(Ordering::Relaxed))
    }

    fn schedule_wake(&self, at: u64, waker: &Waker) {
        // Each tick looks for what is due.
        critical_section::with(|section| {
            self.queue.borrow_ref_mut(section).schedule_wake(at, waker);
        });
    }
}

/// Starts the clock.
pub fn begin() {
    let Some(mut board) = cortex_m::Peripherals::take() else { return };
    board.SYST.set_clock_source(SystClkSource::Core);
    board.SYST.set_reload(CLOCK / TICK_HZ as u32 - 1);
    board.SYST.clear_current();
    board.SYST.enable_counter();
    board.SYST.enable_interrupt();
}

#[exception]
fn SysTick() {
    let now = DRIVER.ticks.load(Ordering::Relaxed).wrapping_add(1);
    DRIVER.ticks.store(now, Ordering::Relaxed);
    critical_section::with(|section| {
        DRIVER.queue.borrow_ref_mut(section).next_expiration(u64::from(now));
    });
}
