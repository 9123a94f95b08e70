//! A robot that is told what is so already leaves it as it is.

use crate::robots;

use goodbot_capi::beliefs::*;
use goodbot_capi::capacities::{GOODBOT_OWN, GoodbotCapacities, goodbot_preset};
use goodbot_capi::robot::Goodbot;
use goodbot_capi::status::GoodbotStatus;
use goodbot_capi::table::description::*;
use goodbot_capi::table::init::{goodbot_table_set_state, goodbot_table_state};
use goodbot_capi::training::*;
use robots::{hear_and_plan, of_table_in};
use std::ffi::{CStr, c_char, c_void};
use std::ptr::{null, null_mut};

const SHELVES: u32 = 3;
const HELD: u32 = SHELVES;

/// A picker's shelf, and the place of the green and of the red bin: a shelf, or its hand.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Picker {
    at: u32,
    bins: [u32; 2],
}

impl Picker {
    fn of(number: u32) -> Self {
        Self { at: number % 3, bins: [number / 3 % 4, number / 12] }
    }

    fn number(self) -> u32 {
        self.at + 3 * (self.bins[0] + 4 * self.bins[1])
    }

    /// Up, down, grab green, grab red, release.
    fn after(mut self, action: u8) -> Option<Self> {
        let is_free = !self.bins.contains(&HELD);
        match action {
            0 if self.at + 1 < SHELVES => self.at += 1,
            1 if self.at > 0 => self.at -= 1,
            2 | 3 if is_free && self.bins[usize::from(action) - 2] == self.at => self.bins[usize::from(action) - 2] = HELD,
            4 if !is_free => self.bins = self.bins.map(|bin| if bin == HELD { self.at } else { bin }),
            _ => return None,
        }
        Some(self)
    }

    /// How many more actions it takes to bring a bin to a shelf, with the other one not in the hand.
    fn missing(self, bin: usize, shelf: u32) -> u32 {
        match self.bins[bin] {
            there if there == shelf => 0,
            HELD => self.at.abs_diff(shelf) + 1,
            there => self.at.abs_diff(there) + 1 + there.abs_diff(shelf) + 1,
        }
    }
}

unsafe extern "C" fn step(_: *mut c_void, state: u32, action: u8, next: *mut u32) -> bool {
    Picker::of(state).after(action).is_some_and(|after| {
        unsafe { next.write(after.number()) };
        true
    })
}

unsafe extern "C" fn holds(_: *mut c_void, state: u32, _: u8, arguments: *const u8) -> bool {
    let [bin, shelf] = unsafe { [*arguments, *arguments.add(1)] };
    Picker::of(state).bins[usize::from(bin)] == u32::from(shelf) - 2
}

unsafe fn lesson(robot: *mut Goodbot, command: &CStr, from: Picker, bin: usize, shelf: u32) {
    unsafe {
        assert_eq!(goodbot_table_set_state(robot, from.number()), GoodbotStatus::Ok);
        hear_and_plan(robot, command);
        let (mut rests, mut state, mut action, mut evidence) = (0, from.number(), 0, 0);
        while rests < 2 {
            let before = Picker::of(state).missing(bin, shelf);
            while goodbot_plan(robot, 1_000) == GoodbotStatus::Working {}
            assert_eq!(goodbot_decide(robot, &raw mut action, null_mut()), GoodbotStatus::Ok);
            assert_eq!(goodbot_acted(robot, action), GoodbotStatus::Ok);
            assert_eq!(goodbot_table_state(robot, &raw mut state), GoodbotStatus::Ok);
            let is_rest = before == 0 && action == GOODBOT_NOOP;
            let is_good = is_rest || Picker::of(state).missing(bin, shelf) < before;
            let word = if is_good { GOODBOT_REWARD } else { GOODBOT_PUNISH };
            assert_eq!(goodbot_feedback(robot, word, &raw mut evidence), GoodbotStatus::Ok);
            rests += u32::from(is_rest);
        }
        assert_eq!(goodbot_finish(robot, null_mut()), GoodbotStatus::Ok);
        while goodbot_learn(robot, 10_000) == GoodbotStatus::Working {}
    }
}

#[test]
fn a_bin_that_is_told_to_be_where_it_is_stays_there() {
    let text = |text: &'static CStr| text.as_ptr();
    let object =
        |object_class, name, value| GoodbotObject { object_class, name: text(name), values: [text(value), null(), null(), null()] };
    let objects = [
        object(0, c"bin0", c"green"),
        object(0, c"bin1", c"red"),
        object(1, c"shelf0", c"low"),
        object(1, c"shelf1", c"middle"),
        object(1, c"shelf2", c"high"),
    ];
    let carriers = [(0, c"binIs"), (1, c"shelfIs")].map(|(object_class, prefix)| GoodbotCarrier { object_class, prefix: text(prefix) });
    let attributes = [GoodbotAttribute { name: text(c"look"), carriers: carriers.as_ptr(), carrier_count: 2 }];
    let propositions = [GoodbotProposition { name: text(c"binOnShelf"), parameters: [0, 1, 0], parameter_count: 2 }];
    let actions = [c"up", c"down", c"green", c"red", c"release"].map(|name| GoodbotAction { name: text(name), cost: 1 });
    let (classes, tasks): ([*const c_char; 2], [*const c_char; 1]) = ([c"bin", c"shelf"].map(text), [text(c"binOnShelf(?b, ?s)")]);
    let table = GoodbotTable {
        classes: classes.as_ptr(),
        class_count: 2,
        attributes: attributes.as_ptr(),
        attribute_count: 1,
        propositions: propositions.as_ptr(),
        proposition_count: 1,
        objects: objects.as_ptr(),
        object_count: 5,
        actions: actions.as_ptr(),
        action_count: 5,
        tasks: tasks.as_ptr(),
        task_count: 1,
        state_count: 48,
        start: 0,
        next: null(),
        step: Some(step),
        holds: Some(holds),
        derived: None,
        context: null_mut(),
        kinds: null(),
    };
    let mut capacities = std::mem::MaybeUninit::<GoodbotCapacities>::uninit();
    assert_eq!(unsafe { goodbot_preset(GOODBOT_OWN, capacities.as_mut_ptr()) }, GoodbotStatus::Ok);
    let owned = of_table_in(&table, unsafe { capacities.assume_init() }).unwrap();
    let robot = owned.robot;
    let decided = |command: &CStr, now: Picker| unsafe {
        assert_eq!(goodbot_table_set_state(robot, now.number()), GoodbotStatus::Ok);
        hear_and_plan(robot, command);
        let (mut action, mut task, mut text) = (0, 0, [0; 64]);
        assert_eq!(goodbot_decide(robot, &raw mut action, null_mut()), GoodbotStatus::Ok);
        assert_eq!(goodbot_most_likely(robot, &raw mut task), GoodbotStatus::Ok);
        assert_eq!(goodbot_task_text(robot, task, text.as_mut_ptr(), text.len()), GoodbotStatus::Ok);
        assert_eq!(goodbot_forget(robot), GoodbotStatus::Ok);
        (action, CStr::from_ptr(text.as_ptr()).to_str().unwrap().to_owned())
    };
    unsafe {
        for _ in 0..2 {
            lesson(robot, c"put the green bin on the low shelf", Picker { at: 0, bins: [2, 1] }, 0, 0);
            lesson(robot, c"put the red bin on the high shelf", Picker { at: 1, bins: [1, 0] }, 1, 2);
            lesson(robot, c"put the green bin on the middle shelf", Picker { at: 2, bins: [0, 2] }, 0, 1);
        }
    }
    let (there, is_there) = (Picker { at: 2, bins: [2, 0] }, "binOnShelf(bin0,shelf2)".to_owned());
    assert_eq!(decided(c"put the green bin on the high shelf", there), (GOODBOT_NOOP, is_there.clone()));
    let (action, task) = decided(c"put the green bin on the high shelf", Picker { at: 1, bins: [1, 0] });
    assert_eq!((action, task), (2, is_there), "elsewhere it is fetched");
}
