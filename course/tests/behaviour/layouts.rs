//! The homes of the course: each can be built, solved, and held by a controller.

use goodbot::home::{Area, Cell, Map};
use goodbot::{Agent, Capacities, HeapMemory, Options, home};
use goodbot_course::exercise::HomeName;
use goodbot_course::layout::{BlockPlan, is_solvable};
use goodbot_course::{Homes, Intention, LESSONS, Layout, TESTS, generator};

fn assert_every_command_can_be_obeyed(homes: &Homes, memory: &mut HeapMemory) {
    for exercise in LESSONS.iter().chain(&TESTS) {
        let (home, start) = homes.layout(exercise.home).build(&mut memory.home).unwrap();
        assert!(is_solvable(&home, &start, &exercise.intention), "{}\n{}", exercise.command, Map::new(&home, &start));
    }
}

#[test]
fn every_command_can_be_obeyed_in_the_drawn_homes_within_a_controllers_memory() {
    assert_every_command_can_be_obeyed(&Homes::FIXED, &mut HeapMemory::new(&Capacities::SMALL));
}

#[test]
fn every_command_can_be_obeyed_in_random_homes_within_a_controllers_memory() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    for seed in 0..200 {
        let homes = Homes::random(&mut generator(seed), &mut &mut memory.home);
        assert_every_command_can_be_obeyed(&homes, &mut memory);
    }
}

#[test]
fn random_homes_are_not_the_drawn_ones_and_differ_from_seed_to_seed() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut homes = |seed| Homes::random(&mut generator(seed), &mut &mut memory.home);
    let (first, second) = (homes(1), homes(2));
    for name in [HomeName::A, HomeName::B, HomeName::C, HomeName::D, HomeName::E, HomeName::F, HomeName::Test] {
        assert_ne!(first.layout(name), Homes::FIXED.layout(name));
        assert_ne!(first.layout(name), second.layout(name));
    }
    assert_eq!(homes(1), first);
}

#[test]
fn the_search_of_the_agent_finds_the_way_to_what_is_called_solvable() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    for seed in 0..20 {
        let homes = Homes::random(&mut generator(seed), &mut memory.home);
        let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks().unwrap(), Options::PAPER).unwrap();
        for exercise in &LESSONS {
            let (home, start) = homes.layout(exercise.home).build(&mut memory.home).unwrap();
            let intended = exercise.pose(&mut agent, &home, &start).unwrap().unwrap();
            agent.plan_fully(&home, &start).unwrap();
            assert!(agent.planned().distance(intended).is_some(), "{}\n{}", exercise.command, Map::new(&home, &start));
        }
    }
}

/// One room of three by three cells beside another, the chair at x 1 to 3 in the middle row.
fn with_chair_at(cell: Cell) -> Layout {
    Layout {
        rooms: [Some((Area::new(0, 0, 4, 4), "red")), Some((Area::new(4, 0, 8, 4), "green")), None, None],
        doors: [Some(Cell::new(4, 2)), None, None, None],
        agent: Cell::new(2, 1),
        blocks: [Some(BlockPlan { cell, color: "blue", shape: "chair" }), None],
    }
}

#[test]
fn a_block_in_a_corner_cannot_be_taken_anywhere() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut solvable = |cell, intention: Intention| {
        let (home, start) = with_chair_at(cell).build(&mut memory.home).unwrap();
        is_solvable(&home, &start, &intention)
    };
    let take = Intention::take("blue", "chair", "green");
    assert!(solvable(Cell::new(2, 2), take));
    assert!(!solvable(Cell::new(1, 3), take));
    assert!(solvable(Cell::new(1, 3), Intention::go("green")));
}

#[test]
fn what_holds_already_or_is_not_there_cannot_be_asked_for() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let (home, start) = with_chair_at(Cell::new(2, 2)).build(&mut memory.home).unwrap();
    assert!(!is_solvable(&home, &start, &Intention::go("red")));
    assert!(!is_solvable(&home, &start, &Intention::go("purple")));
    assert!(!is_solvable(&home, &start, &Intention::take("blue", "bag", "green")));
}
