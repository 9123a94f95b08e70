//! The robots of the core's examples learn their commands, and one that switches lamps.

use crate::arm;
use crate::lamps;
use crate::lift;
use crate::teach;

use arm::{Arm, Shelf};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Domain, check};
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use lamps::{House, Lamps};
use lift::TableRobot;
use teach::{obey, teach};

/// Teaches the lessons, then gives the commands: each must cause the actions and lead to the state listed with it.
fn learns<D: Domain>(domain: &D, tasks: &[LiftedTask], lessons: &[(D::State, &str, &str)], commands: &[(D::State, &str, &str, D::State)])
where
    D::State: std::fmt::Debug,
{
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = Agent::new(&mut memory.agent, tasks, Options::PAPER).unwrap();
    for (start, command, meaning) in lessons {
        teach(&mut agent, domain, start, command, meaning).unwrap();
    }
    for (start, command, actions, end) in commands {
        let (done, state) = obey(&mut agent, domain, start, command).unwrap();
        assert_eq!((done.join(" ").as_str(), state), (*actions, *end), "{command}");
    }
}

#[test]
fn an_arm_learns_to_carry_things_by_the_cheapest_way() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let arm = Arm::new(memory.home.lend().objects).unwrap();
    let start = Shelf { arm: 0, things: [1, 2] };
    learns(
        &arm,
        &Arm::tasks().unwrap(),
        &[
            (start, "put the cup on the red slot", "thingInSlot(thing0, slot0)"),
            (start, "put the ball on the yellow slot", "thingInSlot(thing1, slot3)"),
            (start, "move to the green slot", "armAtSlot(arm, slot1)"),
            (start, "move to the yellow slot", "armAtSlot(arm, slot3)"),
            (start, "put the ball on the red slot", "thingInSlot(thing1, slot0)"),
        ],
        &[
            (start, "put the cup on the yellow slot", "right grab right right release", Shelf { arm: 3, things: [3, 2] }),
            (Shelf { arm: 3, ..start }, "move to the red slot", "left left left", start),
        ],
    );
}

#[test]
fn a_robot_learns_to_switch_lamps() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let lamps = Lamps::new(memory.home.lend().objects).unwrap();
    let start = House { room: 1, on: 0b0101 };
    learns(
        &lamps,
        &Lamps::tasks().unwrap(),
        &[
            (start, "light up the hall", "lampIsOn(lamp1)"),
            (start, "make the kitchen dark", "lampIsOff(lamp0)"),
            (start, "light up the attic", "lampIsOn(lamp3)"),
            (start, "make the study dark", "lampIsOff(lamp2)"),
        ],
        &[
            (House { room: 3, on: 0b1000 }, "light up the kitchen", "west west west switch", House { room: 0, on: 0b1001 }),
            (House { room: 0, on: 0b1111 }, "make the hall dark", "east switch", House { room: 1, on: 0b1101 }),
        ],
    );
}

#[test]
fn a_robot_made_of_tables_learns_its_floors() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let lift = TableRobot::lift(memory.home.lend().objects).unwrap();
    learns(
        &lift,
        &TableRobot::tasks().unwrap(),
        &[
            (2, "to the roof please", "liftAtFloor(lift, floor3)"),
            (2, "to the garage please", "liftAtFloor(lift, floor0)"),
            (2, "to the shop", "liftAtFloor(lift, floor1)"),
        ],
        &[(0, "to the roof", "up up up", 3), (3, "to the shop please", "down down", 1)],
    );
}

#[test]
fn the_robots_of_the_examples_are_sound_in_every_state() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let arm = Arm::new(memory.home.lend().objects).unwrap();
    assert!(check(&arm, Shelf { arm: 0, things: [1, 2] }, 10_000).unwrap().all);
    let lamps = Lamps::new(memory.home.lend().objects).unwrap();
    assert!(check(&lamps, House { room: 1, on: 5 }, 10_000).unwrap().all);
}
