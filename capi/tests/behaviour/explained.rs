//! Faults of a description are named, and a robot says how full it is.

use crate::robots;

use goodbot_capi::capacities::*;
use goodbot_capi::memory::*;
use goodbot_capi::robot::Goodbot;
use goodbot_capi::status::GoodbotStatus;
use goodbot_capi::table::description::*;
use goodbot_capi::table::init::goodbot_explain_table;
use goodbot_capi::training::*;
use robots::{Lift, at_home, hear_and_plan, small};
use std::ffi::{CStr, c_char, c_void};
use std::ptr::{null, null_mut};

/// The status for a table, and its explanation.
fn explained(table: &GoodbotTable, capacities: &GoodbotCapacities) -> (GoodbotStatus, String) {
    let bytes = unsafe { goodbot_table_size(capacities) };
    let mut memory = vec![0_u64; bytes.div_ceil(8)];
    let mut text = [0; 200];
    let status = unsafe { goodbot_explain_table(memory.as_mut_ptr().cast(), bytes, capacities, table, text.as_mut_ptr(), text.len()) };
    (status, unsafe { CStr::from_ptr(text.as_ptr()) }.to_str().unwrap().to_owned())
}

#[test]
fn nothing_is_said_of_a_table_that_is_right() {
    assert_eq!(explained(&Lift::new().table(), &small()), (GoodbotStatus::Ok, String::new()));
}

#[test]
fn what_is_wrong_is_named_by_list_item_field_and_number() {
    let said = |change: fn(&mut Lift, &mut GoodbotTable)| {
        let mut lift = Lift::new();
        let mut table = lift.table();
        change(&mut lift, &mut table);
        explained(&table, &small())
    };
    let (status, text) = said(|lift, _| lift.objects[2].object_class = 9);
    assert_eq!(status, GoodbotStatus::Unknown);
    assert!(text.starts_with("objects[2].object_class is 9 and must be from 0 to 1: "), "{text}");
    let (status, text) = said(|lift, _| lift.actions[1].cost = 40);
    assert_eq!(status, GoodbotStatus::Number);
    assert!(text.starts_with("actions[1].cost is 40 and must be from 1 to 16: "), "{text}");
    let (status, text) = said(|_, table| table.start = 3);
    assert_eq!(status, GoodbotStatus::Number);
    assert!(text.starts_with("start is 3 and must be from 0 to 2: "), "{text}");
    let (status, text) = said(|_, table| table.task_count = 9);
    assert_eq!(status, GoodbotStatus::Number);
    assert!(text.starts_with("task_count is 9 and must be from 1 to 8: "), "{text}");
    let (status, text) = said(|_, table| table.task_count = 0);
    assert_eq!(status, GoodbotStatus::Number);
    assert!(text.starts_with("task_count is 0 and must be from 1 to 8: "), "{text}");
    let (status, text) = said(|_, table| table.state_count = 0);
    assert_eq!(status, GoodbotStatus::Number);
    assert!(text.starts_with("state_count is 0 and must be from 1 to 65535: "), "{text}");
    let (status, text) = said(|lift, _| lift.tasks[0] = c"liftOnFloor(?l, ?f)".as_ptr());
    assert_eq!(status, GoodbotStatus::TaskProposition);
    assert_eq!(text, "tasks[0]: a task names an unknown proposition");
    let (status, text) = said(|_, table| table.holds = None);
    assert_eq!((status, text.as_str()), (GoodbotStatus::Null, "holds: a pointer is null that must not be"));
    let (status, text) = said(|lift, _| lift.objects[3].name = lift.objects[1].name);
    assert_eq!(status, GoodbotStatus::World);
    assert!(text.starts_with("objects[3].name: "), "{text}");
    let (status, text) = said(|lift, _| lift.carriers[0].object_class = 0);
    assert_eq!(status, GoodbotStatus::World);
    assert!(text.starts_with("objects[1].values, of an attribute that its class does not carry: "), "{text}");
}

#[test]
fn what_cannot_be_told_of_an_object_is_named_by_its_state() {
    unsafe extern "C" fn no_text(_: *mut c_void, state: u32, object: u8, number: u32) -> *const c_char {
        if (state, object, number) == (2, 1, 0) { c"\xff".as_ptr() } else { null() }
    }
    unsafe extern "C" fn too_long(_: *mut c_void, _: u32, _: u8, number: u32) -> *const c_char {
        if number == 0 { c"the-only-floor-from-which-one-can-see-the-whole-harbour".as_ptr() } else { null() }
    }
    unsafe extern "C" fn endless(_: *mut c_void, _: u32, _: u8, _: u32) -> *const c_char {
        c"more".as_ptr()
    }
    let lift = Lift::new();
    let of = |derived| explained(&GoodbotTable { derived, ..lift.table() }, &small());
    let (status, text) = of(Some(no_text));
    assert_eq!(status, GoodbotStatus::Text);
    assert!(text.starts_with("what derived gives in state[2]: "), "{text}");
    let (status, text) = of(Some(too_long));
    assert_eq!(status, GoodbotStatus::Number);
    assert!(text.starts_with("length of what derived gives in state[0] is 55 and must be from 1 to 46: "), "{text}");
    let (status, text) = of(Some(endless));
    assert_eq!(status, GoodbotStatus::Number);
    assert!(text.starts_with("what derived gives of an object in state[0] is 9 and must be from 0 to 8: "), "{text}");
}

#[test]
fn a_step_that_leads_to_no_state_is_named() {
    unsafe extern "C" fn too_far(_: *mut c_void, state: u32, action: u8, next: *mut u32) -> bool {
        unsafe { next.write(state + 2) };
        action == 1
    }
    let lift = Lift::new();
    let mut table = GoodbotTable { next: null(), step: Some(too_far), ..lift.table() };
    let (status, text) = explained(&table, &small());
    assert_eq!(status, GoodbotStatus::Number);
    assert!(text.starts_with("what step gives for state[1].down is 3 and must be from 0 to 2: "), "{text}");
    let next = [1, GOODBOT_CANNOT, 2, 0, GOODBOT_CANNOT, 7];
    (table.next, table.step) = (next.as_ptr(), None);
    let (status, text) = explained(&table, &small());
    assert_eq!(status, GoodbotStatus::Number);
    assert!(text.starts_with("next[5] is 7 and must be from 0 to 2: "), "{text}");
}

#[test]
fn a_full_table_is_named_with_what_it_holds() {
    let mut capacities = small();
    capacities.entries[GoodbotCapacity::Objects as usize] = 3;
    let (status, text) = explained(&Lift::new().table(), &capacities);
    assert_eq!(status, GoodbotStatus::Full);
    assert_eq!(text, "objects[3].name: objects holds 3 and 4 are needed; raise it");
    // The size that all objects need, though already the second has no room: raised once, the table fits.
    let mut capacities = small();
    capacities.entries[GoodbotCapacity::Names as usize] = 2;
    assert_eq!(explained(&Lift::new().table(), &capacities).1, "objects[1].name: names holds 2 and 7 are needed; raise it");
    capacities.entries[GoodbotCapacity::Names as usize] = 7;
    assert_eq!(explained(&Lift::new().table(), &capacities), (GoodbotStatus::Ok, String::new()));
    capacities.entries[GoodbotCapacity::NameBytes as usize] = 30;
    assert_eq!(explained(&Lift::new().table(), &capacities).1, "objects[3].name: name_bytes holds 30 and 37 are needed; raise it");
    capacities.entries[GoodbotCapacity::NameBytes as usize] = 37;
    assert_eq!(explained(&Lift::new().table(), &capacities), (GoodbotStatus::Ok, String::new()));
}

#[test]
fn a_text_without_room_is_refused() {
    let (lift, capacities) = (Lift::new(), small());
    let mut table = lift.table();
    table.start = 3;
    let bytes = unsafe { goodbot_table_size(&raw const capacities) };
    let mut memory = vec![0_u64; bytes.div_ceil(8)];
    let mut text = [0; 10];
    let mut explain = |text, room| unsafe {
        goodbot_explain_table(memory.as_mut_ptr().cast(), bytes, &raw const capacities, &raw const table, text, room)
    };
    assert_eq!(explain(text.as_mut_ptr(), text.len()), GoodbotStatus::Buffer);
    assert_eq!(explain(null_mut(), 200), GoodbotStatus::Null);
}

fn sessions(robot: *mut Goodbot) -> u32 {
    let mut count = u32::MAX;
    assert_eq!(unsafe { goodbot_session_count(robot, &raw mut count) }, GoodbotStatus::Ok);
    count
}

#[test]
fn sessions_are_counted_and_tables_say_how_full_they_are() {
    let owned = at_home();
    assert_eq!(sessions(owned.robot), 0);
    hear_and_plan(owned.robot, c"go to the green room");
    unsafe {
        let mut action = 0;
        assert_eq!(goodbot_decide(owned.robot, &raw mut action, null_mut()), GoodbotStatus::Ok);
        assert_eq!(goodbot_acted(owned.robot, action), GoodbotStatus::Ok);
        assert_eq!(goodbot_finish(owned.robot, null_mut()), GoodbotStatus::Ok);
        while goodbot_learn(owned.robot, 1_000) == GoodbotStatus::Working {}
    }
    assert_eq!(sessions(owned.robot), 1);
    let mut used = small();
    assert_eq!(unsafe { goodbot_usage(owned.robot, &raw mut used) }, GoodbotStatus::Ok);
    let entries = |capacity: GoodbotCapacity| used.entries[capacity as usize];
    assert_eq!((entries(GoodbotCapacity::Sessions), entries(GoodbotCapacity::Words), entries(GoodbotCapacity::Objects)), (1, 5, 5));
    assert!(used.entries.iter().zip(&small().entries).all(|(used, room)| used <= room), "{used:?}");
    unsafe {
        assert_eq!(goodbot_usage(owned.robot, null_mut()), GoodbotStatus::Null);
        assert_eq!(goodbot_usage(null_mut(), &raw mut used), GoodbotStatus::Null);
        assert_eq!(goodbot_session_count(owned.robot, null_mut()), GoodbotStatus::Null);
    }
}

#[test]
fn a_command_is_heard_again_only_where_the_session_began() {
    let owned = at_home();
    unsafe {
        assert_eq!(goodbot_hear_again(owned.robot), GoodbotStatus::NoSession);
        hear_and_plan(owned.robot, c"go to the green room");
        let mut action = 0;
        assert_eq!(goodbot_decide(owned.robot, &raw mut action, null_mut()), GoodbotStatus::Ok);
        assert_eq!(goodbot_acted(owned.robot, action), GoodbotStatus::Ok);
        assert_eq!(goodbot_hear_again(owned.robot), GoodbotStatus::NoSession);
        assert_eq!(goodbot_capi::home::goodbot_home_place(owned.robot, c"agent0".as_ptr(), 4, 2), GoodbotStatus::Ok);
        assert_eq!(goodbot_hear_again(owned.robot), GoodbotStatus::Ok);
        assert_eq!(goodbot_hear_again(null_mut()), GoodbotStatus::Null);
    }
}
