//! The paper's course on an ESP32-C3: it begins at power-on, and reports on the serial line of GPIO21, at 115,200 baud.
//! In `firmware`: `cargo build --release --package goodbot-esp32c3 --target riscv32imc-unknown-none-elf`, then Espressif's `espflash`.

#![no_std]
#![no_main]

use core::fmt::Write;
use esp_hal::main;
use esp_hal::uart::{Config, Uart};
use goodbot_drill::{Budget, SEED, run};

goodbot::memory! { struct RobotMemory = goodbot::Capacities::SMALL; }

static mut MEMORY: RobotMemory = RobotMemory::new();

// The second loader starts only a program with this description.
esp_bootloader_esp_idf::esp_app_desc!();

#[main]
fn main() -> ! {
    let board = esp_hal::init(esp_hal::Config::default());
    // The chip has the default speed.
    let Ok(serial) = Uart::new(board.UART0, Config::default()) else { rest() };
    let mut serial = serial.with_tx(board.GPIO21);
    // SAFETY: this function runs once, and nothing else touches the static.
    let memory = unsafe { &mut *(&raw mut MEMORY) };
    // If the line fails, nobody can be told.
    let _ = match run(&mut memory.home, &mut memory.agent, SEED, Budget::ROUNDS, &mut ()) {
        Ok(course) => write!(serial, "passed {}\ntests {}\ndigest {}\n", course.passed, course.tests, course.digest.0),
        Err(_) => serial.write_str("error: the memory is too small for the course\n"),
    };
    rest()
}

fn rest() -> ! {
    loop {
        core::hint::spin_loop();
    }
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    rest()
}
