//! A robot of one's own that is no toy: a vacuum cleaner with 14 tasks and 1,920 states, taught sixteen commands.

use crate::robots;

use goodbot::task::TaskSet;
use goodbot_capi::beliefs::*;
use goodbot_capi::capacities::*;
use goodbot_capi::memory::*;
use goodbot_capi::robot::{Goodbot, goodbot_full};
use goodbot_capi::status::GoodbotStatus;
use goodbot_capi::table::description::*;
use goodbot_capi::table::init::{goodbot_table_set_state, goodbot_table_state};
use goodbot_capi::training::*;
use robots::{Owned, of_table_in};
use std::ffi::{CStr, c_char, c_void};
use std::ptr::{null, null_mut};

const ROOMS: u32 = 5;
const MODES: u32 = 3;
const FULL: u32 = 3;

/// Where it is, which rooms are dirty, its mode and its charge. Rooms are in a row, and the dock is in the first.
#[derive(Clone, Copy)]
struct Vacuum {
    room: u32,
    dirty: u32,
    mode: u32,
    charge: u32,
}

const START: Vacuum = Vacuum { room: 2, dirty: 31, mode: 0, charge: 2 };

impl Vacuum {
    fn of(number: u32) -> Self {
        Self { room: number % 5, dirty: number / 5 % 32, mode: number / 160 % 3, charge: number / 480 }
    }

    fn number(self) -> u32 {
        self.room + 5 * (self.dirty + 32 * (self.mode + 3 * self.charge))
    }

    fn is_docked(self) -> bool {
        self.room == 0 && self.charge == FULL
    }

    /// Left, right, clean, dock, next mode.
    fn after(self, action: u8) -> Option<Self> {
        match action {
            0 if self.room > 0 => Some(Self { room: self.room - 1, ..self }),
            1 if self.room + 1 < ROOMS => Some(Self { room: self.room + 1, ..self }),
            2 if self.charge > 0 => Some(Self { dirty: self.dirty & !(1 << self.room), charge: self.charge - 1, ..self }),
            3 if self.room == 0 => Some(Self { charge: FULL, ..self }),
            4 => Some(Self { mode: (self.mode + 1) % MODES, ..self }),
            _ => None,
        }
    }

    /// How many more actions the goal of a task takes.
    fn missing(self, task: (u32, u32)) -> u32 {
        match task {
            (0, room) => self.room.abs_diff(room),
            (1, room) if self.dirty & (1 << room) == 0 => 0,
            (1, room) if self.charge == 0 => self.room + 1 + room + 1,
            (1, room) => self.room.abs_diff(room) + 1,
            (2, mode) => (mode + MODES - self.mode) % MODES,
            _ if self.is_docked() => 0,
            _ => self.room + 1,
        }
    }
}

unsafe extern "C" fn step(_: *mut c_void, state: u32, action: u8, next: *mut u32) -> bool {
    Vacuum::of(state).after(action).is_some_and(|after| {
        unsafe { next.write(after.number()) };
        true
    })
}

unsafe extern "C" fn holds(_: *mut c_void, state: u32, proposition: u8, arguments: *const u8) -> bool {
    let (now, argument) = (Vacuum::of(state), |at| u32::from(unsafe { *arguments.add(at) }));
    match proposition {
        0 => now.room == argument(1) - 1,
        1 => now.dirty & (1 << (argument(0) - 1)) == 0,
        2 => now.mode == argument(1) - 6,
        _ => now.is_docked(),
    }
}

/// The vacuum cleaner in memory of these capacities. What its table points to stays for the rest of the program.
fn vacuum(capacities: GoodbotCapacities) -> Owned {
    fn kept<T, const N: usize>(items: [T; N]) -> *const T {
        Box::leak(Box::new(items)).as_ptr()
    }
    let text = |text: &'static CStr| text.as_ptr();
    let object = |object_class, name: &'static CStr, value: *const c_char| GoodbotObject {
        object_class,
        name: name.as_ptr(),
        values: [value, null(), null(), null()],
    };
    let proposition =
        |name: &'static CStr, parameters, parameter_count| GoodbotProposition { name: name.as_ptr(), parameters, parameter_count };
    let carriers =
        kept([(1, c"roomIs"), (2, c"modeIs")].map(|(object_class, prefix)| GoodbotCarrier { object_class, prefix: prefix.as_ptr() }));
    let table = Box::leak(Box::new(GoodbotTable {
        classes: kept([c"vacuum", c"room", c"mode"].map(text)),
        class_count: 3,
        attributes: kept([GoodbotAttribute { name: c"name".as_ptr(), carriers, carrier_count: 2 }]),
        attribute_count: 1,
        propositions: kept([
            proposition(c"vacuumIn", [0, 1, 0], 2),
            proposition(c"roomClean", [1, 0, 0], 1),
            proposition(c"inMode", [0, 2, 0], 2),
            proposition(c"docked", [0, 0, 0], 1),
        ]),
        proposition_count: 4,
        objects: kept([
            object(0, c"vac", null()),
            object(1, c"r0", c"hall".as_ptr()),
            object(1, c"r1", c"kitchen".as_ptr()),
            object(1, c"r2", c"bath".as_ptr()),
            object(1, c"r3", c"bedroom".as_ptr()),
            object(1, c"r4", c"office".as_ptr()),
            object(2, c"m0", c"quiet".as_ptr()),
            object(2, c"m1", c"turbo".as_ptr()),
            object(2, c"m2", c"mop".as_ptr()),
        ]),
        object_count: 9,
        actions: kept([c"left", c"right", c"clean", c"dock", c"mode"].map(|name| GoodbotAction { name: name.as_ptr(), cost: 1 })),
        action_count: 5,
        tasks: kept([c"vacuumIn(?v, ?r)", c"roomClean(?r)", c"inMode(?v, ?m)", c"docked(?v)"].map(text)),
        task_count: 4,
        state_count: 1_920,
        start: START.number(),
        next: null(),
        step: Some(step),
        holds: Some(holds),
        derived: None,
        context: null_mut(),
        kinds: null(),
    }));
    of_table_in(table, capacities).unwrap()
}

/// Sixteen commands, with the kind of the task that is meant and which room or mode.
const LESSONS: [(&CStr, (u32, u32)); 16] = [
    (c"go to the kitchen", (0, 1)),
    (c"clean the hall", (1, 0)),
    (c"use the turbo mode", (2, 1)),
    (c"go back to your dock", (3, 0)),
    (c"drive to the office please", (0, 4)),
    (c"clean the bedroom now", (1, 3)),
    (c"switch to the mop mode", (2, 2)),
    (c"go to the hall", (0, 0)),
    (c"please clean the bath", (1, 2)),
    (c"go to the bedroom", (0, 3)),
    (c"clean up the office", (1, 4)),
    (c"charge at your dock", (3, 0)),
    (c"use the mop mode", (2, 2)),
    (c"clean the hall again", (1, 0)),
    (c"drive to the kitchen", (0, 1)),
    (c"switch to the turbo mode", (2, 1)),
];

/// Commands after the lessons, and their tasks.
const SAID: [(&CStr, &str); 5] = [
    (c"clean the kitchen", "roomClean(r1)"),
    (c"go to the office", "vacuumIn(vac,r4)"),
    (c"please use the turbo mode", "inMode(vac,m1)"),
    (c"back to your dock", "docked(vac)"),
    (c"clean the office", "roomClean(r4)"),
];

/// Teaches a lesson. Returns the number of older ones that were dropped.
unsafe fn lesson(robot: *mut Goodbot, command: &CStr, task: (u32, u32)) -> u32 {
    let ok = |status| assert_eq!(status, GoodbotStatus::Ok, "{command:?}");
    let (mut action, mut evidence, mut number, mut gave_way) = (0, 0, 0, 0);
    unsafe {
        ok(goodbot_table_set_state(robot, START.number()));
        ok(goodbot_hear(robot, command.as_ptr()));
        for _ in 0..20 {
            while goodbot_plan(robot, 500) == GoodbotStatus::Working {}
            ok(goodbot_decide(robot, &raw mut action, null_mut()));
            ok(goodbot_table_state(robot, &raw mut number));
            let now = Vacuum::of(number);
            let is_there = now.missing(task) == 0;
            let good = if is_there {
                action == GOODBOT_NOOP
            } else {
                now.after(action).is_some_and(|next| next.missing(task) < now.missing(task))
            };
            ok(goodbot_acted(robot, action));
            ok(goodbot_feedback(robot, if good { GOODBOT_REWARD } else { GOODBOT_PUNISH }, &raw mut evidence));
            if is_there && good {
                break;
            }
        }
        ok(goodbot_finish(robot, &raw mut gave_way));
        while goodbot_learn(robot, 10_000) == GoodbotStatus::Working {}
    }
    gave_way
}

fn understood(robot: *mut Goodbot, command: &CStr) -> String {
    let (mut task, mut text) = (0, [0; 48]);
    unsafe {
        assert_eq!(goodbot_table_set_state(robot, START.number()), GoodbotStatus::Ok);
        assert_eq!(goodbot_hear(robot, command.as_ptr()), GoodbotStatus::Ok);
        assert_eq!(goodbot_most_likely(robot, &raw mut task), GoodbotStatus::Ok);
        assert_eq!(goodbot_task_text(robot, task, text.as_mut_ptr(), text.len()), GoodbotStatus::Ok);
        CStr::from_ptr(text.as_ptr()).to_str().unwrap().to_owned()
    }
}

fn preset(preset: u32) -> GoodbotCapacities {
    let mut capacities = robots::small();
    assert_eq!(unsafe { goodbot_preset(preset, &raw mut capacities) }, GoodbotStatus::Ok);
    capacities
}

/// Teaches the lessons in order. Returns the number of older ones that were dropped.
fn teach(robot: *mut Goodbot, lessons: impl IntoIterator<Item = (&'static CStr, (u32, u32))>) -> u32 {
    lessons.into_iter().map(|(command, task)| unsafe { lesson(robot, command, task) }).sum()
}

fn sessions(robot: *mut Goodbot) -> u32 {
    let mut count = 0;
    assert_eq!(unsafe { goodbot_session_count(robot, &raw mut count) }, GoodbotStatus::Ok);
    count
}

/// In one build with programs for hosts, task sets are as wide as theirs and take more.
const FOR_HOSTS: bool = TaskSet::MOST > TaskSet::MOST_OF_ONE_WORD;

#[test]
fn the_preset_for_a_robot_of_ones_own_keeps_every_lesson() {
    let bytes = if cfg!(target_pointer_width = "64") { GOODBOT_OWN_BYTES_64 } else { GOODBOT_OWN_BYTES_32 };
    let owned = vacuum(preset(GOODBOT_OWN));
    assert!(owned.bytes <= bytes || FOR_HOSTS, "{}", owned.bytes);
    assert_eq!((teach(owned.robot, LESSONS), sessions(owned.robot)), (0, 16));
    for (command, task) in SAID {
        assert_eq!(understood(owned.robot, command), task, "{command:?}");
    }
    assert_eq!((teach(owned.robot, LESSONS.into_iter().take(8)), sessions(owned.robot)), (0, 24));
}

#[test]
fn a_lesson_that_gives_way_names_the_table_that_was_full() {
    let owned = vacuum(preset(GOODBOT_SMALL));
    let (mut name, mut limit, mut given) = ([0; 32], 0, 0);
    let mut full = || unsafe { goodbot_full(owned.robot, name.as_mut_ptr(), name.len(), &raw mut limit, &raw mut given) };
    assert_eq!(full(), GoodbotStatus::Unknown);
    assert!(teach(owned.robot, LESSONS) > 0);
    assert_eq!(full(), GoodbotStatus::Ok);
    assert_eq!(unsafe { CStr::from_ptr(name.as_ptr()) }, c"alignments");
    assert_eq!((limit, given), (owned.capacities.entries[GoodbotCapacity::Alignments as usize], limit + 1));
}

#[test]
fn what_a_robot_used_on_a_host_is_enough_on_a_controller() {
    let roomy = vacuum(preset(GOODBOT_STANDARD));
    let mut used = robots::small();
    assert_eq!(teach(roomy.robot, LESSONS), 0);
    unsafe {
        // The last command has fewer tasks than the lessons: all rooms are clean.
        assert_eq!(goodbot_table_set_state(roomy.robot, Vacuum { dirty: 0, ..START }.number()), GoodbotStatus::Ok);
        assert_eq!(goodbot_hear(roomy.robot, c"go to the hall".as_ptr()), GoodbotStatus::Ok);
        assert_eq!(goodbot_usage(roomy.robot, &raw mut used), GoodbotStatus::Ok);
    }
    let owned = vacuum(used);
    assert!(owned.bytes < GOODBOT_OWN_BYTES_64 || FOR_HOSTS, "{}", owned.bytes);
    assert_eq!((teach(owned.robot, LESSONS), sessions(owned.robot)), (0, 16));
    for (command, task) in SAID {
        assert_eq!(understood(owned.robot, command), task, "{command:?}");
    }
}
