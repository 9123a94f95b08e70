//! A model in a flash whose power is cut: the older model or the newer one is left, and whole.

use crate::robots;

use goodbot_capi::beliefs::{goodbot_task_count, goodbot_task_probability};
use goodbot_capi::home::goodbot_home_place;
use goodbot_capi::memory::{GoodbotLessons, goodbot_least_capacities, goodbot_session_count};
use goodbot_capi::model::*;
use goodbot_capi::robot::Goodbot;
use goodbot_capi::status::GoodbotStatus;
use goodbot_capi::storage::*;
use goodbot_capi::table::description::*;
use goodbot_capi::table::init::goodbot_table_set_state;
use goodbot_capi::training::*;
use robots::{Lift, at_home, describe, hear_and_plan, in_homes, of_table, small};
use std::ffi::{CStr, c_void};
use std::ptr::{null, null_mut};

const START: usize = 256;
const SLOT: usize = 2_048;

/// A flash, and how many bytes it still writes and erases before its power goes.
struct Flash {
    bytes: Vec<u8>,
    power: usize,
}

impl Flash {
    fn new() -> Self {
        Self { bytes: vec![0x5a; START + 2 * SLOT], power: usize::MAX }
    }

    fn handle(&mut self) -> GoodbotFlash {
        GoodbotFlash {
            context: (self as *mut Self).cast(),
            read: Some(read),
            write: Some(write),
            erase: Some(erase),
            start: START as u32,
            slot_bytes: SLOT as u32,
        }
    }

    fn change(&mut self, at: usize, byte: impl Fn(u8) -> u8) -> bool {
        if self.power == 0 {
            return false;
        }
        self.power -= 1;
        self.bytes[at] = byte(self.bytes[at]);
        true
    }
}

unsafe extern "C" fn read(context: *mut c_void, at: u32, to: *mut u8, bytes: u32) -> bool {
    let flash = unsafe { &*context.cast::<Flash>() };
    let from = &flash.bytes[at as usize..(at + bytes) as usize];
    unsafe { to.copy_from_nonoverlapping(from.as_ptr(), from.len()) };
    true
}

unsafe extern "C" fn write(context: *mut c_void, at: u32, from: *const u8, bytes: u32) -> bool {
    let (flash, from) = unsafe { (&mut *context.cast::<Flash>(), std::slice::from_raw_parts(from, bytes as usize)) };
    assert!((at as usize).is_multiple_of(GOODBOT_FLASH_UNIT) && from.len().is_multiple_of(GOODBOT_FLASH_UNIT));
    // Writing clears bits, and sets none.
    from.iter().enumerate().all(|(offset, &new)| flash.change(at as usize + offset, |old| old & new))
}

unsafe extern "C" fn erase(context: *mut c_void, at: u32, bytes: u32) -> bool {
    let flash = unsafe { &mut *context.cast::<Flash>() };
    assert!((at as usize - START).is_multiple_of(SLOT) && bytes as usize == SLOT);
    (0..bytes).all(|offset| flash.change((at + offset) as usize, |_| 0xff))
}

fn learn(robot: *mut Goodbot, command: &CStr) {
    unsafe {
        assert_eq!(goodbot_home_place(robot, c"agent0".as_ptr(), 4, 2), GoodbotStatus::Ok);
        hear_and_plan(robot, command);
        let mut action = 0;
        assert_eq!(goodbot_decide(robot, &raw mut action, null_mut()), GoodbotStatus::Ok);
        assert_eq!(goodbot_acted(robot, action), GoodbotStatus::Ok);
        assert_eq!(goodbot_finish(robot, null_mut()), GoodbotStatus::Ok);
        while goodbot_learn(robot, 1_000) == GoodbotStatus::Working {}
    }
}

/// How many lessons a new robot finds in a flash; none where nothing is stored.
fn found(flash: &mut Flash) -> Option<u32> {
    let (owned, mut buffer, mut count) = (at_home(), vec![0; SLOT], 0);
    match unsafe { goodbot_load(owned.robot, &flash.handle(), buffer.as_mut_ptr(), buffer.len()) } {
        GoodbotStatus::NothingStored => return None,
        status => assert_eq!(status, GoodbotStatus::Ok),
    }
    while unsafe { goodbot_learn(owned.robot, 1_000) } == GoodbotStatus::Working {}
    assert_eq!(unsafe { goodbot_session_count(owned.robot, &raw mut count) }, GoodbotStatus::Ok);
    Some(count)
}

#[test]
fn a_power_cut_at_any_byte_leaves_the_older_model_or_the_newer_one() {
    let (owned, mut flash) = (at_home(), Flash::new());
    assert_eq!(found(&mut flash), None);
    learn(owned.robot, c"go to the green room");
    let mut stored = 0;
    assert_eq!(unsafe { goodbot_store(owned.robot, &flash.handle(), &raw mut stored) }, GoodbotStatus::Ok);
    assert!(stored > 100 && found(&mut flash) == Some(1));
    learn(owned.robot, c"take the chair to the green room");
    let before = flash.bytes.clone();
    let mut newest = 1;
    for power in 0.. {
        flash.bytes.clone_from(&before);
        flash.power = power;
        let status = unsafe { goodbot_store(owned.robot, &flash.handle(), null_mut()) };
        let whole = status == GoodbotStatus::Ok;
        assert!(whole || status == GoodbotStatus::Flash, "{status:?}");
        // Cuts at most bytes are alike; a robot is set up for some of them, and for all of the header.
        if power % 97 == 0 || power + 300 > SLOT + stored || whole {
            let now = found(&mut flash).unwrap();
            assert!(now >= newest && now <= 2, "{now} lessons after {newest}, cut at byte {power}");
            newest = now;
        }
        if whole {
            break;
        }
    }
    assert_eq!(newest, 2);
}

/// Stores a model in parts of this many bytes. Returns how it ended, and the number of parts.
fn store_in_parts(flash: &mut Flash, model: &[u8], budget: u32) -> (GoodbotStatus, u32) {
    let (mut storing, mut parts) = (GoodbotStoring { opaque: [0; 32] }, 0);
    unsafe {
        assert_eq!(goodbot_store_on(&raw mut storing, budget), GoodbotStatus::BadHandle);
        assert_eq!(goodbot_begin_storing(&raw mut storing, &flash.handle(), model.as_ptr(), model.len()), GoodbotStatus::Ok);
        loop {
            parts += 1;
            match goodbot_store_on(&raw mut storing, budget) {
                GoodbotStatus::Working => {}
                ended => return (ended, parts),
            }
        }
    }
}

#[test]
fn a_model_is_stored_in_parts_and_a_power_cut_between_or_in_them_leaves_a_whole_one() {
    let (owned, mut flash) = (at_home(), Flash::new());
    let saved = || {
        let (mut model, mut length) = (vec![0; SLOT], 0);
        unsafe { assert_eq!(goodbot_save(owned.robot, model.as_mut_ptr(), model.len(), &raw mut length), GoodbotStatus::Ok) };
        model.truncate(length);
        model
    };
    learn(owned.robot, c"go to the green room");
    let first = saved();
    assert_eq!(store_in_parts(&mut flash, &first, 1).0, GoodbotStatus::Ok);
    assert_eq!(found(&mut flash), Some(1));
    learn(owned.robot, c"take the chair to the green room");
    let model = saved();
    let (before, mut ended) = (flash.bytes.clone(), [false; 2]);
    for power in (0..).step_by(61) {
        flash.bytes.clone_from(&before);
        flash.power = power;
        let (status, parts) = store_in_parts(&mut flash, &model, 64);
        assert!(status == GoodbotStatus::Ok || status == GoodbotStatus::Flash, "{status:?}");
        let now = found(&mut flash).unwrap();
        ended[usize::from(now == 2)] = true;
        if status == GoodbotStatus::Ok {
            assert!(now == 2 && parts > 8, "{now} lessons after {parts} parts");
            break;
        }
    }
    assert_eq!(ended, [true; 2]);
    // The same bytes as at once.
    let mut other = Flash::new();
    other.bytes.clone_from(&before);
    unsafe { assert_eq!(goodbot_store(owned.robot, &other.handle(), null_mut()), GoodbotStatus::Ok) };
    flash.bytes.clone_from(&before);
    flash.power = usize::MAX;
    assert_eq!(store_in_parts(&mut flash, &model, u32::MAX).0, GoodbotStatus::Ok);
    assert!(flash.bytes == other.bytes);
    // What is no model, or too large, leaves the stored one.
    let mut wrong = model.clone();
    wrong[40] ^= 1;
    assert_eq!(store_in_parts(&mut flash, &wrong, 64).0, GoodbotStatus::BadModel);
    assert_eq!(store_in_parts(&mut flash, &[0; SLOT], 64).0, GoodbotStatus::Buffer);
    assert_eq!(found(&mut flash), Some(2));
}

#[test]
fn a_robot_in_the_least_capacities_loads_its_own_model() {
    let commands = [c"go to the green room", c"please walk over to the red one now", c"take the chair to the green room", c"red"];
    let (roomy, mut least) = (at_home(), small());
    let lessons = GoodbotLessons { sessions: 4, words_per_command: 8, different_words: 15, word_bytes: 57 };
    assert_eq!(unsafe { goodbot_least_capacities(roomy.robot, &raw const lessons, &raw mut least) }, GoodbotStatus::Ok);
    let (mut flash, mut buffer, mut count) = (Flash::new(), vec![0; SLOT], 0);
    let robots = [in_homes(least), in_homes(least)];
    robots.iter().for_each(|owned| assert_eq!(describe(owned.robot), GoodbotStatus::Ok));
    let [taught, restored] = robots.each_ref().map(|owned| owned.robot);
    commands.iter().for_each(|command| learn(taught, command));
    unsafe {
        assert_eq!(goodbot_store(taught, &flash.handle(), null_mut()), GoodbotStatus::Ok);
        for robot in [taught, restored] {
            assert_eq!(goodbot_load(robot, &flash.handle(), buffer.as_mut_ptr(), buffer.len()), GoodbotStatus::Ok);
            while goodbot_learn(robot, 1_000) == GoodbotStatus::Working {}
            assert_eq!(goodbot_session_count(robot, &raw mut count), GoodbotStatus::Ok);
            assert_eq!(count, 4);
        }
    }
}

/// The model that `goodbot learn` makes of the log that `goodbot example log` prints: the default learner, with its layer.
const OF_A_HOST: &[u8] = include_bytes!("../../../tests/tests/behaviour/format_3.model");

#[test]
fn a_robot_takes_back_what_a_host_taught_and_keeps_it_as_a_role_model() {
    let (owned, mut count, mut file, mut written) = (at_home(), 0, vec![0; SLOT], 0);
    let robot = owned.robot;
    unsafe {
        assert_eq!(goodbot_restore(robot, OF_A_HOST.as_ptr(), OF_A_HOST.len()), GoodbotStatus::Ok);
        while goodbot_learn(robot, 1_000) == GoodbotStatus::Working {}
        assert_eq!(goodbot_session_count(robot, &raw mut count), GoodbotStatus::Ok);
        assert_eq!(count, 4);
        assert_eq!(goodbot_save(robot, file.as_mut_ptr(), file.len(), &raw mut written), GoodbotStatus::Ok);
        assert_eq!(file[8..10], [2, 0]);
        assert_eq!(goodbot_restore(robot, file.as_ptr(), written), GoodbotStatus::Ok);
        // A model that was cut short is refused.
        let cut = OF_A_HOST.len() - 9;
        assert_eq!(goodbot_restore(robot, OF_A_HOST.as_ptr(), cut), GoodbotStatus::BadModel);
    }
}

#[test]
fn a_model_is_saved_and_comes_back_in_parts_as_at_once() {
    let robots = [at_home(), at_home()];
    let [taught, other] = robots.each_ref().map(|owned| owned.robot);
    [c"go to the green room", c"take the chair to the green room"].into_iter().for_each(|command| learn(taught, command));
    let (mut at_once, mut in_parts, mut length, mut parts) = (vec![0; SLOT], vec![7; SLOT], 0, 0);
    let mut saving = GoodbotSaving { opaque: [0; 16] };
    let mut restoring = GoodbotRestoring { opaque: [0; 80] };
    unsafe {
        assert_eq!(goodbot_save(taught, at_once.as_mut_ptr(), at_once.len(), &raw mut length), GoodbotStatus::Ok);
        assert_eq!(goodbot_save_on(taught, &raw mut saving, 1, &raw mut length), GoodbotStatus::BadHandle);
        assert_eq!(goodbot_begin_saving(&raw mut saving, in_parts.as_mut_ptr(), in_parts.len()), GoodbotStatus::Ok);
        while goodbot_save_on(taught, &raw mut saving, 1, &raw mut length) == GoodbotStatus::Working {
            parts += 1;
        }
        assert_eq!(in_parts, at_once);
        assert!(parts > 50, "{parts} parts");
        assert_eq!(goodbot_restore_on(other, &raw mut restoring, 1), GoodbotStatus::BadHandle);
        assert_eq!(goodbot_begin_restoring(&raw mut restoring, in_parts.as_ptr(), length), GoodbotStatus::Ok);
        let mut refused = 0;
        while goodbot_restore_on(other, &raw mut restoring, 1) == GoodbotStatus::Working {
            refused += usize::from(goodbot_hear(other, c"go".as_ptr()) == GoodbotStatus::StillRestoring);
        }
        assert!(refused > 20, "{refused} commands");
        while goodbot_learn(other, 1_000) == GoodbotStatus::Working {}
        assert_eq!(goodbot_save(other, in_parts.as_mut_ptr(), in_parts.len(), &raw mut length), GoodbotStatus::Ok);
        assert_eq!(in_parts, at_once);
        // A lesson in between spoils both.
        assert_eq!(goodbot_begin_saving(&raw mut saving, in_parts.as_mut_ptr(), in_parts.len()), GoodbotStatus::Ok);
        assert_eq!(goodbot_save_on(other, &raw mut saving, 1, &raw mut length), GoodbotStatus::Working);
        learn(other, c"go to the green room");
        assert_eq!(goodbot_save_on(other, &raw mut saving, 1, &raw mut length), GoodbotStatus::Changed);
        for (saving, restoring) in [(null_mut(), &raw mut restoring), (&raw mut saving, null_mut())] {
            let null = GoodbotStatus::Null;
            assert!(goodbot_save_on(other, saving, 1, &raw mut length) == null || goodbot_restore_on(other, restoring, 1) == null);
        }
        assert_eq!(goodbot_begin_saving(&raw mut saving, null_mut(), 1), GoodbotStatus::Null);
        assert_eq!(goodbot_begin_restoring(&raw mut restoring, std::ptr::null(), 1), GoodbotStatus::Null);
    }
}

#[test]
fn what_cannot_be_stored_or_loaded_says_why() {
    let (owned, mut flash, mut buffer) = (at_home(), Flash::new(), vec![0; SLOT]);
    let robot = owned.robot;
    let good = flash.handle();
    unsafe {
        assert_eq!(goodbot_store(null_mut(), &good, null_mut()), GoodbotStatus::Null);
        assert_eq!(goodbot_store(robot, null(), null_mut()), GoodbotStatus::Null);
        assert_eq!(goodbot_load(robot, &good, null_mut(), 0), GoodbotStatus::Null);
        for broken in [GoodbotFlash { read: None, ..good }, GoodbotFlash { write: None, ..good }, GoodbotFlash { erase: None, ..good }] {
            assert_eq!(goodbot_store(robot, &broken, null_mut()), GoodbotStatus::Null);
        }
        for wrong in [GoodbotFlash { start: 1, ..good }, GoodbotFlash { slot_bytes: 0, ..good }, GoodbotFlash { slot_bytes: 100, ..good }] {
            assert_eq!(goodbot_store(robot, &wrong, null_mut()), GoodbotStatus::Number);
        }
        let small = GoodbotFlash { slot_bytes: 256, ..good };
        assert_eq!(goodbot_store(robot, &small, null_mut()), GoodbotStatus::Buffer);
        learn(robot, c"go to the green room");
        assert_eq!(goodbot_store(robot, &good, null_mut()), GoodbotStatus::Ok);
        assert_eq!(goodbot_load(robot, &good, buffer.as_mut_ptr(), 10), GoodbotStatus::Buffer);
        hear_and_plan(robot, c"go to the green room");
        let mut action = 0;
        assert_eq!(goodbot_decide(robot, &raw mut action, null_mut()), GoodbotStatus::Ok);
        assert_eq!(goodbot_acted(robot, action), GoodbotStatus::Ok);
        assert_eq!(goodbot_finish(robot, null_mut()), GoodbotStatus::Ok);
        assert_eq!(goodbot_store(robot, &good, null_mut()), GoodbotStatus::StillLearning);
    }
}

unsafe extern "C" fn at_floor_or_idle(_: *mut c_void, state: u32, proposition: u8, arguments: *const u8) -> bool {
    match proposition {
        0 => u32::from(unsafe { *arguments.add(1) }) == state + 1,
        _ => state == 0,
    }
}

#[test]
fn an_update_that_adds_propositions_and_attributes_keeps_the_lessons() {
    let lift = Lift::new();
    let before = of_table(&lift.table()).unwrap();
    let judged = |robot, command: &CStr| unsafe {
        let (mut probabilities, mut count) = (vec![], 0);
        assert_eq!(goodbot_table_set_state(robot, 0), GoodbotStatus::Ok);
        assert_eq!(goodbot_hear(robot, command.as_ptr()), GoodbotStatus::Ok);
        assert_eq!(goodbot_task_count(robot, &raw mut count), GoodbotStatus::Ok);
        for task in 0..count {
            let mut probability = 0.0;
            assert_eq!(goodbot_task_probability(robot, task, &raw mut probability), GoodbotStatus::Ok);
            probabilities.push(probability);
        }
        probabilities
    };
    for command in [c"take me shopping", c"up to the roof"] {
        let (mut action, mut evidence) = (0, 0);
        unsafe {
            assert_eq!(goodbot_table_set_state(before.robot, 0), GoodbotStatus::Ok);
            hear_and_plan(before.robot, command);
            assert_eq!(goodbot_decide(before.robot, &raw mut action, null_mut()), GoodbotStatus::Ok);
            assert_eq!(goodbot_acted(before.robot, action), GoodbotStatus::Ok);
            assert_eq!(goodbot_feedback(before.robot, GOODBOT_REWARD, &raw mut evidence), GoodbotStatus::Ok);
            assert_eq!(goodbot_finish(before.robot, null_mut()), GoodbotStatus::Ok);
            while goodbot_learn(before.robot, 1_000) == GoodbotStatus::Working {}
        }
    }
    let (mut model, mut length) = (vec![0; SLOT], 0);
    assert_eq!(unsafe { goodbot_save(before.robot, model.as_mut_ptr(), model.len(), &raw mut length) }, GoodbotStatus::Ok);
    // The new version of the program knows a proposition and an attribute more.
    let propositions = [
        GoodbotProposition { name: c"liftAtFloor".as_ptr(), parameters: [0, 1, 0], parameter_count: 2 },
        GoodbotProposition { name: c"doorOpen".as_ptr(), parameters: [0, 0, 0], parameter_count: 1 },
    ];
    let attributes =
        [
            GoodbotAttribute { name: c"use".as_ptr(), carriers: null(), carrier_count: 1 },
            GoodbotAttribute { name: c"size".as_ptr(), carriers: null(), carrier_count: 0 },
        ]
        .map(|attribute| {
            if attribute.carrier_count == 1 { GoodbotAttribute { carriers: lift.carriers.as_ptr(), ..attribute } } else { attribute }
        });
    let updated = GoodbotTable {
        propositions: propositions.as_ptr(),
        proposition_count: 2,
        attributes: attributes.as_ptr(),
        attribute_count: 2,
        holds: Some(at_floor_or_idle),
        ..lift.table()
    };
    let after = of_table(&updated).unwrap();
    unsafe {
        assert_eq!(goodbot_restore(after.robot, model.as_ptr(), length), GoodbotStatus::Ok);
        while goodbot_learn(after.robot, 1_000) == GoodbotStatus::Working {}
    }
    assert_eq!(judged(after.robot, c"take me shopping"), judged(before.robot, c"take me shopping"));
    // In parts too.
    let in_parts = of_table(&updated).unwrap();
    let mut restoring = GoodbotRestoring { opaque: [0; 80] };
    unsafe {
        assert_eq!(goodbot_begin_restoring(&raw mut restoring, model.as_ptr(), length), GoodbotStatus::Ok);
        while goodbot_restore_on(in_parts.robot, &raw mut restoring, 1) == GoodbotStatus::Working {}
        assert_eq!(goodbot_restore_on(in_parts.robot, &raw mut restoring, 1), GoodbotStatus::Ok);
        // The program before the update does not know what the one after it learned.
        assert_eq!(goodbot_save(after.robot, model.as_mut_ptr(), model.len(), &raw mut length), GoodbotStatus::Ok);
        assert_eq!(goodbot_restore(before.robot, model.as_ptr(), length), GoodbotStatus::OtherDomain);
        // Nor one in which the new proposition stands first.
        let moved = [propositions[1], propositions[0]];
        let moved = of_table(&GoodbotTable { propositions: moved.as_ptr(), ..updated }).unwrap();
        assert_eq!(goodbot_restore(moved.robot, model.as_ptr(), length), GoodbotStatus::OtherDomain);
        // A model of a newer library is told from a damaged one.
        model[8] = 9;
        assert_eq!(goodbot_restore(after.robot, model.as_ptr(), length), GoodbotStatus::NewerFormat);
    }
}
