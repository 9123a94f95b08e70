//! A robot among embassy's tasks, on a BBC micro:bit (the first version: nRF51822, 16 KiB of RAM). It gives itself one command after the
//! other; button B is good, A is bad, and A while B is held ends the lesson.
//!
//! | module | what it holds |
//! |---|---|
//! | [`robot`] | the task that hears, plans, acts and learns, and lets the others run in between |
//! | [`buttons`] | the task that looks at the buttons |
//! | [`flash`] | the learned model, in a flash with asynchronous calls |
//! | [`time`] | embassy's clock |
//! | [`serial`] | the line on which it reports |
//! | [`nrf51`] | what both programs for this board have |
//! | `board`, `fault` | a stack overflow, which must stop the robot and change nothing |

#![no_std]
#![no_main]

mod board;
mod buttons;
#[path = "../../src/fault.rs"]
mod fault;
mod flash;
#[path = "../../src/nrf51.rs"]
mod nrf51;
mod robot;
mod serial;
#[path = "../../src/stack.rs"]
mod stack;
mod time;

use embassy_executor::Spawner;
use embassy_nrf::Peripherals;
use embassy_nrf::gpio::{Level, Output, OutputDrive};
use embassy_time::Timer;

#[embassy_executor::main]
async fn main(spawner: Spawner) {
    // Not `embassy_nrf::init`: on this chip it does nothing but wait for the slow clock, which nothing here needs and the emulator lacks.
    // SAFETY: this function runs once.
    let board = unsafe { Peripherals::steal() };
    serial::begin();
    time::begin();
    serial::say(&["goodbot on the micro:bit, by embassy"]);
    let light = (Output::new(board.P0_13, Level::High, OutputDrive::Standard), Output::new(board.P0_04, Level::Low, OutputDrive::Standard));
    // Each task can run once at a time, and is started once.
    let (buttons, robot) = (buttons::watch(board.P0_17.into(), board.P0_26.into()), robot::live(board.NVMC));
    if let (Ok(buttons), Ok(robot)) = (buttons, robot) {
        spawner.spawn(buttons);
        spawner.spawn(robot);
    }
    blink(light).await;
}

/// Shows that no task keeps the others waiting.
async fn blink((_row, mut column): (Output<'static>, Output<'static>)) -> ! {
    loop {
        column.toggle();
        Timer::after_millis(100).await;
    }
}
