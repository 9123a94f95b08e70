//! The least capacities for a robot and its lessons: with them nothing is refused or dropped; with less, something is.

use crate::arm;
use crate::lamps;
use crate::teach;

use arm::{Arm, Shelf};
use goodbot::capacity::{Capacity, CapacityError};
use goodbot::home::{self, HomeError, Problem};
use goodbot::memory::{AgentHeap, HomeHeap, HomeMemory};
use goodbot::oomdp::{Domain, ObjectError};
use goodbot::session::Lessons;
use goodbot::task::LiftedTask;
use goodbot::{Agent, AgentError, Capacities, HeapMemory, Options};
use goodbot_course::{Homes, TESTS};
use lamps::{House, Lamps};
use teach::{obey, teach};

/// The lessons of a robot: start state, command, meaning.
type Taught<'a, S> = [(S, &'a str, &'a str)];

/// The numbers of these commands, by which memory is planned.
fn lessons<S>(taught: &Taught<'_, S>) -> Lessons {
    let words = || taught.iter().flat_map(|(_, command, _)| command.split(' ')).collect::<std::collections::BTreeSet<_>>();
    let longest = taught.iter().map(|(_, command, _)| command.split(' ').count()).max().unwrap();
    Lessons {
        different_words: words().len(),
        word_bytes: words().iter().map(|word| word.len()).sum(),
        ..Lessons::new(taught.len(), longest)
    }
}

/// The least capacities that roomy memory gives for this robot.
fn least<D: Domain>(domain: &D, tasks: &[LiftedTask], options: Options, taught: &Taught<'_, D::State>) -> Capacities {
    let mut agent = Agent::new(AgentHeap::new(&Capacities::STANDARD), tasks, options).unwrap();
    let least = agent.least_capacities(domain, &lessons(taught)).unwrap();
    assert_eq!(
        agent.usage(),
        Agent::new(AgentHeap::new(&Capacities::STANDARD), tasks, options).unwrap().usage(),
        "nothing is left in the scratch space"
    );
    least
}

/// Teaches all lessons with these capacities. Returns the number of sessions kept, and the highest use of each table.
fn live<D: Domain>(
    domain: &D,
    tasks: &[LiftedTask],
    options: Options,
    taught: &Taught<'_, D::State>,
    capacities: &Capacities,
) -> Result<(usize, Capacities), AgentError> {
    let mut agent = Agent::new(AgentHeap::new(capacities), tasks, options)?;
    for (start, command, meaning) in taught {
        teach(&mut agent, domain, start, command, meaning)?;
    }
    for (start, command, _) in taught {
        obey(&mut agent, domain, start, command)?;
    }
    Ok((agent.language().bitext().sessions(), agent.most_used()))
}

/// With exactly the least capacities everything is kept. Of each table that is then full, one entry less is refused by the table's name,
/// drops another session, or leaves something out in another table.
fn check<D: Domain>(
    domain: &D,
    tasks: &[LiftedTask],
    taught: &Taught<'_, D::State>,
    build: impl Fn(&Capacities) -> Result<(), CapacityError>,
) -> Capacities {
    for options in [Options::DEFAULT, Options::SMOOTHED, Options::PAPER] {
        let least = least(domain, tasks, options, taught);
        let one_less = |capacity| {
            let mut less = least;
            less.set(capacity, least.get(capacity) - 1);
            less
        };
        assert_eq!(build(&least), Ok(()));
        for capacity in [Capacity::Objects, Capacity::Names, Capacity::NameBytesTogether] {
            assert_eq!(build(&one_less(capacity)).map_err(|error| error.capacity), Err(capacity));
        }
        let (kept, used) = live(domain, tasks, options, taught, &least).unwrap();
        assert_eq!(kept, taught.len(), "{options:?} {least:#?}");
        let is_full = |capacity: &Capacity| least.get(*capacity) > 0 && used.get(*capacity) == least.get(*capacity);
        let full: Vec<Capacity> = Capacity::ALL.into_iter().filter(is_full).collect();
        assert!(full.contains(&Capacity::Strategies) && full.contains(&Capacity::Sessions), "{full:?}");
        for &capacity in &full {
            match live(domain, tasks, options, taught, &one_less(capacity)) {
                Err(AgentError::Capacity(error)) => assert_eq!(error.capacity, capacity),
                Err(error) => panic!("{capacity}: {error}"),
                Ok((kept, less)) => {
                    let others = |used: &Capacities| Capacity::ALL.map(|other| if other == capacity { 0 } else { used.get(other) });
                    assert!(kept < taught.len() || others(&less) != others(&used), "{capacity}");
                }
            }
        }
    }
    least(domain, tasks, Options::PAPER, taught)
}

#[test]
fn an_arm_lives_in_the_least_capacities() {
    let mut memory = HeapMemory::new(&Capacities::STANDARD);
    let arm = Arm::new(memory.home.lend().objects).unwrap();
    let (start, other) = (Shelf { arm: 0, things: [1, 2] }, Shelf { arm: 3, things: [0, 1] });
    let tasks = Arm::tasks().unwrap();
    let taught: &Taught<'_, _> = &[
        (start, "put the cup on the red slot", "thingInSlot(thing0, slot0)"),
        (other, "put the ball on the yellow slot", "thingInSlot(thing1, slot3)"),
        (start, "move to the green slot", "armAtSlot(arm, slot1)"),
        (start, "move to the yellow slot", "armAtSlot(arm, slot3)"),
        (start, "put the ball on the red slot", "thingInSlot(thing1, slot0)"),
    ];
    let build = |capacities: &Capacities| match Arm::new(HomeHeap::new(capacities).lend().objects) {
        Err(ObjectError::Capacity(error)) => Err(error),
        other => other.map(drop).map_err(|error| panic!("{error}")),
    };
    let least = check(&arm, &tasks, taught, build);
    // Four slots for the arm, and four for each of two things.
    assert_eq!((least.tasks, least.ground_propositions, least.cells), (12, 12, 0));
    let mut less = least;
    less.states -= 64;
    let refused = live(&arm, &tasks, Options::PAPER, taught, &less);
    assert_eq!(refused, Err(CapacityError::new(Capacity::States, less.states, least.states).into()));
}

#[test]
fn lamps_are_switched_in_the_least_capacities() {
    let mut memory = HeapMemory::new(&Capacities::STANDARD);
    let lamps = Lamps::new(memory.home.lend().objects).unwrap();
    let start = House { room: 1, on: 0b0101 };
    let taught: &Taught<'_, _> = &[
        (start, "light up the hall", "lampIsOn(lamp1)"),
        (start, "make the kitchen dark", "lampIsOff(lamp0)"),
        (House { room: 0, on: 0 }, "light up the attic", "lampIsOn(lamp3)"),
        (House { room: 3, on: 0b1111 }, "make the study dark", "lampIsOff(lamp2)"),
    ];
    let build = |capacities: &Capacities| match Lamps::new(HomeHeap::new(capacities).lend().objects) {
        Err(ObjectError::Capacity(error)) => Err(error),
        other => other.map(drop).map_err(|error| panic!("{error}")),
    };
    let least = check(&lamps, &Lamps::tasks().unwrap(), taught, build);
    assert_eq!((least.tasks, least.states), (8, 64));
}

#[test]
fn the_course_fits_the_least_capacities_for_its_home() {
    let mut memory = HeapMemory::new(&Capacities::STANDARD);
    let (home, start) = Homes::FIXED.test.build(&mut memory.home).unwrap();
    let tasks = home::paper_tasks().unwrap();
    let name = |class: &str, attribute: usize, value: &str| {
        let objects = home.world().objects;
        objects.iter().map(|(id, _)| id).find(|&id| objects.value(id, attribute) == value && objects.name(id).starts_with(class)).unwrap()
    };
    let objects = home.world().objects;
    let meant = TESTS.map(|test| {
        let room = objects.name(name("room", home::COLOR, test.intention.room));
        match test.intention.block {
            Some((color, _)) => format!("blockInRoom({}, {room})", objects.name(name("block", home::COLOR, color))),
            None => format!("agentInRoom(agent0, {room})"),
        }
    });
    let taught: Vec<_> = TESTS.iter().zip(&meant).map(|(test, task)| (start, test.command, task.as_str())).collect();
    let build = |capacities: &Capacities| match Homes::FIXED.test.build(HomeHeap::new(capacities)) {
        Err(HomeError { problem: Problem::Capacity(error), .. }) => Err(error),
        other => other.map(drop).map_err(|error| panic!("{error}")),
    };
    let least = check(&home, &tasks, &taught, build);
    // Four rooms for the agent, and four for each of two blocks.
    assert_eq!((least.tasks, least.cells), (12, 40));
    let mut less = least;
    less.cells -= 1;
    assert_eq!(build(&less).map_err(|error| error.capacity), Err(Capacity::Cells));
}
