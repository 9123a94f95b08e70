//! Several trainer strategies, through C.

use crate::robots;

use goodbot_capi::beliefs::{goodbot_most_likely, goodbot_task_text};
use goodbot_capi::robot::{Goodbot, goodbot_seed};
use goodbot_capi::status::GoodbotStatus;
use goodbot_capi::table::description::*;
use goodbot_capi::table::init::{goodbot_table_set_state, goodbot_table_state};
use goodbot_capi::training::*;
use robots::{Owned, at_home, hear_and_plan, of_table};
use std::ffi::{CStr, c_char, c_void};
use std::ptr::{null, null_mut};

const BALANCED: GoodbotStrategy =
    GoodbotStrategy { mu_plus: 0.7, mu_minus: 0.7, epsilon: 0.1, lags: [1.0, 0.0, 0.0], rests: [0.7, 0.7, 0.1, 0.0], prior: 0.5 };
const LATE: GoodbotStrategy = GoodbotStrategy { mu_minus: 0.05, lags: [0.0, 1.0, 0.0], rests: [0.7, 0.05, 0.1, 0.0], ..BALANCED };

#[test]
fn a_trainer_can_be_one_of_several() {
    let owned = at_home();
    let given = [BALANCED, LATE];
    unsafe {
        assert_eq!(goodbot_trainers(owned.robot, given.as_ptr(), 2), GoodbotStatus::Ok);
        hear_and_plan(owned.robot, c"go to the green room");
        let (mut action, mut evidence) = (0, 0);
        assert_eq!(goodbot_decide(owned.robot, &raw mut action, null_mut()), GoodbotStatus::Ok);
        assert_eq!(goodbot_acted(owned.robot, action), GoodbotStatus::Ok);
        assert_eq!(goodbot_feedback(owned.robot, GOODBOT_REWARD, &raw mut evidence), GoodbotStatus::Ok);
        assert_eq!(goodbot_finish(owned.robot, null_mut()), GoodbotStatus::Ok);
    }
}

#[test]
fn strategies_that_are_none_are_refused() {
    let owned = at_home();
    let refused = |given: &[GoodbotStrategy]| unsafe { goodbot_trainers(owned.robot, given.as_ptr(), given.len() as u32) };
    assert_eq!(refused(&[]), GoodbotStatus::Number);
    for wrong in [
        GoodbotStrategy { mu_plus: 1.5, ..BALANCED },
        GoodbotStrategy { epsilon: f32::NAN, ..BALANCED },
        GoodbotStrategy { lags: [0.5, 0.0, 0.0], ..BALANCED },
        GoodbotStrategy { prior: -1.0, ..BALANCED },
        GoodbotStrategy { prior: 0.0, ..BALANCED },
    ] {
        assert_eq!(refused(&[wrong]), GoodbotStatus::Number, "{wrong:?}");
    }
    // The small preset has room for three.
    assert_eq!(refused(&[BALANCED; 4]), GoodbotStatus::Full);
    assert_eq!(refused(&[BALANCED; GOODBOT_MOST_STRATEGIES + 1]), GoodbotStatus::Number);
    unsafe {
        assert_eq!(goodbot_trainers(owned.robot, null(), 1), GoodbotStatus::Null);
        assert_eq!(goodbot_trainers(null_mut(), &BALANCED, 1), GoodbotStatus::Null);
    }
}

/// A cart on a floor of four by four cells with five stations: all that its table points to.
const SIDE: u32 = 4;
const STATIONS: [(u32, &CStr, &CStr); 5] =
    [(0, c"s0", c"kitchen"), (3, c"s1", c"bath"), (6, c"s2", c"hall"), (12, c"s3", c"garage"), (15, c"s4", c"office")];

unsafe extern "C" fn at_station(_: *mut c_void, state: u32, _: u8, arguments: *const u8) -> bool {
    STATIONS[usize::from(unsafe { *arguments.add(1) }) - 1].0 == state
}

unsafe extern "C" fn drive(_: *mut c_void, state: u32, action: u8, next: *mut u32) -> bool {
    let (x, y) = (state % SIDE, state / SIDE);
    let to = match action {
        0 => (x, y + 1),
        1 => (x, y.wrapping_sub(1)),
        2 => (x + 1, y),
        _ => (x.wrapping_sub(1), y),
    };
    let is_floor = to.0 < SIDE && to.1 < SIDE;
    if is_floor {
        unsafe { next.write(to.1 * SIDE + to.0) };
    }
    is_floor
}

fn cart() -> Owned {
    fn kept<T, const N: usize>(items: [T; N]) -> *const T {
        Box::leak(Box::new(items)).as_ptr()
    }
    let carriers = kept([GoodbotCarrier { object_class: 1, prefix: c"stationIs".as_ptr() }]);
    let object = |object_class, name: &CStr, value: *const c_char| GoodbotObject {
        object_class,
        name: name.as_ptr(),
        values: [value, null(), null(), null()],
    };
    let [a, b, c, d, e] = STATIONS.map(|(_, name, value)| object(1, name, value.as_ptr()));
    let table = Box::leak(Box::new(GoodbotTable {
        classes: kept([c"cart", c"station"].map(CStr::as_ptr)),
        class_count: 2,
        attributes: kept([GoodbotAttribute { name: c"name".as_ptr(), carriers, carrier_count: 1 }]),
        attribute_count: 1,
        propositions: kept([GoodbotProposition { name: c"cartAt".as_ptr(), parameters: [0, 1, 0], parameter_count: 2 }]),
        proposition_count: 1,
        objects: kept([object(0, c"cart0", null()), a, b, c, d, e]),
        object_count: 6,
        actions: kept([c"north", c"south", c"east", c"west"].map(|name| GoodbotAction { name: name.as_ptr(), cost: 1 })),
        action_count: 4,
        tasks: kept([c"cartAt(?c, ?s)".as_ptr()]),
        task_count: 1,
        state_count: SIDE * SIDE,
        start: 9,
        next: null(),
        step: Some(drive),
        holds: Some(at_station),
        derived: None,
        context: null_mut(),
        kinds: null(),
    }));
    of_table(table).unwrap()
}

/// Who judges each step rightly: what is said to a right one, and to a wrong one.
type Words = (i32, i32);

unsafe fn lesson(robot: *mut Goodbot, command: &CStr, station: usize, start: u32, words: Words) {
    let ok = |status| assert_eq!(status, GoodbotStatus::Ok, "{command:?}");
    let goal = STATIONS[station].0;
    let distance = |state: u32| (state % SIDE).abs_diff(goal % SIDE) + (state / SIDE).abs_diff(goal / SIDE);
    unsafe {
        ok(goodbot_table_set_state(robot, start));
        ok(goodbot_hear(robot, command.as_ptr()));
        let (mut rests, mut steps) = (0, 0);
        while rests < 2 && steps < 20 {
            let (mut action, mut before, mut after, mut evidence) = (0, 0, 0, 0);
            while goodbot_plan(robot, 100) == GoodbotStatus::Working {}
            ok(goodbot_decide(robot, &raw mut action, null_mut()));
            ok(goodbot_table_state(robot, &raw mut before));
            ok(goodbot_acted(robot, action));
            ok(goodbot_table_state(robot, &raw mut after));
            let rests_there = before == goal && action == GOODBOT_NOOP;
            let right = rests_there || distance(after) < distance(before);
            // Silence is told too.
            ok(goodbot_feedback(robot, if right { words.0 } else { words.1 }, &raw mut evidence));
            rests = if rests_there { rests + 1 } else { 0 };
            steps += 1;
        }
        ok(goodbot_finish(robot, null_mut()));
        while goodbot_learn(robot, 1_000) == GoodbotStatus::Working {}
    }
}

/// How many of five commands, taught once each to twenty robots by such a trainer, are understood.
fn understood(words: Words, prepare: impl Fn(*mut Goodbot)) -> usize {
    const COMMANDS: [(&CStr, usize); 5] = [
        (c"go to the kitchen", 0),
        (c"wash yourself", 1),
        (c"come to the hall", 2),
        (c"park in the garage", 3),
        (c"drive to the office", 4),
    ];
    let mut right = 0;
    for seed in 0..20 {
        let owned = cart();
        let robot = owned.robot;
        prepare(robot);
        unsafe { assert_eq!(goodbot_seed(robot, seed), GoodbotStatus::Ok) };
        for (number, (command, station)) in (0..).zip(COMMANDS) {
            unsafe { lesson(robot, command, station, [9, 5, 10, 1, 14][number], words) };
        }
        for (command, station) in COMMANDS {
            let (mut task, mut text) = (0, [0; 40]);
            unsafe {
                assert_eq!(goodbot_table_set_state(robot, 8), GoodbotStatus::Ok);
                assert_eq!(goodbot_hear(robot, command.as_ptr()), GoodbotStatus::Ok);
                assert_eq!(goodbot_most_likely(robot, &raw mut task), GoodbotStatus::Ok);
                assert_eq!(goodbot_task_text(robot, task, text.as_mut_ptr(), text.len()), GoodbotStatus::Ok);
                let text = CStr::from_ptr(text.as_ptr()).to_str().unwrap();
                right += usize::from(text == format!("cartAt(cart0,s{station})"));
            }
        }
    }
    right
}

#[test]
fn one_button_is_enough() {
    let of = |words| understood(words, |_| ());
    let [both, praise, blame] =
        [(GOODBOT_REWARD, GOODBOT_PUNISH), (GOODBOT_REWARD, GOODBOT_NEUTRAL), (GOODBOT_NEUTRAL, GOODBOT_PUNISH)].map(of);
    assert!(both >= 99 && praise >= 95 && blame >= 95, "{both}, {praise} and {blame} of 100");
    // One that expects both words alone is not taught by one.
    let expects_both = |robot| unsafe { assert_eq!(goodbot_trainer(robot, 0.7, 0.7, 0.1), GoodbotStatus::Ok) };
    let praised = understood((GOODBOT_REWARD, GOODBOT_NEUTRAL), expects_both);
    assert!(praised < 70, "{praised} of 100");
}

#[test]
fn a_program_that_never_tells_silence_gets_a_remark() {
    let remark = |robot| unsafe {
        let mut text = null();
        assert_eq!(goodbot_remark(robot, &raw mut text), GoodbotStatus::Ok);
        CStr::from_ptr(text).to_str().unwrap()
    };
    let step = |robot, word: Option<i32>| unsafe {
        let (mut action, mut evidence) = (0, 0);
        while goodbot_plan(robot, 100) == GoodbotStatus::Working {}
        assert_eq!(goodbot_decide(robot, &raw mut action, null_mut()), GoodbotStatus::Ok);
        assert_eq!(goodbot_acted(robot, action), GoodbotStatus::Ok);
        if let Some(word) = word {
            assert_eq!(goodbot_feedback(robot, word, &raw mut evidence), GoodbotStatus::Ok);
        }
    };
    let owned = cart();
    hear_and_plan(owned.robot, c"go to the kitchen");
    for _ in 0..20 {
        step(owned.robot, None);
    }
    assert_eq!(remark(owned.robot), "", "perhaps nobody trains it");
    step(owned.robot, Some(GOODBOT_REWARD));
    assert!(remark(owned.robot).starts_with("silence is never told; call goodbot_feedback with GOODBOT_NEUTRAL"));
    step(owned.robot, Some(GOODBOT_NEUTRAL));
    assert_eq!(remark(owned.robot), "");
    assert_eq!(unsafe { goodbot_remark(owned.robot, null_mut()) }, GoodbotStatus::Null);
}
