//! The tests. The trainer finds the right actions by a robot of its own, which is told the meaning of each command.

use super::board::{A, B, Board, Looks, SLOTS_BYTES, Setup, folder};
use goodbot::feedback::Strategy;
use goodbot::home::{Area, Cell, HomeState};
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Action, Domain};
use goodbot::planning::OptimalSet;
use goodbot::storage::SLOT_HEADER_BYTES;
use goodbot::{Agent, Capacities, Options, home};
use goodbot_course::exercise::{Exercise, Intention, LESSONS, TESTS};
use goodbot_course::{CourseTrainer, Homes, Layout, generator, run_course};
use goodbot_formats::environment::{EnvironmentFile, ObjectRecord};
use std::process::Command;
use std::time::{Duration, Instant};

goodbot::memory! { struct Memory = Capacities::SMALL; }
goodbot::memory! { struct TinyMemory = Capacities::TINY; }

/// The most actions of a lesson.
const MOST_ACTIONS: usize = 100;

/// Describes a home to the board.
fn describe(board: &mut Board, layout: &Layout) {
    board.must("begin");
    for (number, (area, color)) in layout.rooms.iter().flatten().enumerate() {
        board.must(&format!("room room{number} {} {} {} {} {color}", area.left, area.bottom, area.right, area.top));
    }
    for (number, Cell { x, y }) in layout.doors.iter().flatten().enumerate() {
        board.must(&format!("door door{number} {x} {y} {x} {y}"));
    }
    for (number, block) in layout.blocks.iter().flatten().enumerate() {
        board.must(&format!("block block{number} {} {} {} {}", block.cell.x, block.cell.y, block.color, block.shape));
    }
    board.must(&format!("agent agent0 {} {}", layout.agent.x, layout.agent.y));
    board.must("build");
}

/// The intended task, as the board writes it.
fn meant(layout: &Layout, intention: &Intention) -> String {
    let room = layout.rooms.iter().flatten().position(|(_, color)| *color == intention.room).unwrap();
    match intention.block {
        None => format!("agentInRoom(agent0,room{room})"),
        Some((color, shape)) => {
            let block = layout.blocks.iter().flatten().position(|block| (block.color, block.shape) == (color, shape)).unwrap();
            format!("blockInRoom(block{block},room{room})")
        }
    }
}

/// The most likely task of an answer.
fn believed(answer: &[String]) -> &str {
    answer.iter().find_map(|line| line.strip_prefix("believes ")?.split_once(" % ")).unwrap_or_else(|| panic!("{answer:?}")).1
}

/// Teaches a lesson: judges each action until the robot has correctly rested three times.
fn teach(board: &mut Board, exercise: &Exercise) {
    let layout = Homes::FIXED.layout(exercise.home);
    describe(board, layout);
    board.must(&format!("say {}", exercise.command));
    let act = |board: &mut Board| board.must("act").into_iter().find(|line| line.starts_with("did ")).unwrap();
    let judge = |board: &mut Board, correct| drop(board.must(if correct { "good" } else { "bad" }));
    until_done(board, layout, exercise, act, judge);
    board.must("finish");
}

/// Judges one action after another until the robot has correctly rested three times.
pub fn until_done(
    board: &mut Board,
    layout: &Layout,
    exercise: &Exercise,
    act: impl Fn(&mut Board) -> String,
    judge: impl Fn(&mut Board, bool),
) {
    let mut memory = Memory::new();
    let (home, mut state) = layout.build(&mut memory.home).unwrap();
    let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks().unwrap(), Options::DEFAULT).unwrap();
    let intended = exercise.pose(&mut agent, &home, &state).unwrap().unwrap();
    let mut rests = 0;
    for _ in 0..MOST_ACTIONS {
        agent.plan_fully(&home, &state).unwrap();
        let right = agent.planned().optimal(intended);
        let did = act(board);
        let (name, where_things_are) = did.strip_prefix("did ").and_then(|did| did.split_once(';')).unwrap_or_else(|| panic!("{did}"));
        let action = action(&home, name);
        let correct = right.exact().or(right.onward()).is_some_and(|actions| actions.contains(action));
        state = agent.acted(&home, &state, action).unwrap();
        assert_eq!(where_things_are, places(&home, &state), "the board and this machine move the robot alike");
        judge(board, correct);
        rests = if right == OptimalSet::Goal && action == Action::NOOP { rests + 1 } else { 0 };
        if rests == 3 {
            return;
        }
    }
    panic!("`{}` was not done within {MOST_ACTIONS} actions", exercise.command);
}

fn action<D: Domain>(domain: &D, name: &str) -> Action {
    domain.actions().iter().position(|kind| kind.name == name).map_or(Action::NOOP, |position| Action::new(position as u8))
}

/// The places of all things, as the board writes them.
fn places(home: &home::Home<impl HomeMemory>, state: &HomeState) -> String {
    let mut text = String::new();
    for &thing in [home.agent()].iter().chain(home.blocks()) {
        let cell = home.block_cell(state, thing).unwrap_or_else(|| home.agent_cell(state));
        text.push_str(&format!("; {} {} {}", home.objects().name(thing), cell.x, cell.y));
    }
    text.split_off(1)
}

pub fn the_papers_course_is_learned_over_the_serial_line(setup: &Setup) {
    let mut board = Board::on(setup, None);
    assert_eq!(board.line(), "nothing is stored");
    board.must("pace 0");
    for exercise in &LESSONS {
        teach(&mut board, exercise);
    }
    let understands_all = |board: &mut Board| {
        describe(board, &Homes::FIXED.test);
        for test in &TESTS {
            let answer = board.must(&format!("say {}", test.command));
            assert_eq!(believed(&answer), meant(&Homes::FIXED.test, &test.intention), "{}", test.command);
        }
    };
    understands_all(&mut board);
    for line in board.must("memory") {
        println!("{line}");
    }
    // The battery is empty and is replaced.
    let slots = board.slots();
    drop(board);
    let mut board = Board::on(setup, Some(&slots));
    assert!(board.line().starts_with("stored: "));
    assert_eq!(board.line(), format!("lessons {}", LESSONS.len()));
    understands_all(&mut board);
}

/// A home as a file.
fn file_of(layout: &Layout) -> EnvironmentFile {
    let rooms = layout.rooms.iter().flatten().enumerate().map(|(number, &(area, color))| {
        let Area { left, bottom, right, top } = area;
        ObjectRecord::Room { name: format!("room{number}"), left, bottom, right, top, color: color.to_owned() }
    });
    let doors = layout.doors.iter().flatten().enumerate().map(|(number, &Cell { x, y })| ObjectRecord::Door {
        name: format!("door{number}"),
        left: x,
        bottom: y,
        right: x,
        top: y,
    });
    let blocks = layout.blocks.iter().flatten().enumerate().map(|(number, block)| ObjectRecord::Block {
        name: format!("block{number}"),
        x: block.cell.x,
        y: block.cell.y,
        color: block.color.to_owned(),
        shape: block.shape.to_owned(),
    });
    let agent = ObjectRecord::Agent { name: "agent0".to_owned(), x: layout.agent.x, y: layout.agent.y };
    EnvironmentFile::new(rooms.chain(doors).chain(blocks).chain([agent]).collect())
}

pub fn what_a_robot_learned_elsewhere_comes_with_the_file_and_its_home_and_commands_too(setup: &Setup) {
    let mut memory = TinyMemory::new();
    let mut agent = Agent::new(&mut memory.agent, &home::paper_tasks().unwrap(), Options::DEFAULT).unwrap();
    let (trainer, homes) = (CourseTrainer::BALANCED, &Homes::FIXED);
    run_course(&mut agent, &mut memory.home, homes, &trainer, Strategy::BALANCED, &mut generator(1), &mut ()).unwrap();
    let mut model = vec![0; agent.saved_bytes().unwrap()];
    agent.save(&mut model).unwrap();
    let folder = folder();
    std::fs::write(folder.join("course.goodbot"), model).unwrap();
    std::fs::write(folder.join("home.json"), file_of(&homes.test).to_json_line()).unwrap();
    let written = Command::new(&setup.goodbot)
        .current_dir(&folder)
        .args(["microbit", "--model", "course.goodbot", "--home", "home.json", "--out", "taught.hex"])
        .args(TESTS.iter().flat_map(|test| ["--command", test.command]))
        .arg("--hex")
        .arg(&setup.hex)
        .output()
        .unwrap();
    assert!(written.status.success(), "{}", String::from_utf8_lossy(&written.stderr));
    let mut board = Board::with_file(setup, &folder.join("taught.hex"), None);
    std::fs::remove_dir_all(&folder).unwrap();
    assert!(board.line().starts_with("stored: "));
    assert_eq!(board.line(), format!("lessons {}", LESSONS.len()));
    board.must("pace 0");
    for test in &TESTS {
        let answer = board.must("next");
        assert_eq!(answer[0], format!("next: {}", test.command));
        assert_eq!(believed(&answer), meant(&homes.test, &test.intention), "{}", test.command);
    }
    // The list starts again.
    assert_eq!(board.must("next")[0], format!("next: {}", TESTS[0].command));
}

pub fn a_lesson_is_given_with_the_buttons_alone(setup: &Setup) {
    let mut board = Board::on(setup, None);
    board.lines_to("nothing is stored");
    board.must("pace 0");
    // A long press chooses the next command; the robot then acts by itself, also after lessons over the serial line.
    board.button(B, true);
    assert_eq!(board.line(), "next: go to the green room");
    board.button(B, false);
    board.lines_to("did ");
    board.press(&[B]);
    assert!(board.lines_to("good").iter().all(|line| !line.starts_with("error")));
    board.press(&[A]);
    board.lines_to("bad");
    board.press(&[A, B]);
    board.lines_to("lessons 1");
    assert!(board.line().starts_with("stored "));
    // The list continues.
    board.button(A, true);
    assert_eq!(board.line(), "next: go to the blue room");
}

pub fn each_button_says_its_word_and_both_end_the_lesson(setup: &Setup) {
    let mut board = Board::on(setup, None);
    board.lines_to("nothing is stored");
    for request in ["pace 0", "say go to the green room", "act"] {
        board.must(request);
    }
    for (buttons, said) in [(&[B][..], "good"), (&[A], "bad"), (&[A, B], "lessons 1")] {
        board.press(buttons);
        assert_eq!(board.line(), said);
    }
}

pub fn the_lights_show_the_rooms_the_robot_and_the_block(setup: &Setup) {
    let mut board = Board::on(setup, None);
    board.lines_to("nothing is stored");
    board.must("pace 0");
    let (mut brightest, mut dimmest) = (0.0_f32, 16.0_f32);
    let mut all = Looks::default();
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(6) {
        let mut looks = Looks::default();
        board.look(&mut looks, 200);
        board.look(&mut all, 200);
        if let Some(block) = looks.lights()[1][2] {
            (brightest, dimmest) = (brightest.max(block), dimmest.min(block));
        }
    }
    // The robot is in the corner of the red room. All lights but the block's are steady.
    assert!(brightest > 12.0 && dimmest < 4.0, "the block's light is between {dimmest} and {brightest}");
    let expected = [[16, 1, 1, 1, 1], [1, 1, 0, 1, 1], [0, 2, 0, 2, 0], [4, 4, 0, 8, 8], [4, 4, 0, 8, 8]];
    for (row, lights) in all.lights().iter().enumerate() {
        for (column, found) in lights.iter().enumerate().filter(|&(column, _)| (row, column) != (1, 2)) {
            let (found, expected) = (found.unwrap(), expected[row][column] as f32);
            let exact = expected == 0.0 || expected == 16.0;
            // A look may happen while the rows change.
            let error = if exact { 0.25 } else { 0.6 + 0.25 * expected };
            assert!((found - expected).abs() <= error, "light {column} of row {row} is {found}, not {expected}");
        }
    }
}

pub fn a_power_cut_at_any_write_of_a_store_leaves_the_lessons_of_before(setup: &Setup) {
    const SLOT: usize = SLOTS_BYTES / 2;
    const PAGE: usize = 1_024;
    let mut board = Board::on(setup, None);
    board.lines_to("nothing is stored");
    board.must("pace 0");
    let mut lesson = |command: &str| {
        board.must("again");
        board.must(&format!("say {command}"));
        board.must("act");
        board.must("good");
        board.must("finish");
        board.slots()
    };
    lesson("go to the green room");
    let before = lesson("go to the blue room");
    let after = lesson("go to the red room");
    // The older slot is erased page by page; then its model is written word by word, and its header last.
    let slot = if before[..SLOT] == after[..SLOT] { SLOT } else { 0 };
    let length = u32::from_le_bytes(*after[slot + 8..].first_chunk().unwrap()) as usize;
    let model = slot + SLOT_HEADER_BYTES..slot + SLOT_HEADER_BYTES + length;
    let mut cuts = vec![before];
    for page in (slot..slot + SLOT).step_by(PAGE) {
        let mut next = cuts.last().unwrap().clone();
        next[page..page + PAGE].fill(0xff);
        cuts.push(next);
    }
    for word in model.clone().step_by(4).chain((slot..model.start).step_by(4)) {
        let mut next = cuts.last().unwrap().clone();
        next[word..word + 4].copy_from_slice(&after[word..word + 4]);
        cuts.push(next);
    }
    let last = cuts.len() - 1;
    assert!(cuts[last] == after && last > 50, "the store was not what is cut here: {last} writes of {length} bytes");
    let restored = |(number, flash): (usize, &Vec<u8>)| {
        let mut board = Board::on(setup, Some(flash));
        assert!(board.line().starts_with("stored: "), "after {number} of {last} writes");
        assert_eq!(board.line(), if number == last { "lessons 3" } else { "lessons 2" }, "after {number} of {last} writes");
    };
    std::thread::scope(|scope| {
        for part in 0..2 {
            let cuts = &cuts;
            scope.spawn(move || cuts.iter().enumerate().skip(part).step_by(2).for_each(restored));
        }
    });
    println!("the power was cut at each of {last} writes");
}

pub fn a_lesson_of_given_actions_is_learned_and_the_model_is_fetched_as_it_is_stored(setup: &Setup) {
    let mut board = Board::on(setup, None);
    board.lines_to("nothing is stored");
    board.must("pace 0");
    board.must("say go to the green room");
    for (said, did) in [("act south", "did south; agent0 1 4; block0 3 4"), ("act noop", "did nothing; agent0 1 4; block0 3 4")] {
        assert_eq!(board.must(said)[0], did);
        board.must("good");
    }
    assert!(board.ask("act jump").unwrap_err().contains("no such action"));
    assert!(board.ask("model").unwrap_err().contains("a lesson is under way"));
    board.must("finish");
    let model: Vec<u8> = board
        .must("model")
        .concat()
        .as_bytes()
        .chunks(2)
        .map(|digits| u8::from_str_radix(std::str::from_utf8(digits).unwrap(), 16).unwrap())
        .collect();
    let slots = board.slots();
    assert!(!model.is_empty() && slots.windows(model.len()).any(|stored| stored == model));
    let folder = folder();
    std::fs::write(folder.join("fetched.goodbot"), &model).unwrap();
    let read = Command::new(&setup.goodbot).current_dir(&folder).args(["inspect", "fetched.goodbot"]).output().unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    assert!(read.status.success(), "{}", String::from_utf8_lossy(&read.stderr));
    assert!(String::from_utf8_lossy(&read.stdout).contains("green"));
    // The robot has lost nothing.
    assert_eq!(board.must("say go to the green room").len(), 1);
}

pub fn what_is_said_wrongly_is_answered_and_changes_nothing(setup: &Setup) {
    let mut board = Board::on(setup, None);
    board.lines_to("nothing is stored");
    board.must("pace 0");
    for (said, problem) in [
        ("dance", "no such request"),
        ("pace", "needs a number"),
        ("pace soon", "needs a number"),
        ("act now", "no such action"),
        ("again now", "more on the line"),
        ("act", "give a command first"),
        ("good", "give a command first"),
        ("finish", "give a command first"),
        ("say", "no word"),
        ("say ...", "no word"),
        ("room a 0 0 4 4 red", "say `begin` first"),
        ("build", "say `begin` first"),
        (&"x".repeat(65), "at most 64 bytes"),
    ] {
        let answer = board.ask(said).expect_err(said);
        assert!(answer.contains(problem), "`{said}`: {answer}");
    }
    board.must("begin");
    for (said, problem) in
        [("room a 0 0 1 1 red", "two cells"), ("room a 0 0 999 4 red", "too far"), ("door", "door needs"), ("build", "no agent")]
    {
        let answer = board.ask(said).expect_err(said);
        assert!(answer.contains(problem), "`{said}`: {answer}");
    }
    assert!(board.ask("say go").unwrap_err().contains("no home"));
    board.must("home");
    assert_eq!(board.must("say go to the green room").len(), 1);
}
