//! Robots for the tests, in memory of the tests' own.

use goodbot_capi::capacities::{GOODBOT_SMALL, GoodbotCapacities, goodbot_preset};
use goodbot_capi::home::*;
use goodbot_capi::memory::{goodbot_size, goodbot_table_size};
use goodbot_capi::robot::Goodbot;
use goodbot_capi::status::GoodbotStatus;
use goodbot_capi::table::description::*;
use goodbot_capi::table::init::goodbot_init_table;
use goodbot_capi::training::*;
use std::ffi::{CStr, c_char, c_void};
use std::ptr::{null, null_mut};

/// Memory aligned to 8, a robot in it, and the capacities that it was made with.
pub struct Owned {
    pub memory: Vec<u64>,
    pub bytes: usize,
    pub capacities: GoodbotCapacities,
    pub robot: *mut Goodbot,
}

pub fn small() -> GoodbotCapacities {
    let mut capacities = std::mem::MaybeUninit::uninit();
    assert_eq!(unsafe { goodbot_preset(GOODBOT_SMALL, capacities.as_mut_ptr()) }, GoodbotStatus::Ok);
    unsafe { capacities.assume_init() }
}

/// A robot that will live in homes, in exactly as many bytes as it asks for.
pub fn in_homes(capacities: GoodbotCapacities) -> Owned {
    let bytes = unsafe { goodbot_size(&raw const capacities) };
    let mut owned = Owned { memory: vec![0; bytes.div_ceil(8)], bytes, capacities, robot: null_mut() };
    let made = unsafe { goodbot_init_home(owned.memory.as_mut_ptr().cast(), bytes, &raw const capacities, &raw mut owned.robot) };
    assert_eq!(made, GoodbotStatus::Ok);
    owned
}

/// A robot in a home of two rooms, and a block in its room.
pub fn at_home() -> Owned {
    let owned = in_homes(small());
    assert_eq!(describe(owned.robot), GoodbotStatus::Ok);
    owned
}

/// Two rooms and a block.
pub fn describe(robot: *mut Goodbot) -> GoodbotStatus {
    unsafe {
        for status in [
            goodbot_home_begin(robot),
            goodbot_home_room(robot, c"room0".as_ptr(), 0, 0, 8, 4, c"red".as_ptr()),
            goodbot_home_room(robot, c"room1".as_ptr(), 0, 4, 8, 8, c"green".as_ptr()),
            goodbot_home_door(robot, c"door0".as_ptr(), 2, 4, 2, 4),
            goodbot_home_block(robot, c"block0".as_ptr(), 6, 2, c"blue".as_ptr(), c"chair".as_ptr()),
            goodbot_home_agent(robot, c"agent0".as_ptr(), 4, 2),
        ] {
            assert_eq!(status, GoodbotStatus::Ok);
        }
        goodbot_home_build(robot)
    }
}

/// Hears a command and plans for it.
pub fn hear_and_plan(robot: *mut Goodbot, command: &CStr) {
    unsafe {
        assert_eq!(goodbot_hear(robot, command.as_ptr()), GoodbotStatus::Ok);
        while goodbot_plan(robot, 50) == GoodbotStatus::Working {}
        assert_eq!(goodbot_plan(robot, 50), GoodbotStatus::Ok);
    }
}

/// A lift with three floors: all that its table points to.
pub struct Lift {
    classes: [*const c_char; 2],
    pub carriers: [GoodbotCarrier; 1],
    attributes: [GoodbotAttribute; 1],
    propositions: [GoodbotProposition; 1],
    pub objects: [GoodbotObject; 4],
    pub actions: [GoodbotAction; 2],
    pub tasks: [*const c_char; 1],
    pub next: [u16; 6],
}

unsafe extern "C" fn at_floor(_: *mut c_void, state: u32, proposition: u8, arguments: *const u8) -> bool {
    proposition == 0 && u32::from(unsafe { *arguments.add(1) }) == state + 1
}

impl Lift {
    pub fn new() -> Box<Self> {
        let floor = |name: &'static CStr, value: &'static CStr| GoodbotObject {
            object_class: 1,
            name: name.as_ptr(),
            values: [value.as_ptr(), null(), null(), null()],
        };
        let up_and_down = [c"up", c"down"].map(|name| GoodbotAction { name: name.as_ptr(), cost: 1 });
        let mut lift = Box::new(Self {
            classes: [c"lift".as_ptr(), c"floor".as_ptr()],
            carriers: [GoodbotCarrier { object_class: 1, prefix: c"floorIs".as_ptr() }],
            attributes: [GoodbotAttribute { name: c"use".as_ptr(), carriers: null(), carrier_count: 1 }],
            propositions: [GoodbotProposition { name: c"liftAtFloor".as_ptr(), parameters: [0, 1, 0], parameter_count: 2 }],
            objects: [
                GoodbotObject { object_class: 0, name: c"lift0".as_ptr(), values: [null(); 4] },
                floor(c"floor0", c"garage"),
                floor(c"floor1", c"shop"),
                floor(c"floor2", c"roof"),
            ],
            actions: up_and_down,
            tasks: [c"liftAtFloor(?l, ?f)".as_ptr()],
            next: [1, GOODBOT_CANNOT, 2, 0, GOODBOT_CANNOT, 1],
        });
        lift.attributes[0].carriers = lift.carriers.as_ptr();
        lift
    }

    pub fn table(&self) -> GoodbotTable {
        GoodbotTable {
            classes: self.classes.as_ptr(),
            class_count: 2,
            attributes: self.attributes.as_ptr(),
            attribute_count: 1,
            propositions: self.propositions.as_ptr(),
            proposition_count: 1,
            objects: self.objects.as_ptr(),
            object_count: 4,
            actions: self.actions.as_ptr(),
            action_count: 2,
            tasks: self.tasks.as_ptr(),
            task_count: 1,
            state_count: 3,
            start: 0,
            next: self.next.as_ptr(),
            step: None,
            holds: Some(at_floor),
            derived: None,
            context: null_mut(),
            kinds: null(),
        }
    }
}

/// A robot of the caller's own, from its table.
pub fn of_table(table: &GoodbotTable) -> Result<Owned, GoodbotStatus> {
    of_table_in(table, small())
}

/// The same in memory of these capacities.
pub fn of_table_in(table: &GoodbotTable, capacities: GoodbotCapacities) -> Result<Owned, GoodbotStatus> {
    let bytes = unsafe { goodbot_table_size(&raw const capacities) };
    let mut owned = Owned { memory: vec![0; bytes.div_ceil(8)], bytes, capacities, robot: null_mut() };
    let memory = owned.memory.as_mut_ptr().cast();
    match unsafe { goodbot_init_table(memory, bytes, &raw const capacities, table, &raw mut owned.robot) } {
        GoodbotStatus::Ok => Ok(owned),
        status => Err(status),
    }
}
