//! A robot that only obeys: the arm, with learned parameters. Prints its cost and a digest of all posteriors; exits with 0 if it
//! understands a command that nobody taught, and carries it out.

#![no_std]
#![no_main]

#[path = "../../core/examples/arm/domain.rs"]
mod arm;
mod board;
#[allow(dead_code, reason = "the meanings are for lessons")]
mod commands;
#[path = "../../course/drill/src/digest.rs"]
mod digest;
mod fault;
goodbot::memory! { struct RobotMemory = goodbot::Capacities::SMALL.obeying(); }
#[allow(dead_code, reason = "the whole stack is not told")]
mod stack;

use arm::Arm;
use board::report;
use goodbot::memory::{AgentMemory, HomeMemory};
use goodbot::oomdp::Action;
use goodbot::planning::{OptimalSet, Progress};
use goodbot::{Agent, AgentError, Options};

static mut MEMORY: RobotMemory = RobotMemory::new();

/// A test writes them anew when the lessons change.
static PARAMETERS: &[u8] = include_bytes!("arm.parameters");

/// Carries out the command that was heard last. Returns whether it reached its goal.
fn obey(agent: &mut Agent<impl AgentMemory>, arm: &Arm<'_>) -> Result<bool, AgentError> {
    let mut shelf = commands::START;
    loop {
        while agent.plan(arm, &shelf, 8)? == Progress::Working {}
        let decision = agent.decide(arm, &shelf)?;
        shelf = agent.acted(arm, &shelf, decision.action)?;
        if decision.action == Action::NOOP {
            return Ok(decision.plan == OptimalSet::Goal);
        }
    }
}

#[board::entry]
fn main() -> ! {
    board::start_counter(board::MOST_PERIOD);
    // SAFETY: this function runs once, and nothing else touches the static.
    let memory = unsafe { &mut *(&raw mut MEMORY) };
    let (Ok(arm), Ok(tasks)) = (Arm::new(memory.home.lend().objects), Arm::tasks()) else { board::exit(2) };
    // Borrow the `Result`: moving the value out would copy it on the stack.
    let mut made = Agent::new(&mut memory.agent, &tasks, Options::DEFAULT);
    let Ok(agent) = made.as_mut() else { board::exit(2) };
    if agent.restore_parameters(PARAMETERS).is_err() {
        board::exit(3);
    }
    let Ok((digest, understood)) = commands::understanding(agent, &arm) else { board::exit(1) };
    let obeyed = obey(agent, &arm);
    report("instructions", board::instructions() as u32);
    report("digest", digest.0);
    report("statics", stack::statics());
    report("stack", stack::deepest());
    board::exit(if understood && obeyed == Ok(true) { 0 } else { 1 })
}
