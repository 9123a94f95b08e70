//! The robot among embassy's tasks: its timers, its buttons, its flash.

use super::board::{A, B, Board, Setup};
use super::lessons::until_done;
use goodbot::home::{Area, Cell};
use goodbot_course::Layout;
use goodbot_course::exercise::LESSONS;
use goodbot_course::layout::BlockPlan;

/// The robot's home.
const HOUSE: Layout = Layout {
    rooms: [Some((Area::new(0, 3, 6, 6), "red")), Some((Area::new(0, 0, 3, 3), "green")), Some((Area::new(3, 0, 6, 3), "blue")), None],
    doors: [Some(Cell::new(2, 3)), Some(Cell::new(4, 3)), None, None],
    agent: Cell::new(1, 5),
    blocks: [Some(BlockPlan { cell: Cell::new(3, 4), color: "yellow", shape: "chair" }), None],
};

pub fn a_lesson_is_given_by_buttons_and_outlives_the_battery(setup: &Setup) {
    let firmware = setup.embassy.as_ref().unwrap();
    let mut board = Board::with_file(setup, firmware, None);
    assert_eq!(board.line(), "nothing is stored");
    let exercise = LESSONS.iter().find(|exercise| exercise.command == "go to the green room").unwrap();
    assert_eq!(board.line(), format!("hears: {}", exercise.command));
    let act = |board: &mut Board| board.lines_to("did ").pop().unwrap();
    let judge = |board: &mut Board, correct| {
        let (button, word) = if correct { (B, "good") } else { (A, "bad") };
        board.button(button, true);
        assert_eq!(board.line(), word);
        board.button(button, false);
        board.wait_blinks(2);
    };
    until_done(&mut board, &HOUSE, exercise, act, judge);
    board.button(B, true);
    board.lines_to("good");
    board.button(A, true);
    assert!(board.lines_to("lessons 1").iter().all(|line| !line.starts_with("error")));
    let stored = board.lines_to("stored ").pop().unwrap();
    // The battery is empty and is replaced.
    let slots = board.slots();
    drop(board);
    let mut board = Board::with_file(setup, firmware, Some(&slots));
    assert_eq!(board.line(), stored.replace("stored", "stored:"));
    assert_eq!(board.line(), "lessons 1");
}
