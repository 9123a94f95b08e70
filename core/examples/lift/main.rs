//! Teaches a lift made of tables.
//!
//! `cargo run --example lift --features alloc -p goodbot`

mod domain;
#[path = "../teach/mod.rs"]
mod teach;

use domain::TableRobot;
use goodbot::memory::HomeMemory;
use goodbot::session::Lessons;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use teach::{obey, teach};

/// Commands, and the task that each means.
const LESSONS: [(&str, &str); 3] = [
    ("to the roof please", "liftAtFloor(lift, floor3)"),
    ("to the garage please", "liftAtFloor(lift, floor0)"),
    ("to the shop", "liftAtFloor(lift, floor1)"),
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // An agent with ample memory finds out how much is needed.
    let mut roomy = HeapMemory::new(&Capacities::STANDARD);
    let lift = TableRobot::lift(roomy.home.lend().objects)?;
    let mut desk = Agent::new(&mut roomy.agent, &TableRobot::tasks()?, Options::DEFAULT)?;
    let lessons = Lessons::of(LESSONS.map(|(command, _)| command))?;
    let mut memory = HeapMemory::new(&desk.least_capacities(&lift, &lessons)?);

    let lift = TableRobot::lift(memory.home.lend().objects)?;
    let mut agent = Agent::new(&mut memory.agent, &TableRobot::tasks()?, Options::DEFAULT)?;
    for (command, meaning) in LESSONS {
        teach(&mut agent, &lift, &2, command, meaning)?;
    }
    let (actions, end) = obey(&mut agent, &lift, &0, "to the roof")?;
    println!("{}: floor {end}", actions.join(" "));
    Ok(())
}
