//! The status of every misuse. `OTHER` is kept for later versions of the library.

use crate::robots;

use goodbot_capi::beliefs::*;
use goodbot_capi::capacities::GoodbotCapacity;
use goodbot_capi::home::*;
use goodbot_capi::memory::{goodbot_session_count, goodbot_size};
use goodbot_capi::model::*;
use goodbot_capi::parameters::{goodbot_restore_parameters, goodbot_save_parameters};
use goodbot_capi::robot::{goodbot_full, goodbot_seed};
use goodbot_capi::status::{GoodbotStatus, goodbot_status_text};
use goodbot_capi::table::description::*;
use goodbot_capi::table::init::{goodbot_table_set_state, goodbot_table_state};
use goodbot_capi::tasks::GOODBOT_MOST_TASKS;
use goodbot_capi::training::*;
use robots::{Lift, Owned, at_home, describe, hear_and_plan, in_homes, of_table, small};
use std::ffi::{CStr, CString, c_void};
use std::ptr::{null, null_mut};

const NOT_UTF_8: &CStr = c"\xff";

#[test]
fn a_command_heard_in_parts_has_an_end_that_is_soon_found() {
    let owned = at_home();
    let robot = owned.robot;
    let begin = |command: &str| unsafe { goodbot_begin_hearing(robot, CString::new(command).unwrap().as_ptr()) };
    let mut tasks = 0;
    unsafe {
        assert_eq!(goodbot_hear(robot, c"go to the green room".as_ptr()), GoodbotStatus::Ok);
        for long in ["a", " ", "go "] {
            assert_eq!(begin(&long.repeat(GOODBOT_MOST_COMMAND_BYTES + 1)), GoodbotStatus::Text);
        }
        assert_eq!(goodbot_begin_hearing(robot, NOT_UTF_8.as_ptr()), GoodbotStatus::Text);
        assert_eq!((goodbot_task_count(robot, &raw mut tasks), tasks > 0), (GoodbotStatus::Ok, true), "the session goes on");
        let space = " ".repeat(GOODBOT_MOST_COMMAND_BYTES - 2);
        for (command, status) in [(space.clone() + "go", GoodbotStatus::Ok), (space, GoodbotStatus::EmptyCommand)] {
            assert_eq!(begin(&command), GoodbotStatus::Ok);
            let (mut calls, mut heard) = (0, GoodbotStatus::Working);
            while heard == GoodbotStatus::Working {
                heard = goodbot_hear_on(robot, 1);
                calls += 1;
            }
            assert_eq!((heard, calls > 30), (status, true), "{calls} calls");
        }
    }
}

#[test]
fn every_function_refuses_a_null_handle() {
    let (mut number, mut bytes, mut x, mut action) = (0_u32, 0_usize, 0_i32, 0_u8);
    let (mut probability, mut text) = (0.0, [0; 8]);
    let nobody = null_mut();
    let answers = unsafe {
        [
            goodbot_home_begin(nobody),
            goodbot_home_room(nobody, c"r".as_ptr(), 0, 0, 4, 4, c"red".as_ptr()),
            goodbot_home_door(nobody, c"d".as_ptr(), 0, 0, 4, 4),
            goodbot_home_block(nobody, c"b".as_ptr(), 0, 0, c"red".as_ptr(), c"bag".as_ptr()),
            goodbot_home_agent(nobody, c"a".as_ptr(), 0, 0),
            goodbot_home_build(nobody),
            goodbot_home_place(nobody, c"a".as_ptr(), 0, 0),
            goodbot_home_where(nobody, c"a".as_ptr(), &raw mut x, &raw mut x),
            goodbot_table_set_state(nobody, 0),
            goodbot_table_state(nobody, &raw mut number),
            goodbot_trainer(nobody, 0.7, 0.7, 0.1),
            goodbot_hear(nobody, c"go".as_ptr()),
            goodbot_plan(nobody, 1),
            goodbot_decide(nobody, &raw mut action, null_mut()),
            goodbot_feedback(nobody, GOODBOT_REWARD, &raw mut number),
            goodbot_demonstration(nobody, 0, &raw mut number),
            goodbot_acted(nobody, 0),
            goodbot_finish(nobody, null_mut()),
            goodbot_forget(nobody),
            goodbot_learn(nobody, 1),
            goodbot_task_count(nobody, &raw mut number),
            goodbot_task_probability(nobody, 0, &raw mut probability),
            goodbot_most_likely(nobody, &raw mut number),
            goodbot_task_text(nobody, 0, text.as_mut_ptr(), text.len()),
            goodbot_saved_size(nobody, &raw mut bytes),
            goodbot_save(nobody, null_mut(), 0, &raw mut bytes),
            goodbot_restore(nobody, null(), 0),
            goodbot_save_parameters(nobody, null_mut(), 0, &raw mut bytes),
            goodbot_restore_parameters(nobody, null(), 0),
            goodbot_seed(nobody, 1),
            goodbot_full(nobody, text.as_mut_ptr(), text.len(), &raw mut number, &raw mut number),
        ]
    };
    assert!(answers.iter().all(|&answer| answer == GoodbotStatus::Null), "{answers:?}");
}

#[test]
fn every_function_refuses_a_null_place_for_its_answer() {
    let owned = at_home();
    hear_and_plan(owned.robot, c"go to the green room");
    let (mut x, mut bytes) = (0, 0);
    let answers = unsafe {
        [
            goodbot_task_count(owned.robot, null_mut()),
            goodbot_task_probability(owned.robot, 0, null_mut()),
            goodbot_most_likely(owned.robot, null_mut()),
            goodbot_task_text(owned.robot, 0, null_mut(), 10),
            goodbot_decide(owned.robot, null_mut(), null_mut()),
            goodbot_feedback(owned.robot, GOODBOT_REWARD, null_mut()),
            goodbot_demonstration(owned.robot, 0, null_mut()),
            goodbot_home_where(owned.robot, c"agent0".as_ptr(), null_mut(), &raw mut x),
            goodbot_home_where(owned.robot, c"agent0".as_ptr(), &raw mut x, null_mut()),
            goodbot_home_place(owned.robot, null(), 1, 1),
            goodbot_hear(owned.robot, null()),
            goodbot_saved_size(owned.robot, null_mut()),
            goodbot_save(owned.robot, null_mut(), 0, &raw mut bytes),
            goodbot_restore(owned.robot, null(), 10),
            goodbot_save_parameters(owned.robot, null_mut(), 0, &raw mut bytes),
            goodbot_restore_parameters(owned.robot, null(), 10),
        ]
    };
    assert!(answers.iter().all(|&answer| answer == GoodbotStatus::Null), "{answers:?}");
}

#[test]
fn texts_that_are_not_utf_8_are_refused() {
    let owned = in_homes(small());
    let robot = owned.robot;
    unsafe {
        assert_eq!(goodbot_home_begin(robot), GoodbotStatus::Ok);
        assert_eq!(goodbot_home_room(robot, NOT_UTF_8.as_ptr(), 0, 0, 4, 4, c"red".as_ptr()), GoodbotStatus::Text);
        assert_eq!(goodbot_home_room(robot, c"room0".as_ptr(), 0, 0, 4, 4, NOT_UTF_8.as_ptr()), GoodbotStatus::Text);
        assert_eq!(goodbot_home_door(robot, NOT_UTF_8.as_ptr(), 0, 0, 4, 4), GoodbotStatus::Text);
        assert_eq!(goodbot_home_agent(robot, NOT_UTF_8.as_ptr(), 1, 1), GoodbotStatus::Text);
        assert_eq!(describe(robot), GoodbotStatus::Ok);
        assert_eq!(goodbot_hear(robot, NOT_UTF_8.as_ptr()), GoodbotStatus::Text);
    }
    let mut lift = Lift::new();
    lift.tasks[0] = NOT_UTF_8.as_ptr();
    assert_eq!(of_table(&lift.table()).err(), Some(GoodbotStatus::Text));
    let mut lift = Lift::new();
    lift.objects[1].name = NOT_UTF_8.as_ptr();
    assert_eq!(of_table(&lift.table()).err(), Some(GoodbotStatus::Text));
}

#[test]
fn nothing_can_be_done_before_there_is_a_home() {
    let owned = in_homes(small());
    let robot = owned.robot;
    unsafe {
        assert_eq!(goodbot_home_room(robot, c"room0".as_ptr(), 0, 0, 4, 4, c"red".as_ptr()), GoodbotStatus::NoWorld);
        assert_eq!(goodbot_home_build(robot), GoodbotStatus::NoWorld);
        assert_eq!(goodbot_hear(robot, c"go".as_ptr()), GoodbotStatus::NoWorld);
        assert_eq!(goodbot_plan(robot, 1), GoodbotStatus::NoWorld);
        assert_eq!(goodbot_acted(robot, 0), GoodbotStatus::NoWorld);
        assert_eq!(goodbot_home_place(robot, c"agent0".as_ptr(), 1, 1), GoodbotStatus::NoWorld);
        assert_eq!(goodbot_home_begin(robot), GoodbotStatus::Ok);
        assert_eq!(goodbot_finish(robot, null_mut()), GoodbotStatus::NoWorld);
    }
}

#[test]
fn a_home_that_is_described_wrongly_is_refused_and_can_be_begun_again() {
    let owned = in_homes(small());
    let robot = owned.robot;
    unsafe {
        assert_eq!(goodbot_home_begin(robot), GoodbotStatus::Ok);
        assert_eq!(goodbot_home_room(robot, c"room0".as_ptr(), 0, 0, 1, 1, c"red".as_ptr()), GoodbotStatus::World);
        assert_eq!(goodbot_home_room(robot, c"".as_ptr(), 0, 0, 4, 4, c"red".as_ptr()), GoodbotStatus::World);
        assert_eq!(goodbot_home_build(robot), GoodbotStatus::World);
        // A description that failed is gone.
        assert_eq!(goodbot_home_build(robot), GoodbotStatus::NoWorld);
        assert_eq!(describe(robot), GoodbotStatus::Ok);
        assert_eq!(goodbot_home_room(robot, c"room9".as_ptr(), 0, 0, 4, 4, c"red".as_ptr()), GoodbotStatus::World);
        assert_eq!(goodbot_table_set_state(robot, 0), GoodbotStatus::World);
        let mut state = 0;
        assert_eq!(goodbot_table_state(robot, &raw mut state), GoodbotStatus::World);
    }
}

#[test]
fn a_description_begun_twice_begins_anew() {
    let owned = at_home();
    hear_and_plan(owned.robot, c"go to the green room");
    unsafe {
        assert_eq!(goodbot_home_begin(owned.robot), GoodbotStatus::Ok);
        assert_eq!(goodbot_home_begin(owned.robot), GoodbotStatus::Ok);
        assert_eq!(describe(owned.robot), GoodbotStatus::Ok);
        // The session ended with its home.
        assert_eq!(goodbot_plan(owned.robot, 1), GoodbotStatus::NoSession);
        let mut evidence = 0;
        assert_eq!(goodbot_feedback(owned.robot, GOODBOT_REWARD, &raw mut evidence), GoodbotStatus::NoSession);
    }
}

#[test]
fn a_stop_ends_the_session_unlearned_at_any_moment_or_says_that_it_comes_too_late() {
    let (mut ended, mut too_late) = (0, 0);
    for parts in 0..1_000 {
        let owned = at_home();
        let robot = owned.robot;
        let mut sessions = 9;
        hear_and_plan(robot, c"go to the green room");
        unsafe {
            assert_eq!(goodbot_begin_finishing(robot), GoodbotStatus::Ok);
            if (0..parts).any(|_| goodbot_finish_on(robot, 1, null_mut()) == GoodbotStatus::Ok) {
                assert!(ended > 1 && too_late > 0, "{ended} parts before, {too_late} when it was too late");
                return;
            }
            let status = goodbot_forget(robot);
            if status == GoodbotStatus::StillFinishing {
                too_late += 1;
                assert_eq!(goodbot_begin_hearing(robot, c"go".as_ptr()), GoodbotStatus::StillFinishing);
                assert_eq!(goodbot_trainer(robot, 0.7, 0.7, 0.1), GoodbotStatus::StillFinishing);
                assert_eq!(goodbot_home_begin(robot), GoodbotStatus::StillFinishing);
                while goodbot_finish_on(robot, 1, null_mut()) == GoodbotStatus::Working {}
            } else {
                ended += 1;
                assert_eq!(status, GoodbotStatus::Ok);
                assert_eq!(goodbot_finish_on(robot, 1, null_mut()), GoodbotStatus::NoSession);
            }
            assert_eq!(goodbot_session_count(robot, &raw mut sessions), GoodbotStatus::Ok);
            assert_eq!(sessions, u32::from(status == GoodbotStatus::StillFinishing), "after {parts} parts");
        }
    }
    panic!("the session does not end");
}

#[test]
fn a_session_is_led_in_its_order_and_every_step_out_of_it_is_named() {
    let owned = at_home();
    let robot = owned.robot;
    let (mut action, mut task, mut evidence) = (0, 0, 9);
    unsafe {
        assert_eq!(goodbot_plan(robot, 1), GoodbotStatus::NoSession);
        assert_eq!(goodbot_finish(robot, null_mut()), GoodbotStatus::NoSession);
        assert_eq!(goodbot_most_likely(robot, &raw mut task), GoodbotStatus::NoSession);
        assert_eq!(goodbot_hear(robot, c" , ".as_ptr()), GoodbotStatus::EmptyCommand);
        assert_eq!(goodbot_hear(robot, c"go to the green room".as_ptr()), GoodbotStatus::Ok);
        assert_eq!(goodbot_decide(robot, &raw mut action, null_mut()), GoodbotStatus::NotPlanned);
        assert_eq!(goodbot_acted(robot, 0), GoodbotStatus::NotPlanned);
        hear_and_plan(robot, c"go to the green room");
        assert_eq!(goodbot_feedback(robot, 2, &raw mut evidence), GoodbotStatus::Number);
        assert_eq!(goodbot_feedback(robot, GOODBOT_REWARD, &raw mut evidence), GoodbotStatus::NothingDone);
        for action in [4, 14, 16, 200, 255] {
            assert_eq!(goodbot_demonstration(robot, action, &raw mut evidence), GoodbotStatus::NotApplicable);
            assert_eq!(goodbot_acted(robot, action), GoodbotStatus::NotApplicable);
        }
        let mut plan = 9;
        assert_eq!(goodbot_decide(robot, &raw mut action, &raw mut plan), GoodbotStatus::Ok);
        assert_eq!(plan, GOODBOT_PLAN_TOWARD);
        assert_eq!(goodbot_acted(robot, action), GoodbotStatus::Ok);
        assert_eq!(goodbot_decide(robot, &raw mut action, &raw mut plan), GoodbotStatus::NotPlanned);
        assert_eq!(goodbot_feedback(robot, GOODBOT_REWARD, &raw mut evidence), GoodbotStatus::Ok);
        assert_eq!(evidence, GOODBOT_EVIDENCE_USED);
        while goodbot_plan(robot, 50) == GoodbotStatus::Working {}
        assert_eq!(goodbot_demonstration(robot, action, &raw mut evidence), GoodbotStatus::Ok);
        assert_eq!(
            (goodbot_feedback(robot, GOODBOT_REWARD, &raw mut evidence), evidence),
            (GoodbotStatus::NothingDone, GOODBOT_EVIDENCE_USED)
        );
        assert_eq!(goodbot_finish(robot, null_mut()), GoodbotStatus::Ok);
        assert_eq!(goodbot_learn(robot, 1), GoodbotStatus::Working);
        assert_eq!(goodbot_hear(robot, c"go".as_ptr()), GoodbotStatus::StillLearning);
        while goodbot_learn(robot, 1_000) == GoodbotStatus::Working {}
        assert_eq!(goodbot_hear(robot, c"go".as_ptr()), GoodbotStatus::Ok);
        assert_eq!(goodbot_forget(robot), GoodbotStatus::Ok);
        assert_eq!(goodbot_decide(robot, &raw mut action, null_mut()), GoodbotStatus::NoSession);
    }
}

#[test]
fn what_there_is_not_is_unknown() {
    let owned = at_home();
    let robot = owned.robot;
    let (mut x, mut y, mut probability, mut text) = (0, 0, 0.0, [0; 64]);
    unsafe {
        assert_eq!(goodbot_home_place(robot, c"block7".as_ptr(), 1, 1), GoodbotStatus::Unknown);
        assert_eq!(goodbot_home_where(robot, c"room0".as_ptr(), &raw mut x, &raw mut y), GoodbotStatus::Unknown);
        // In a wall, and where the block is.
        assert_eq!(goodbot_home_place(robot, c"agent0".as_ptr(), 0, 0), GoodbotStatus::Number);
        assert_eq!(goodbot_home_place(robot, c"agent0".as_ptr(), 6, 2), GoodbotStatus::Number);
        assert_eq!(goodbot_home_where(robot, c"agent0".as_ptr(), &raw mut x, &raw mut y), GoodbotStatus::Ok);
        assert_eq!((x, y), (4, 2));
        hear_and_plan(robot, c"go to the green room");
        assert_eq!(goodbot_task_probability(robot, 99, &raw mut probability), GoodbotStatus::Unknown);
        assert_eq!(goodbot_task_text(robot, 99, text.as_mut_ptr(), text.len()), GoodbotStatus::Unknown);
        let (mut limit, mut given) = (0, 0);
        assert_eq!(goodbot_full(robot, text.as_mut_ptr(), text.len(), &raw mut limit, &raw mut given), GoodbotStatus::Unknown);
        assert_eq!(goodbot_trainer(robot, 0.7, 1.5, 0.1), GoodbotStatus::Number);
        assert_eq!(goodbot_trainer(robot, f32::NAN, 0.7, 0.1), GoodbotStatus::Number);
    }
}

#[test]
fn a_text_fills_its_buffer_and_never_leaves_it() {
    let owned = at_home();
    hear_and_plan(owned.robot, c"go to the green room");
    let mut text = [0x55; 64];
    let whole = unsafe { goodbot_task_text(owned.robot, 0, text.as_mut_ptr(), text.len()) };
    assert_eq!(whole, GoodbotStatus::Ok);
    let length = unsafe { CStr::from_ptr(text.as_ptr()) }.to_bytes_with_nul().len();
    for room in 0..=length {
        let mut text = [0x55; 64];
        let status = unsafe { goodbot_task_text(owned.robot, 0, text.as_mut_ptr(), room) };
        assert_eq!(status, if room < length { GoodbotStatus::Buffer } else { GoodbotStatus::Ok });
        assert!(text[room..].iter().all(|&byte| byte == 0x55));
    }
}

#[test]
fn a_home_can_have_tasks_with_a_way_and_their_texts_tell_it() {
    let capacities = small();
    let bytes = unsafe { goodbot_size(&raw const capacities) };
    let mut owned = Owned { memory: vec![0; bytes.div_ceil(8)], bytes, capacities, robot: null_mut() };
    let mut init = |tasks: &[&CStr]| unsafe {
        let tasks: Vec<_> = tasks.iter().map(|task| task.as_ptr()).collect();
        let (memory, count) = (owned.memory.as_mut_ptr().cast(), tasks.len() as u32);
        goodbot_init_home_tasks(memory, bytes, &raw const capacities, tasks.as_ptr(), count, &raw mut owned.robot)
    };
    assert_eq!(init(&[c"agentInRoom(?a, ?goal) avoiding agentInRoom(?a, ?goal)"]), GoodbotStatus::TaskWay);
    assert_eq!(init(&[]), GoodbotStatus::Number, "a robot without tasks could be told nothing");
    assert_eq!(init(&[c"agentInRoom(?a, ?goal)"; GOODBOT_MOST_TASKS + 1]), GoodbotStatus::Number);
    assert_eq!(init(&[c"agentInRoom(?a, ?goal)", c"agentInRoom(?a, ?goal) through blockInRoom(?o, ?goal)"]), GoodbotStatus::Ok);
    let robot = owned.robot;
    assert_eq!(describe(robot), GoodbotStatus::Ok);
    hear_and_plan(robot, c"take the chair along to the green room");
    let mut count = 0;
    assert_eq!(unsafe { goodbot_task_count(robot, &raw mut count) }, GoodbotStatus::Ok);
    let texts: Vec<String> = (0..count)
        .map(|task| {
            let mut text = [0; 96];
            assert_eq!(unsafe { goodbot_task_text(robot, task, text.as_mut_ptr(), text.len()) }, GoodbotStatus::Ok);
            unsafe { CStr::from_ptr(text.as_ptr()) }.to_str().unwrap().to_owned()
        })
        .collect();
    for task in ["agentInRoom(agent0,room1)", "agentInRoom(agent0,room1) through blockInRoom(block0,room1)"] {
        assert!(texts.iter().any(|text| text == task), "{task}: {texts:?}");
    }
}

#[test]
fn nothing_to_do_is_no_task() {
    let lift = Lift::new();
    // There is a lift, but no floor.
    let owned = of_table(&GoodbotTable { object_count: 1, ..lift.table() }).unwrap();
    assert_eq!(unsafe { goodbot_hear(owned.robot, c"up".as_ptr()) }, GoodbotStatus::NoTask);
    assert_eq!(unsafe { goodbot_home_begin(owned.robot) }, GoodbotStatus::World);
}

#[test]
fn a_model_is_taken_over_whole_or_not_at_all() {
    let owned = at_home();
    let (robot, mut bytes, mut written) = (owned.robot, 0, 0);
    hear_and_plan(robot, c"go to the green room");
    unsafe {
        assert_eq!(goodbot_acted(robot, 0), GoodbotStatus::Ok);
        let mut evidence = 9;
        assert_eq!(goodbot_feedback(robot, GOODBOT_REWARD, &raw mut evidence), GoodbotStatus::Ok);
        assert_eq!(evidence, GOODBOT_EVIDENCE_USED);
        assert_eq!(goodbot_finish(robot, null_mut()), GoodbotStatus::Ok);
        while goodbot_learn(robot, 1_000) == GoodbotStatus::Working {}
        assert_eq!(goodbot_saved_size(robot, &raw mut bytes), GoodbotStatus::Ok);
        let mut model = vec![0; bytes];
        assert_eq!(goodbot_save(robot, model.as_mut_ptr(), bytes - 1, &raw mut written), GoodbotStatus::Buffer);
        assert_eq!(goodbot_save(robot, model.as_mut_ptr(), bytes, &raw mut written), GoodbotStatus::Ok);
        assert_eq!(written, bytes);
        for length in 0..bytes {
            assert_eq!(goodbot_restore(robot, model.as_ptr(), length), GoodbotStatus::BadModel);
        }
        assert_eq!(goodbot_restore(robot, model.as_ptr(), bytes), GoodbotStatus::Ok);
        let lift = Lift::new();
        let other = of_table(&lift.table()).unwrap();
        assert_eq!(goodbot_restore(other.robot, model.as_ptr(), bytes), GoodbotStatus::OtherDomain);
        let mut one_word = small();
        one_word.entries[GoodbotCapacity::Words as usize] = 1;
        let tight = in_homes(one_word);
        assert_eq!(goodbot_restore(tight.robot, model.as_ptr(), bytes), GoodbotStatus::Full);
    }
}

#[test]
fn parameters_are_taken_over_whole_or_not_at_all() {
    let owned = at_home();
    let (robot, mut bytes, mut file) = (owned.robot, 0, vec![0; 4_096]);
    hear_and_plan(robot, c"go to the green room");
    let probability = |robot| {
        let mut probability = 0.0;
        // Not word for word what the lesson had: only the robot with the lesson can recall it.
        hear_and_plan(robot, c"please go to the green room");
        assert_eq!(unsafe { goodbot_task_probability(robot, 0, &raw mut probability) }, GoodbotStatus::Ok);
        probability.to_bits()
    };
    unsafe {
        assert_eq!(goodbot_acted(robot, 0), GoodbotStatus::Ok);
        let mut evidence = 9;
        assert_eq!(goodbot_feedback(robot, GOODBOT_REWARD, &raw mut evidence), GoodbotStatus::Ok);
        assert_eq!(goodbot_finish(robot, null_mut()), GoodbotStatus::Ok);
        assert_eq!(goodbot_save_parameters(robot, file.as_mut_ptr(), file.len(), &raw mut bytes), GoodbotStatus::StillLearning);
        while goodbot_learn(robot, 1_000) == GoodbotStatus::Working {}
        assert_eq!(goodbot_save_parameters(robot, file.as_mut_ptr(), 10, &raw mut bytes), GoodbotStatus::Buffer);
        assert_eq!(goodbot_save_parameters(robot, file.as_mut_ptr(), bytes, &raw mut bytes), GoodbotStatus::Ok);
        let other = at_home();
        let before = probability(other.robot);
        for length in 0..bytes {
            assert_eq!(goodbot_restore_parameters(other.robot, file.as_ptr(), length), GoodbotStatus::BadModel);
        }
        assert_eq!(probability(other.robot), before);
        assert_eq!(goodbot_restore_parameters(other.robot, file.as_ptr(), bytes), GoodbotStatus::Ok);
        assert_eq!(probability(other.robot), probability(robot));
        let lift = Lift::new();
        let other = of_table(&lift.table()).unwrap();
        assert_eq!(goodbot_restore_parameters(other.robot, file.as_ptr(), bytes), GoodbotStatus::OtherDomain);
    }
}

#[test]
fn a_table_that_is_described_wrongly_is_refused() {
    let refused = |change: fn(&mut Lift, &mut GoodbotTable)| {
        let mut lift = Lift::new();
        let mut table = lift.table();
        change(&mut lift, &mut table);
        of_table(&table).err()
    };
    assert_eq!(refused(|_, _| {}), None);
    assert_eq!(refused(|_, table| table.classes = null()), Some(GoodbotStatus::Null));
    assert_eq!(refused(|_, table| table.holds = None), Some(GoodbotStatus::Null));
    assert_eq!(refused(|_, table| table.next = null()), Some(GoodbotStatus::Null));
    assert_eq!(refused(|_, table| table.class_count = 9), Some(GoodbotStatus::Number));
    assert_eq!(refused(|_, table| table.action_count = 16), Some(GoodbotStatus::Number));
    assert_eq!(refused(|_, table| table.start = 3), Some(GoodbotStatus::Number));
    assert_eq!(refused(|_, table| table.state_count = u32::MAX), Some(GoodbotStatus::Number));
    assert_eq!(refused(|_, table| table.state_count = 65_536), Some(GoodbotStatus::Number));
    assert_eq!(refused(|lift, _| lift.actions[1].cost = 0), Some(GoodbotStatus::Number));
    assert_eq!(refused(|lift, _| lift.actions[1].cost = 17), Some(GoodbotStatus::Number));
    assert_eq!(refused(|lift, _| lift.objects[1].object_class = 2), Some(GoodbotStatus::Unknown));
    assert_eq!(refused(|lift, _| lift.objects[2].name = c"floor0".as_ptr()), Some(GoodbotStatus::World));
    assert_eq!(refused(|lift, _| lift.tasks[0] = c"liftAtFloor(?l)".as_ptr()), Some(GoodbotStatus::TaskArguments));
    assert_eq!(refused(|_, table| (table.state_count, table.start) = (0, 0)), Some(GoodbotStatus::Number));
    assert_eq!(refused(|_, table| table.task_count = 0), Some(GoodbotStatus::Number));
    assert_eq!(refused(|lift, _| lift.tasks[0] = null()), Some(GoodbotStatus::Null));
}

#[test]
fn each_fault_of_a_task_s_text_has_a_status_and_a_sentence() {
    let faults: [(&CStr, _, &str); 5] = [
        (c"liftAtFloor(?l ?f", GoodbotStatus::TaskForm, "a task is not written as name(?a, ?b)"),
        (c"liftAtRoof(?l, ?f)", GoodbotStatus::TaskProposition, "a task names an unknown proposition"),
        (c"liftAtFloor(?l ?f)", GoodbotStatus::TaskArguments, "a task has a wrong number of arguments"),
        (c"liftAtFloor(?x, ?x)", GoodbotStatus::TaskClass, "a task's variable is of two classes"),
        (c"liftAtFloor(?l, ?f) avoiding liftAtFloor(?l, ?f)", GoodbotStatus::TaskWay, "a task's way says nothing, or is not known"),
    ];
    for (task, status, sentence) in faults {
        let mut lift = Lift::new();
        lift.tasks[0] = task.as_ptr();
        assert_eq!(of_table(&lift.table()).err(), Some(status));
        assert_eq!(unsafe { CStr::from_ptr(goodbot_status_text(status as i32)) }.to_str(), Ok(sentence));
    }
}

#[test]
fn states_out_of_a_table_s_range_are_refused() {
    let mut lift = Lift::new();
    let owned = of_table(&lift.table()).unwrap();
    assert_eq!(unsafe { goodbot_table_set_state(owned.robot, 3) }, GoodbotStatus::Number);
    lift.next[0] = 7;
    assert_eq!(of_table(&lift.table()).err(), Some(GoodbotStatus::Number));
    // A function that changes its answer later leads nowhere: the action cannot be done.
    unsafe extern "C" fn later_too_far(context: *mut c_void, state: u32, action: u8, next: *mut u32) -> bool {
        unsafe { next.write(if *context.cast::<bool>() { 7 } else { (state + 1) % 3 }) };
        action == 0
    }
    let mut too_far = false;
    let context = (&raw mut too_far).cast();
    let owned = of_table(&GoodbotTable { next: null(), step: Some(later_too_far), context, ..lift.table() }).unwrap();
    unsafe {
        hear_and_plan(owned.robot, c"to the roof");
        *context.cast::<bool>() = true;
        assert_eq!(goodbot_acted(owned.robot, 0), GoodbotStatus::NotApplicable);
        let mut state = 9;
        assert_eq!(goodbot_table_state(owned.robot, &raw mut state), GoodbotStatus::Ok);
        assert_eq!(state, 0);
    }
}

#[test]
fn every_status_has_a_sentence_of_its_own() {
    let sentence = |status| unsafe { CStr::from_ptr(goodbot_status_text(status)) }.to_str().unwrap();
    let mut all: Vec<&str> = (0..=GoodbotStatus::TaskWay as i32).map(sentence).collect();
    for status in [-1, GoodbotStatus::TaskWay as i32 + 1, i32::MIN, i32::MAX] {
        assert_eq!(sentence(status), "no such status");
    }
    all.sort_unstable();
    all.dedup();
    assert_eq!(all.len(), GoodbotStatus::TaskWay as usize + 1);
    assert!(!all.contains(&"no such status"));
}

#[test]
fn the_tasks_of_a_home_are_gone_when_another_is_described() {
    let owned = at_home();
    hear_and_plan(owned.robot, c"go to the green room");
    let (mut count, mut task, mut text) = (9, 9, [0; 64]);
    unsafe {
        assert_eq!(goodbot_home_begin(owned.robot), GoodbotStatus::Ok);
        assert_eq!((goodbot_task_count(owned.robot, &raw mut count), count), (GoodbotStatus::Ok, 0));
        assert_eq!(goodbot_most_likely(owned.robot, &raw mut task), GoodbotStatus::NoSession);
        assert_eq!(goodbot_task_text(owned.robot, 0, text.as_mut_ptr(), 64), GoodbotStatus::NoWorld);
    }
}
