//! Milliseconds since the start; its interrupt shows the lights. This processor has no SysTick.

use crate::lights;
use core::sync::atomic::{AtomicU32, Ordering::Relaxed};
use nrf51_pac::{Interrupt, NVIC, Peripherals, interrupt};

/// Microseconds from one moment to the next.
const MOMENT: u32 = 250;

static MOMENTS: AtomicU32 = AtomicU32::new(0);

/// Starts the clock.
pub fn begin(board: &Peripherals) {
    // The crystal is exact enough for the serial line; the clock runs without it until it has started.
    // SAFETY, here and below: the registers of this peripheral, with values from its manual.
    board.CLOCK.tasks_hfclkstart.write(|task| unsafe { task.bits(1) });
    let timer = &board.TIMER0;
    timer.bitmode.write(|mode| mode.bitmode()._16bit());
    timer.prescaler.write(|prescaler| unsafe { prescaler.bits(4) }); // 16 MHz / 2^4
    timer.cc[0].write(|count| unsafe { count.bits(MOMENT) });
    timer.shorts.write(|shorts| shorts.compare0_clear().enabled());
    timer.intenset.write(|interrupts| interrupts.compare0().set());
    timer.tasks_start.write(|task| unsafe { task.bits(1) });
    // SAFETY: the handler below shares nothing but atomics with the rest.
    unsafe { NVIC::unmask(Interrupt::TIMER0) };
}

/// Milliseconds since the start; wraps after 12 days.
pub fn now() -> u32 {
    MOMENTS.load(Relaxed) / (1_000 / MOMENT)
}

#[interrupt]
fn TIMER0() {
    // SAFETY: of these, only this handler writes the event.
    let board = unsafe { Peripherals::steal() };
    board.TIMER0.events_compare[0].write(|event| unsafe { event.bits(0) });
    let moment = MOMENTS.load(Relaxed);
    MOMENTS.store(moment.wrapping_add(1), Relaxed);
    lights::refresh(moment);
}
