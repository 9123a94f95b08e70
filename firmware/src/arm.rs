//! A robot of one's own: the arm of the library's examples, taught on the controller. Prints its cost and a digest of all posteriors; exits
//! with 0 if it understands a command that it never heard.

#![no_std]
#![no_main]

#[path = "../../core/examples/arm/domain.rs"]
mod arm;
mod board;
mod commands;
#[path = "../../course/drill/src/digest.rs"]
mod digest;
mod fault;
mod lessons;
mod memory;
#[allow(dead_code, reason = "the whole stack is not told")]
mod stack;

use arm::Arm;
use board::report;
use goodbot::memory::HomeMemory;
use goodbot::oomdp::Domain;
use goodbot::{Agent, Options};

static mut MEMORY: memory::RobotMemory = memory::RobotMemory::new();

#[board::entry]
fn main() -> ! {
    board::start_counter(board::MOST_PERIOD);
    // SAFETY: this function runs once, and nothing else touches the static.
    let memory = unsafe { &mut *(&raw mut MEMORY) };
    let (Ok(arm), Ok(tasks)) = (Arm::new(memory.home.lend().objects), Arm::tasks()) else { board::exit(2) };
    // Borrow the `Result`: moving the value out would copy it on the stack.
    let mut made = Agent::new(&mut memory.agent, &tasks, Options::DEFAULT);
    let Ok(agent) = made.as_mut() else { board::exit(2) };
    if lessons::teach(agent, &arm).is_err() {
        board::exit(1);
    }
    report("instructions", board::instructions() as u32);
    let Ok((digest, understood)) = commands::understanding(agent, &arm) else { board::exit(1) };
    report("digest", digest.0);
    report("states", arm.state_count() as u32);
    report("statics", stack::statics());
    report("stack", stack::deepest());
    board::exit(if understood { 0 } else { 1 })
}
