//! The paper's course on a Raspberry Pi Pico: it begins at power-on, and reports on the serial line of GP0, at 115,200 baud.
//! `cargo xtask pico` writes `dist/goodbot.uf2`: hold the button while you connect the board, and drag the file onto it.

#![no_std]
#![no_main]

use core::fmt::{self, Write};
use cortex_m_rt::entry;
use embassy_rp::uart::{Blocking, Config, Uart};
use goodbot_drill::{Budget, SEED, run};

goodbot::memory! { struct RobotMemory = goodbot::Capacities::SMALL; }

static mut MEMORY: RobotMemory = RobotMemory::new();

/// The serial line.
struct Serial(Uart<'static, Blocking>);

impl Write for Serial {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.blocking_write(text.as_bytes()).map_err(|_| fmt::Error)
    }
}

#[entry]
fn main() -> ! {
    let board = embassy_rp::init(embassy_rp::config::Config::default());
    let mut serial = Serial(Uart::new_blocking(board.UART0, board.PIN_0, board.PIN_1, Config::default()));
    // SAFETY: this function runs once, and nothing else touches the static.
    let memory = unsafe { &mut *(&raw mut MEMORY) };
    // If the line fails, nobody can be told.
    let _ = match run(&mut memory.home, &mut memory.agent, SEED, Budget::ROUNDS, &mut ()) {
        Ok(course) => write!(serial, "passed {}\ntests {}\ndigest {}\n", course.passed, course.tests, course.digest.0),
        Err(_) => serial.write_str("error: the memory is too small for the course\n"),
    };
    loop {
        cortex_m::asm::wfi();
    }
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {
        cortex_m::asm::wfi();
    }
}
