//! The first plan in a home of three storeys, for all tasks with a way of one clause. Prints its cost; exits with 0 if every task has a
//! plan.

#![no_std]
#![no_main]

mod board;
mod fault;
mod stack;

use board::report;
use goodbot::home::{AGENT_IN_ROOM, Area, Cell, Home, HomeBuilder, HomeState, Moves, SCHEMA, with_routes};
use goodbot::memory::HomeMemory;
use goodbot::planning::OptimalSet;
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, Options};

goodbot::memory! {
    /// Room for a floor of 99 cells and for the 50 tasks of such a home.
    pub struct RobotMemory = Capacities {
        cells: 99,
        goal_entries: 99,
        states: 640,
        tasks: 50,
        strategies: 1,
        beliefs: 50,
        candidates: 50,
        candidate_tokens: 1_000,
        ..Capacities::SMALL
    };
}

static mut MEMORY: RobotMemory = RobotMemory::new();

/// The robot below, three rooms between, one above.
fn three_storeys<M: HomeMemory>(memory: M) -> Option<(Home<M>, HomeState)> {
    let mut builder = HomeBuilder::new(memory);
    for (name, area, color) in [
        ("room0", Area::new(0, 8, 12, 12), "green"),
        ("room1", Area::new(0, 4, 4, 8), "blue"),
        ("room2", Area::new(4, 4, 8, 8), "red"),
        ("room3", Area::new(8, 4, 12, 8), "yellow"),
        ("room4", Area::new(0, 0, 12, 4), "pink"),
    ] {
        builder.room(name, area, color).ok()?;
    }
    for (name, x, y) in [("door0", 2, 4), ("door1", 6, 4), ("door2", 10, 4), ("door3", 2, 8), ("door4", 6, 8), ("door5", 10, 8)] {
        builder.door(name, Area::new(x, y, x, y)).ok()?;
    }
    builder.agent("agent0", Cell::new(6, 2)).ok()?;
    builder.build(Moves::Push).ok()
}

/// Hears a command and plans for the first time. Returns the number of tasks, and of those with a plan.
fn first_plan(memory: &mut RobotMemory) -> Option<(u32, u32)> {
    let (home, start) = three_storeys(&mut memory.home)?;
    let lifted = with_routes(&[LiftedTask::single(AGENT_IN_ROOM, &SCHEMA).ok()?]).ok()?;
    let mut agent = Agent::new(&mut memory.agent, &lifted, Options::DEFAULT).ok()?;
    let began = board::instructions();
    if let Err(error) = agent.hear(&home, &start, "go to the green room without entering the red one") {
        if let goodbot::AgentError::Capacity(full) = error {
            board::print(full.capacity.name());
            report("-asked", full.given as u32);
        }
        return None;
    }
    let heard = board::instructions();
    agent.plan_fully(&home, &start).ok()?;
    report("hear", heard.wrapping_sub(began) as u32);
    report("first-plan", board::instructions().wrapping_sub(heard) as u32);
    let tasks = agent.tasks().len();
    let planned = (0..tasks).filter(|&task| matches!(agent.planned().optimal(task), OptimalSet::Toward(_))).count();
    Some((tasks as u32, planned as u32))
}

#[board::entry]
fn main() -> ! {
    board::start_counter(board::MOST_PERIOD);
    // SAFETY: this function runs once, and nothing else touches the static.
    let memory = unsafe { &mut *(&raw mut MEMORY) };
    let planned = first_plan(memory);
    report("statics", stack::statics());
    report("stack", stack::deepest());
    match planned {
        Some((tasks, planned)) => {
            report("tasks", tasks);
            report("planned", planned);
            board::exit(if tasks == planned { 0 } else { 1 })
        }
        None => {
            board::print("error: the memory is too small for the home\n");
            board::exit(2)
        }
    }
}
