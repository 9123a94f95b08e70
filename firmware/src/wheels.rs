//! The paper's lessons on two wheels that slip, on a microcontroller: odometry to cells, actions to wheel speeds, and sensed places as the
//! truth. Exits with 0 if no wall was touched, enough actions failed, and the tests pass.

#![no_std]
#![no_main]

#[allow(dead_code, reason = "nothing is counted here")]
mod board;
mod fault;
mod memory;
#[allow(dead_code, reason = "only the course reports its stack")]
mod stack;

use board::report;
use goodbot::{Agent, Options, home};
use goodbot_course::{TESTS, generator};
use goodbot_drill::SEED;
use goodbot_drive::simulation::{Tally, course};

static mut MEMORY: memory::RobotMemory = memory::RobotMemory::new();

/// More than one action in this many must fail: otherwise failures are not tested.
const FAIL: u32 = 30;

#[board::entry]
fn main() -> ! {
    // SAFETY: this function runs once, and nothing else touches the static.
    let memory = unsafe { &mut *(&raw mut MEMORY) };
    let mut tally = Tally::default();
    let done = drive(memory, &mut tally).is_some();
    for (name, number) in [
        ("actions", tally.actions),
        ("failed", tally.failed),
        ("walls-hit", tally.walls_hit),
        ("right", tally.right),
        ("tests", TESTS.len() as u32),
    ] {
        report(name, number);
    }
    let tried = tally.failed > tally.actions / FAIL;
    board::exit(if done && tried && tally.walls_hit == 0 && tally.right == TESTS.len() as u32 { 0 } else { 1 })
}

/// Runs all lessons and tests; `None` if a call was refused.
fn drive(memory: &mut memory::RobotMemory, tally: &mut Tally) -> Option<()> {
    // Borrow the `Result`: moving the value out would copy it on the stack.
    let mut made = Agent::new(&mut memory.agent, &home::paper_tasks().ok()?, Options::DEFAULT);
    course(made.as_mut().ok()?, &mut memory.home, &mut generator(SEED), tally).ok()
}
