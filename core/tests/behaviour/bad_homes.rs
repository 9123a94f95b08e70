//! Invalid homes are refused without a panic, and the error names the object at fault.

use crate::rooms::Memory;

use goodbot::Capacities;
use goodbot::capacity::{Capacity, CapacityError};
use goodbot::home::{Area, Cell, HomeBuilder, HomeError, Moves, Problem};
use goodbot::memory::HomeArrays;

const ROOM: Area = Area::new(0, 0, 8, 4);

fn refused(make: impl FnOnce(&mut HomeBuilder<HomeArrays<Memory>>) -> Result<(), HomeError>) -> HomeError {
    let mut builder = HomeBuilder::new(Memory::new().home);
    let built = make(&mut builder).and_then(|()| builder.build(Moves::Push));
    built.map(|_| ()).unwrap_err()
}

#[test]
fn a_home_needs_one_agent() {
    let none = refused(|home| home.room("room0", ROOM, "red").map(|_| ()));
    assert_eq!(none, HomeError { problem: Problem::NoAgent, object: None });
    let two = refused(|home| {
        home.room("room0", ROOM, "red")?;
        home.agent("agent0", Cell::new(1, 1))?;
        home.agent("agent1", Cell::new(2, 1)).map(|_| ())
    });
    assert_eq!(two, HomeError { problem: Problem::SecondAgent, object: Some(2) });
}

#[test]
fn a_home_needs_a_room_with_a_cell_in_it() {
    let none = refused(|home| home.agent("agent0", Cell::new(1, 1)).map(|_| ()));
    assert_eq!(none.problem, Problem::NoRoom);
    for area in [Area::new(0, 0, 1, 4), Area::new(0, 0, 4, 0), Area::new(4, 4, 0, 0), Area::new(i32::MAX, 0, i32::MIN, 8)] {
        assert_eq!(refused(|home| home.room("room0", area, "red").map(|_| ())).problem, Problem::RoomOfNoArea);
    }
}

#[test]
fn nothing_stands_in_a_wall_or_outside_every_room() {
    for cell in [Cell::new(0, 0), Cell::new(8, 2), Cell::new(20, 2)] {
        let agent = refused(|home| {
            home.room("room0", ROOM, "red")?;
            home.agent("agent0", cell).map(|_| ())
        });
        assert_eq!(agent, HomeError { problem: Problem::InWall, object: Some(1) });
        let block = refused(|home| {
            home.room("room0", ROOM, "red")?;
            home.agent("agent0", Cell::new(1, 1))?;
            home.block("block0", cell, "red", "bag").map(|_| ())
        });
        assert_eq!(block, HomeError { problem: Problem::InWall, object: Some(2) });
    }
}

#[test]
fn two_things_do_not_stand_on_one_cell() {
    let error = refused(|home| {
        home.room("room0", ROOM, "red")?;
        home.agent("agent0", Cell::new(1, 1))?;
        home.block("block0", Cell::new(2, 2), "red", "bag")?;
        home.block("block1", Cell::new(2, 2), "red", "chair").map(|_| ())
    });
    assert_eq!(error, HomeError { problem: Problem::OnAnother, object: Some(3) });
}

#[test]
fn each_object_has_a_name_of_its_own() {
    let error = refused(|home| {
        home.room("room0", ROOM, "red")?;
        home.agent("room0", Cell::new(1, 1)).map(|_| ())
    });
    assert_eq!(error, HomeError { problem: Problem::DuplicateName, object: Some(1) });
    assert_eq!(refused(|home| home.room("", ROOM, "red").map(|_| ())).problem, Problem::EmptyName);
}

#[test]
fn ten_thousand_objects_are_refused_at_the_first_that_does_not_fit() {
    let error = refused(|home| {
        for count in 0..10_000 {
            home.door(&format!("door{count}"), Area::new(1, 1, 1, 1))?;
        }
        Ok(())
    });
    let limit = Capacities::SMALL.objects;
    let full = CapacityError { capacity: Capacity::Objects, limit: limit as u32, given: limit as u32 + 1 };
    assert_eq!(error, HomeError { problem: Problem::Capacity(full), object: Some(limit as u16) });
    assert_eq!(full.to_string(), "no room: Capacities::objects is 12, and 13 or more were given; raise it");
}

#[test]
fn a_room_beyond_all_measure_is_refused() {
    for area in [Area::new(0, 0, i32::MAX, i32::MAX), Area::new(i32::MIN, 0, 4, 4)] {
        assert_eq!(refused(|home| home.room("room0", area, "red").map(|_| ())).problem, Problem::TooFar);
    }
    let error = refused(|home| {
        home.room("room0", Area::new(-255, -255, 255, 255), "red")?;
        home.agent("agent0", Cell::new(1, 1)).map(|_| ())
    });
    assert!(matches!(error.problem, Problem::Capacity(CapacityError { capacity: Capacity::Cells, .. })));
}

/// A home with more states than a u64 can number: two hundred cells and eight blocks.
#[cfg(feature = "alloc")]
#[test]
fn a_home_with_more_states_than_can_be_numbered_is_refused() {
    let capacities = Capacities { cells: 200, ..Capacities::SMALL };
    let build = |blocks: i32| {
        let mut memory = goodbot::HeapMemory::new(&capacities);
        let mut builder = HomeBuilder::new(&mut memory.home);
        builder.room("room0", Area::new(0, 0, 21, 11), "red").unwrap();
        builder.agent("agent0", Cell::new(1, 1)).unwrap();
        for block in 0..blocks {
            builder.block(&format!("block{block}"), Cell::new(2 + block, 5), "red", "bag").unwrap();
        }
        builder.build(Moves::Push).map(|_| ())
    };
    assert_eq!(build(7), Ok(()));
    let refused = Err(HomeError { problem: Problem::TooManyStates, object: None });
    assert_eq!(build(8), if cfg!(feature = "alloc") { Ok(()) } else { refused });
}
