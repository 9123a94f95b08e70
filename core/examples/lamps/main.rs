//! Teaches a robot to switch lamps.
//!
//! `cargo run --example lamps --features alloc -p goodbot`

mod domain;
#[path = "../teach/mod.rs"]
mod teach;

use domain::{House, Lamps};
use goodbot::memory::HomeMemory;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use teach::{obey, teach};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let lamps = Lamps::new(memory.home.lend().objects)?;
    let mut agent = Agent::new(&mut memory.agent, &Lamps::tasks()?, Options::DEFAULT)?;
    let start = House { room: 1, on: 0b0101 };
    for (command, meaning) in [
        ("light up the hall", "lampIsOn(lamp1)"),
        ("make the kitchen dark", "lampIsOff(lamp0)"),
        ("light up the attic", "lampIsOn(lamp3)"),
        ("make the study dark", "lampIsOff(lamp2)"),
    ] {
        teach(&mut agent, &lamps, &start, command, meaning)?;
    }
    let (actions, end) = obey(&mut agent, &lamps, &House { room: 3, on: 0b1000 }, "light up the kitchen")?;
    println!("{}: {end:?}", actions.join(" "));
    Ok(())
}
