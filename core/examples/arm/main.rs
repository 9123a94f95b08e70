//! Teaches an arm where to put things.
//!
//! `cargo run --example arm --features alloc -p goodbot`

mod domain;
#[path = "../teach/mod.rs"]
mod teach;

use domain::{Arm, Shelf};
use goodbot::memory::HomeMemory;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use teach::{obey, teach};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let arm = Arm::new(memory.home.lend().objects)?;
    let mut agent = Agent::new(&mut memory.agent, &Arm::tasks()?, Options::DEFAULT)?;
    let start = Shelf { arm: 0, things: [1, 2] };
    for (command, meaning) in [
        ("put the cup on the red slot", "thingInSlot(thing0, slot0)"),
        ("put the ball on the yellow slot", "thingInSlot(thing1, slot3)"),
        ("move to the green slot", "armAtSlot(arm, slot1)"),
        ("move to the yellow slot", "armAtSlot(arm, slot3)"),
        ("put the ball on the red slot", "thingInSlot(thing1, slot0)"),
    ] {
        teach(&mut agent, &arm, &start, command, meaning)?;
    }
    let (actions, end) = obey(&mut agent, &arm, &start, "put the cup on the yellow slot")?;
    println!("{}: {end:?}", actions.join(" "));
    Ok(())
}
