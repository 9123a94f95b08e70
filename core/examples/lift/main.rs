//! Teaches a lift made of tables.
//!
//! `cargo run --example lift --features std -p goodbot`

mod domain;
#[path = "../teach/mod.rs"]
mod teach;

use domain::TableRobot;
use goodbot::memory::HomeMemory;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use teach::{obey, teach};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let lift = TableRobot::lift(memory.home.lend().objects)?;
    let mut agent = Agent::new(&mut memory.agent, &TableRobot::tasks()?, Options::PAPER)?;
    for (command, meaning) in [
        ("to the roof please", ("liftAtFloor", &["lift", "floor3"][..])),
        ("to the garage please", ("liftAtFloor", &["lift", "floor0"])),
        ("to the shop", ("liftAtFloor", &["lift", "floor1"])),
    ] {
        teach(&mut agent, &lift, &2, command, meaning)?;
    }
    let (actions, end) = obey(&mut agent, &lift, &0, "to the roof")?;
    println!("{}: floor {end}", actions.join(" "));
    Ok(())
}
