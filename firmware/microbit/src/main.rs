//! A robot on a BBC micro:bit, of either version. Its home is on the lights; button B is good, A is bad, both are the end of a lesson, and a
//! long press chooses the next command. `docs/robot.md` tells what people see.
//!
//! It is the code of V1, a Cortex-M0 with 16 KiB of RAM, which a Cortex-M4 as of V2 runs too.
//!
//! | module | what it holds |
//! |---|---|
//! | [`robot`] | the robot's work, and people's requests |
//! | [`request`] | the requests on the serial line |
//! | [`house`] | its own home, and the commands to teach it |
//! | [`picture`] | the pictures on the lights |
//! | [`memory`] | its capacities |
//! | [`flash`] | the learned model, kept without power |
//! | [`clock`], [`lights`], [`buttons`], [`serial`] | the board's parts |
//! | [`wiring`] | the differences between the two versions |
//! | [`nrf51`] | what both programs for this board have |
//! | `board`, `fault`, [`stack`] | a stack overflow, which must stop the robot and change nothing |

#![no_std]
#![no_main]

mod board;
mod buttons;
mod clock;
#[path = "../../src/fault.rs"]
mod fault;
mod flash;
mod house;
mod lights;
mod memory;
#[path = "../../src/nrf51.rs"]
mod nrf51;
mod picture;
mod request;
mod robot;
mod serial;
#[path = "../../src/stack.rs"]
mod stack;
mod wiring;

use buttons::Buttons;
use goodbot::memory::HomeArrays;
use memory::{Agent, RobotMemory};
use nrf51_pac::Peripherals;
use robot::Robot;

static mut AGENT: Agent = Agent::without_tasks(RobotMemory::new().agent);
static mut ROOMS: HomeArrays<RobotMemory> = RobotMemory::new().home;

#[cortex_m_rt::entry]
fn main() -> ! {
    // SAFETY: this function runs once; the interrupt handlers use only their own parts.
    let (agent, rooms, board) = unsafe { (&mut *(&raw mut AGENT), &mut *(&raw mut ROOMS), Peripherals::steal()) };
    lights::begin();
    serial::begin(&board);
    clock::begin(&board);
    let mut buttons = Buttons::begin(&board);
    serial::say(&["goodbot on the micro:bit; say help"]);
    let mut robot = Robot::new(agent, rooms);
    robot.remember();
    loop {
        let now = clock::now();
        if let Some(press) = buttons.poll(&board, now) {
            robot.pressed(press, now);
        }
        listen(&mut robot, now);
        robot.work(now);
        robot.store();
        lights::show(&robot.shows(now));
        if robot.listens() {
            // SAFETY: waits for an interrupt; the clock's comes every quarter of a millisecond.
            unsafe { core::arch::asm!("wfi", options(nomem, nostack, preserves_flags)) };
        }
    }
}

/// A function of its own, so that the line is on the stack only while it is read.
#[inline(never)]
fn listen(robot: &mut Robot<'_>, now: u32) {
    if robot.listens() {
        serial::read(|said| robot.asked(said.and_then(request::read), now));
    }
}
