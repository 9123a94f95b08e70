//! The meaning of each word, and words for derived facts.

use crate::robots;

use goodbot_capi::beliefs::*;
use goodbot_capi::home::*;
use goodbot_capi::robot::Goodbot;
use goodbot_capi::status::GoodbotStatus;
use goodbot_capi::table::description::GoodbotTable;
use goodbot_capi::table::init::goodbot_table_set_state;
use goodbot_capi::training::*;
use goodbot_capi::voice::{GoodbotSaid, goodbot_said};
use goodbot_capi::words::{goodbot_explain_on, goodbot_explain_word};
use robots::{Lift, Owned, hear_and_plan, in_homes, of_table, small};
use std::ffi::{CStr, CString, c_char, c_void};
use std::ptr::{null, null_mut};

/// A red room below, and two green rooms above it.
fn two_green_rooms() -> Owned {
    let owned = in_homes(small());
    let robot = owned.robot;
    unsafe {
        for status in [
            goodbot_home_begin(robot),
            goodbot_home_room(robot, c"room0".as_ptr(), 0, 0, 8, 4, c"red".as_ptr()),
            goodbot_home_room(robot, c"room1".as_ptr(), 0, 4, 4, 8, c"green".as_ptr()),
            goodbot_home_room(robot, c"room2".as_ptr(), 4, 4, 8, 8, c"green".as_ptr()),
            goodbot_home_door(robot, c"door0".as_ptr(), 2, 4, 2, 4),
            goodbot_home_door(robot, c"door1".as_ptr(), 6, 4, 6, 4),
            goodbot_home_agent(robot, c"agent0".as_ptr(), 4, 2),
            goodbot_home_build(robot),
        ] {
            assert_eq!(status, GoodbotStatus::Ok);
        }
    }
    owned
}

/// The task with this text, and its probability.
fn task(robot: *mut Goodbot, wanted: &str) -> (u32, f32) {
    let (mut text, mut probability) = ([0; 64], 0.0);
    for task in 0.. {
        unsafe {
            assert_eq!(goodbot_task_text(robot, task, text.as_mut_ptr(), 64), GoodbotStatus::Ok, "no task {wanted}");
            if CStr::from_ptr(text.as_ptr()).to_str() == Ok(wanted) {
                assert_eq!(goodbot_task_probability(robot, task, &raw mut probability), GoodbotStatus::Ok);
                return (task, probability);
            }
        }
    }
    unreachable!()
}

/// Shows the way to a room and lets the robot learn from it.
fn show(robot: *mut Goodbot, command: &CStr, x: i32, y: i32) {
    unsafe {
        assert_eq!(goodbot_home_place(robot, c"agent0".as_ptr(), 4, 2), GoodbotStatus::Ok);
        assert_eq!(goodbot_hear(robot, command.as_ptr()), GoodbotStatus::Ok);
        let (mut here_x, mut here_y, mut evidence) = (0, 0, 9);
        for _ in 0..20 {
            while goodbot_plan(robot, 50) == GoodbotStatus::Working {}
            assert_eq!(goodbot_home_where(robot, c"agent0".as_ptr(), &raw mut here_x, &raw mut here_y), GoodbotStatus::Ok);
            // North, south, east, west, and to rest at the goal.
            let action = if here_x < x {
                2
            } else if here_x > x {
                3
            } else if here_y < y {
                0
            } else {
                15
            };
            assert_eq!(goodbot_demonstration(robot, action, &raw mut evidence), GoodbotStatus::Ok);
        }
        assert_eq!(goodbot_finish(robot, null_mut()), GoodbotStatus::Ok);
        while goodbot_learn(robot, 1_000) == GoodbotStatus::Working {}
    }
}

/// A robot that was shown the green room twice, and then hears of a cellar, a word that is new to it.
fn after_a_lesson_it_hears_of_a_cellar() -> Owned {
    let owned = robots::at_home();
    for _ in 0..2 {
        show(owned.robot, c"go to the green room", 2, 6);
    }
    unsafe { assert_eq!(goodbot_home_place(owned.robot, c"agent0".as_ptr(), 4, 2), GoodbotStatus::Ok) };
    hear_and_plan(owned.robot, c"go to the green cellar");
    owned
}

/// Each word of the command with its most probable meaning and the share of that.
fn explained(robot: *mut Goodbot, task: u32) -> Vec<(String, String, f32)> {
    let (mut word, mut meaning, mut share) = ([0; 32], [0; 80], 9.0);
    let mut all = Vec::new();
    loop {
        let position = all.len() as u32;
        let status =
            unsafe { goodbot_explain_word(robot, task, position, 0, word.as_mut_ptr(), 32, meaning.as_mut_ptr(), 80, &raw mut share) };
        if status == GoodbotStatus::Unknown {
            return all;
        }
        assert_eq!(status, GoodbotStatus::Ok);
        let text = |text: &[std::ffi::c_char]| unsafe { CStr::from_ptr(text.as_ptr()) }.to_str().unwrap().to_owned();
        all.push((text(&word), text(&meaning), share));
    }
}

#[test]
fn where_it_is_switched_on_words_mean_where_a_room_is() {
    for (derived, least, most) in [(true, 0.6, 1.0), (false, 0.4, 0.55)] {
        let owned = two_green_rooms();
        unsafe { assert_eq!(goodbot_home_derived(owned.robot, derived), GoodbotStatus::Ok) };
        for _ in 0..5 {
            show(owned.robot, c"go left", 2, 6);
            show(owned.robot, c"go right", 6, 6);
        }
        unsafe { assert_eq!(goodbot_home_place(owned.robot, c"agent0".as_ptr(), 4, 2), GoodbotStatus::Ok) };
        hear_and_plan(owned.robot, c"go right");
        let (_, probability) = task(owned.robot, "agentInRoom(agent0,room2)");
        assert!((least..=most).contains(&probability), "derived: {derived}, {probability}");
    }
}

#[test]
fn each_word_is_explained_for_the_task_followed_and_for_any_other() {
    let owned = after_a_lesson_it_hears_of_a_cellar();
    let robot = owned.robot;
    let words = explained(robot, task(robot, "agentInRoom(agent0,room1)").0);
    let said: Vec<&str> = words.iter().map(|(word, ..)| word.as_str()).collect();
    assert_eq!(said, ["go", "to", "the", "green", "cellar"]);
    assert!(words.iter().take(4).any(|(_, meaning, _)| meaning == "goal of agentInRoom: colorGreen"), "{words:?}");
    assert!(words.iter().take(4).all(|&(.., share)| share > 0.0 && share <= 1.001), "{words:?}");
    assert_eq!((words[4].1.as_str(), words[4].2), ("never heard", 0.0));
    // Where another task is meant, no word names its room.
    let other = explained(robot, task(robot, "blockInRoom(block0,room1)").0);
    assert_ne!(other, words);
    assert!(other.iter().all(|(_, meaning, _)| meaning != "goal of agentInRoom: colorGreen"), "{other:?}");
    // The plan is as it was.
    let mut action = 99;
    unsafe { assert_eq!(goodbot_decide(robot, &raw mut action, null_mut()), GoodbotStatus::Ok) };
}

#[test]
fn all_meanings_of_a_word_are_told_the_most_probable_first() {
    let owned = after_a_lesson_it_hears_of_a_cellar();
    let robot = owned.robot;
    let (task, _) = task(robot, "agentInRoom(agent0,room1)");
    let (mut word, mut meaning, mut share) = ([0; 32], [0; 80], 0.0);
    let mut at = |position, rank| {
        let status =
            unsafe { goodbot_explain_word(robot, task, position, rank, word.as_mut_ptr(), 32, meaning.as_mut_ptr(), 80, &raw mut share) };
        (status == GoodbotStatus::Ok)
            .then(|| (unsafe { CStr::from_ptr(meaning.as_ptr()) }.to_str().unwrap().to_owned(), share))
            .ok_or(status)
    };
    for position in 0..4 {
        let meanings: Vec<(String, f32)> = (0..).map_while(|rank| at(position, rank).ok()).collect();
        assert!(meanings.len() > 2, "{meanings:?}");
        assert!(meanings.is_sorted_by(|(_, more), (_, less)| more >= less), "{meanings:?}");
        let all: f32 = meanings.iter().map(|(_, share)| share).sum();
        assert!((all - 1.0).abs() < 1e-3, "{meanings:?}");
        let different: std::collections::BTreeSet<&str> = meanings.iter().map(|(meaning, _)| meaning.as_str()).collect();
        assert_eq!(different.len(), meanings.len(), "{meanings:?}");
        assert_eq!(at(position, u32::MAX), Err(GoodbotStatus::Unknown));
    }
    assert_eq!(at(4, 0), Ok(("never heard".to_owned(), 0.0)));
    assert_eq!(at(4, 1), Err(GoodbotStatus::Unknown));
}

#[test]
fn a_command_is_explained_in_parts_to_the_same_bits_and_the_robot_plans_between_them() {
    let [at_once, in_parts] = [(), ()].map(|()| after_a_lesson_it_hears_of_a_cellar());
    let (task, other) = (task(at_once.robot, "agentInRoom(agent0,room1)").0, task(at_once.robot, "blockInRoom(block0,room1)").0);
    let robot = in_parts.robot;
    let expected = explained(at_once.robot, task);
    let mut parts = 0;
    unsafe {
        while goodbot_explain_on(robot, task, 1) == GoodbotStatus::Working {
            parts += 1;
            while goodbot_plan(robot, 1) == GoodbotStatus::Working {}
        }
        assert!(parts > 8, "{parts}");
        assert_eq!(explained(robot, task), expected);
        // A part for another task, and the same words heard again, begin anew.
        assert_eq!(goodbot_explain_on(robot, other, 1), GoodbotStatus::Working);
        assert_eq!(goodbot_explain_on(robot, task, 1), GoodbotStatus::Working);
        assert_eq!(goodbot_explain_on(robot, task, u32::MAX), GoodbotStatus::Ok);
        assert_eq!(explained(robot, task), expected);
        hear_and_plan(robot, c"go to the green cellar");
        assert_eq!(goodbot_explain_on(robot, task, 1), GoodbotStatus::Working);
        assert_eq!(explained(robot, task), expected);
        assert_eq!(goodbot_explain_on(robot, 99, 1), GoodbotStatus::Unknown);
        assert_eq!(goodbot_explain_on(null_mut(), 0, 1), GoodbotStatus::Null);
    }
}

unsafe extern "C" fn which_floor(_: *mut c_void, _: u32, object: u8, number: u32) -> *const c_char {
    match (object, number) {
        (1, 0) => c"lowest".as_ptr(),
        (3, 0) => c"highest".as_ptr(),
        (3, 1) => c"windy".as_ptr(),
        _ => null(),
    }
}

#[test]
fn words_mean_what_a_robot_of_one_s_own_says_of_its_objects() {
    for (derived, least, most) in [(Some(which_floor as _), 0.6, 1.0), (None, 0.2, 0.55)] {
        let mut lift = Lift::new();
        for floor in &mut lift.objects[1..] {
            floor.values[0] = c"office".as_ptr();
        }
        let owned = of_table(&GoodbotTable { derived, ..lift.table() }).unwrap();
        let robot = owned.robot;
        for (command, action) in [(c"go to the top", 0), (c"go to the ground", 1)].repeat(5) {
            unsafe {
                assert_eq!(goodbot_table_set_state(robot, 1), GoodbotStatus::Ok);
                assert_eq!(goodbot_hear(robot, command.as_ptr()), GoodbotStatus::Ok);
                let mut evidence = 9;
                for action in [action, 15, 15] {
                    while goodbot_plan(robot, 50) == GoodbotStatus::Working {}
                    assert_eq!(goodbot_demonstration(robot, action, &raw mut evidence), GoodbotStatus::Ok);
                }
                assert_eq!(goodbot_finish(robot, null_mut()), GoodbotStatus::Ok);
                while goodbot_learn(robot, 1_000) == GoodbotStatus::Working {}
            }
        }
        unsafe { assert_eq!(goodbot_table_set_state(robot, 1), GoodbotStatus::Ok) };
        hear_and_plan(robot, c"go to the top");
        let (_, probability) = task(robot, "liftAtFloor(lift0,floor2)");
        assert!((least..=most).contains(&probability), "derived: {}, {probability}", derived.is_some());
    }
}

#[test]
fn wrong_calls_are_refused() {
    let owned = robots::at_home();
    let (mut text, mut share) = ([0; 80], 0.0);
    let at = text.as_mut_ptr();
    unsafe {
        assert_eq!(goodbot_explain_word(null_mut(), 0, 0, 0, at, 80, at, 80, &raw mut share), GoodbotStatus::Null);
        assert_eq!(goodbot_home_derived(null_mut(), true), GoodbotStatus::Null);
        assert_eq!(goodbot_explain_word(owned.robot, 0, 0, 0, at, 80, at, 80, &raw mut share), GoodbotStatus::Unknown);
        hear_and_plan(owned.robot, c"go");
        assert_eq!(goodbot_explain_word(owned.robot, 99, 0, 0, at, 80, at, 80, &raw mut share), GoodbotStatus::Unknown);
        assert_eq!(goodbot_explain_word(owned.robot, 0, 1, 0, at, 80, at, 80, &raw mut share), GoodbotStatus::Unknown);
        assert_eq!(goodbot_explain_word(owned.robot, 0, 0, 0, at, 80, at, 3, &raw mut share), GoodbotStatus::Buffer);
        assert_eq!(goodbot_explain_word(owned.robot, 0, 0, 0, null_mut(), 80, at, 80, &raw mut share), GoodbotStatus::Null);
        assert_eq!(goodbot_explain_word(owned.robot, 0, 0, 0, at, 80, at, 80, null_mut()), GoodbotStatus::Null);
        assert_eq!(goodbot_home_begin(owned.robot), GoodbotStatus::Ok);
        assert_eq!(goodbot_home_derived(owned.robot, true), GoodbotStatus::NoWorld);
        let lift = Lift::new();
        let owned = of_table(&lift.table()).unwrap();
        assert_eq!(goodbot_home_derived(owned.robot, true), GoodbotStatus::World);
        let mut state = 9;
        assert_eq!(goodbot_capi::table::init::goodbot_table_state(owned.robot, &raw mut state), GoodbotStatus::Ok);
    }
}

#[test]
fn stop_is_known_without_a_table_and_nothing_else_is() {
    let owned = robots::at_home();
    let said = |words: &CStr, table: *const c_char| unsafe {
        let (mut said, mut answer) = (GoodbotSaid::Nothing, 0);
        let status = goodbot_said(owned.robot, words.as_ptr(), table, &raw mut said, &raw mut answer);
        assert_eq!(status, GoodbotStatus::Ok);
        said
    };
    for words in [c"stop", c"Stop!", c"halt", c"emergency stop"] {
        assert_eq!(said(words, null()), GoodbotSaid::Stop, "{words:?}");
    }
    // The beginning of a long text decides, and it ends between two words, and between two letters.
    for (words, meant) in [
        ("stop ".repeat(200), GoodbotSaid::Stop),
        ("go ".repeat(200) + "stop", GoodbotSaid::Command),
        ("\u{e4} ".repeat(100), GoodbotSaid::Command),
        (" \u{e4}".repeat(100), GoodbotSaid::Command),
    ] {
        assert_eq!(said(&CString::new(words.as_str()).unwrap(), null()), meant, "{words}");
    }
    for words in [c"stop at the red room", c"well done", c"do not move"] {
        assert_eq!(said(words, null()), GoodbotSaid::Command, "{words:?}");
    }
    let table = c"negation: not\nact: move\npolite: do";
    assert_eq!(said(c"do not move", table.as_ptr()), GoodbotSaid::Stop);
    assert_eq!(said(c"do not move the bag", table.as_ptr()), GoodbotSaid::Command);
    assert_eq!(said(c"stop", table.as_ptr()), GoodbotSaid::Command, "the table says which words stop");
    unsafe {
        for command in [c"go to the green room", c"go to the red room"] {
            assert_eq!(goodbot_hear(owned.robot, command.as_ptr()), GoodbotStatus::Ok);
            assert_eq!(goodbot_finish(owned.robot, null_mut()), GoodbotStatus::Ok);
            while goodbot_learn(owned.robot, 1_000) == GoodbotStatus::Working {}
        }
    }
    robots::hear_and_plan(owned.robot, c"go to the red room");
    for (words, meant) in [(c"the green room", GoodbotSaid::Command), (c"no", GoodbotSaid::Command), (c"stop", GoodbotSaid::Stop)] {
        assert_eq!(said(words, null()), meant, "{words:?} on the way");
    }
}
