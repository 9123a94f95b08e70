//! Embassy's clock, in microseconds, by the chip's first timer. The clock of `embassy-nrf` uses a timer that the emulator lacks.

use core::cell::{Cell, RefCell};
use core::task::Waker;
use critical_section::{CriticalSection, Mutex};
use embassy_nrf::interrupt;
use embassy_nrf::interrupt::InterruptExt;
use embassy_nrf::pac::TIMER0;
use embassy_nrf::pac::timer::vals;
use embassy_time_driver::Driver;
use embassy_time_queue_utils::Queue;

/// The timer's registers: the next alarm, the moment when it wraps to 0, and a capture of its count.
const ALARM: usize = 0;
const ANEW: usize = 1;
const LOOK: usize = 2;

struct Clock {
    queue: Mutex<RefCell<Queue>>,
    /// The time at the last look. The timer has 32 bits, so it wraps every 71 minutes, and its interrupt looks then.
    seen: Mutex<Cell<u64>>,
}

embassy_time_driver::time_driver_impl!(static CLOCK: Clock = Clock {
    queue: Mutex::new(RefCell::new(Queue::new())),
    seen: Mutex::new(Cell::new(0)),
});

/// Starts the clock.
pub fn begin() {
    TIMER0.bitmode().write(|mode| mode.set_bitmode(vals::Bitmode::_32bit));
    TIMER0.prescaler().write(|prescaler| prescaler.set_prescaler(4)); // 16 MHz / 2^4
    TIMER0.cc(ANEW).write_value(0);
    TIMER0.intenset().write(|interrupts| {
        interrupts.set_compare(ALARM, true);
        interrupts.set_compare(ANEW, true);
    });
    TIMER0.tasks_start().write_value(1);
    // SAFETY: the handler below uses shared values only in critical sections.
    unsafe { interrupt::TIMER0.enable() };
}

impl Clock {
    fn look(&self, section: CriticalSection<'_>) -> u64 {
        TIMER0.tasks_capture(LOOK).write_value(1);
        let seen = self.seen.borrow(section);
        let low = u64::from(TIMER0.cc(LOOK).read());
        let same_round = (seen.get() & !u64::from(u32::MAX)) | low;
        let now = if same_round < seen.get() { same_round + (1 << 32) } else { same_round };
        seen.set(now);
        now
    }

    /// Wakes the tasks that are due, and sets the alarm for the next.
    fn ring(&self, section: CriticalSection<'_>) {
        let mut queue = self.queue.borrow_ref_mut(section);
        loop {
            let next = queue.next_expiration(self.look(section));
            // An alarm that is further off is set when the timer wraps.
            TIMER0.cc(ALARM).write_value(next as u32);
            if next > self.look(section) {
                return;
            }
        }
    }
}

impl Driver for Clock {
    fn now(&self) -> u64 {
        critical_section::with(|section| self.look(section))
    }

    fn schedule_wake(&self, at: u64, waker: &Waker) {
        critical_section::with(|section| {
            let sooner = self.queue.borrow_ref_mut(section).schedule_wake(at, waker);
            if sooner {
                self.ring(section);
            }
        });
    }
}

#[interrupt]
fn TIMER0() {
    TIMER0.events_compare(ALARM).write_value(0);
    TIMER0.events_compare(ANEW).write_value(0);
    critical_section::with(|section| CLOCK.ring(section));
}
