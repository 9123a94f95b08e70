//! The screen's contents.

mod picture;

use super::*;
use crate::teach::classroom::Classroom;
use crate::teach::keys::Intent;
use crate::teach::lessons::{Tour, first_home};
use crate::teach::pupil::{Pupil, build, kinds_of_task};
use crate::teach::site::Setting;
use crate::teach::visit::time::Pace;
use goodbot_formats::environment::EnvironmentFile;
use goodbot_lesson::home;
use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::style::Color;
use std::time::Duration;

/// A robot without training in a place.
fn pupil(setting: &Setting) -> Pupil {
    let place = build(setting).unwrap();
    let lifted = kinds_of_task(&place.0, false).unwrap();
    Pupil::new(place, &lifted, 1, None, goodbot_console::Starter::default()).unwrap()
}

fn visit(home: &EnvironmentFile, tour: bool) -> Visit {
    let pupil = pupil(&Setting::Floor(home.clone()));
    let tour = tour.then(|| Tour::new(None, std::iter::empty()));
    Visit::new(Classroom::new(pupil, None, tour).unwrap(), Pace::Normal, 1)
}

/// The beginning of a visit in a world from a file.
fn in_world(text: &str) -> Visit {
    let world = std::sync::Arc::new(goodbot_formats::world::WorldFile::parse(text).unwrap());
    Visit::new(Classroom::new(pupil(&Setting::Other(world)), None, None).unwrap(), Pace::Normal, 1)
}

fn drawn(visit: &Visit, columns: u16, rows: u16, palette: Palette) -> TestBackend {
    let mut terminal = Terminal::new(TestBackend::new(columns, rows)).unwrap();
    terminal.draw(|frame| draw(frame, visit, palette)).unwrap();
    terminal.backend().clone()
}

fn text(backend: &TestBackend) -> String {
    let buffer = backend.buffer();
    let rows = buffer.content.chunks(usize::from(buffer.area.width));
    rows.map(|row| row.iter().map(|cell| cell.symbol()).collect::<String>().trim_end().to_owned() + "\n").collect()
}

/// A visit in its first lesson, after one rewarded step.
fn first_lesson() -> Visit {
    let mut visit = visit(&first_home().unwrap(), true);
    visit.take(Intent::Say, Duration::ZERO);
    while visit.acted().is_none() {
        visit.tick(Duration::ZERO);
    }
    visit.take(Intent::Good, Duration::ZERO);
    visit
}

#[test]
fn a_lesson_under_way_at_80_by_24() {
    let screen = text(&drawn(&first_lesson(), 80, 24, Palette::Many));
    assert_eq!(screen, include_str!("first_lesson.txt"), "{screen}");
}

#[test]
fn a_narrow_screen_shows_guesses_too_and_the_explanation_to_its_end() {
    let mut visit = first_lesson();
    let best = visit.classroom.pupil.meanings()[0].words.clone();
    assert!(text(&drawn(&visit, 40, 20, Palette::None)).contains(&best));
    visit.take(Intent::Explain, Duration::ZERO);
    assert!(!text(&drawn(&visit, 40, 20, Palette::None)).contains("leave; all"));
    visit.take(Intent::Scroll(100), Duration::ZERO);
    assert!(text(&drawn(&visit, 40, 20, Palette::None)).contains("leave; all"));
}

#[test]
fn a_narrow_screen_has_whole_keys_with_the_explanation_and_a_question_before_what_was_done() {
    let mut visit = first_lesson();
    visit.message = "It asks: Which of these do you mean? 1 the green room, 2 the red room, 3 the blue room, n none of these.".to_owned();
    let screen = text(&drawn(&visit, 40, 20, Palette::None));
    assert!(screen.ends_with("g good b bad f finish p pause ? explain\n"), "{screen}");
    assert!(screen.contains("n none of these."), "{screen}");
}

#[test]
fn nothing_is_told_by_a_colour_alone() {
    let visit = first_lesson();
    let (plain, colored) = (drawn(&visit, 80, 24, Palette::None), drawn(&visit, 80, 24, Palette::Many));
    assert_eq!(text(&plain), text(&colored));
    assert!(plain.buffer().content.iter().all(|cell| (cell.fg, cell.bg) == (Color::Reset, Color::Reset)));
}

#[test]
fn tab_proposes_a_lesson_goes_where_it_can_be_taught_and_says_why() {
    let mut visit = visit(&first_home().unwrap(), false);
    visit.take(Intent::NextLesson, Duration::ZERO);
    assert_eq!(visit.message, "Teach it something first. Then this proposes the lesson that teaches it most.");
    visit.classroom.wanted = vec!["take the yellow bag to the red room".to_owned()];
    visit.take(Intent::NextLesson, Duration::ZERO);
    assert!(visit.message.starts_with("To teach next, as \"") && visit.message.contains("is in 1 of the commands"), "{}", visit.message);
    let proposed = visit.prompt.text();
    visit.take(Intent::Say, Duration::ZERO);
    assert!(visit.classroom.pupil.meanings().iter().any(|meaning| meaning.words == proposed), "{proposed} can be meant here");
    visit.take(Intent::NextLesson, Duration::ZERO);
    assert!(visit.message.starts_with("First end this session"));
    assert_eq!(visit.classroom.pupil.lesson.command(), Some(proposed.as_str()));
}

#[test]
fn every_size_can_be_drawn_on() {
    let mut visit = first_lesson();
    for page in [None, Some((crate::teach::visit::Page::Explanation, 3)), Some((crate::teach::visit::Page::Words, u16::MAX))] {
        visit.page = page;
        for (columns, rows) in (1..=100).zip(1..=100).chain([(200, 50), (80, 8), (24, 60), (1, 200), (300, 1)]) {
            drawn(&visit, columns, rows, Palette::Sixteen);
        }
    }
}

#[test]
fn a_home_larger_than_the_screen_is_seen_around_the_robot() {
    let wide = |inside: String| format!("#{inside}#\n");
    let rows = [wide("#".repeat(150)), wide("r".repeat(150)), wide("r".repeat(140) + "@" + &"r".repeat(9)), wide("#".repeat(150))].concat();
    let screen = text(&drawn(&visit(&home::parse("rows", &rows).unwrap(), false), 80, 24, Palette::Many));
    assert!(screen.contains("rr@rr"), "{screen}");
}

#[test]
fn the_explanation_names_every_key() {
    let mut visit = first_lesson();
    visit.take(Intent::Explain, Duration::ZERO);
    let screen = text(&drawn(&visit, 80, 30, Palette::None));
    for key in ["good", "bad", "pause", "one step", "finish", "drop", "undo", "auto", "speed", "words", "another home", "write", "leave"] {
        assert!(screen.contains(key), "{key} in {screen}");
    }
}

#[test]
fn a_word_to_its_goal_does_not_change_what_it_thought_was_done() {
    let mut visit = visit(&first_home().unwrap(), true);
    let mut now = Duration::ZERO;
    visit.take(Intent::Say, now);
    while !visit.told().contains("It thinks that it is done") {
        now += Duration::from_millis(200);
        visit.tick(now);
    }
    let done = visit.told();
    let task = done.split('"').nth(1).unwrap().to_owned();
    visit.take(Intent::Bad, now);
    assert!(!visit.classroom.pupil.meanings()[0].words.contains(&task));
    assert!(visit.told().starts_with(&format!("It thinks that it is done: \"{task}\".")), "{}", visit.told());
}

#[test]
fn words_that_spoke_for_a_guess_are_marked() {
    let mut visit = visit(&first_home().unwrap(), true);
    // A simulated trainer teaches two lessons; in the third, "blue" is new.
    let mut now = Duration::ZERO;
    while visit.stop().is_some_and(|stop| stop.number < 3) {
        if visit.phase() == Phase::Idle {
            visit.take(Intent::Say, now);
            visit.take(Intent::Auto, now);
        }
        now += Duration::from_millis(200);
        visit.tick(now);
    }
    visit.take(Intent::Say, now);
    let screen = text(&drawn(&visit, 80, 24, Palette::None));
    assert!(screen.contains("blue") && screen.contains("new"), "{screen}");
    visit.take(Intent::Drop, now);
    visit.prompt.set("go to the red room");
    visit.take(Intent::Say, now);
    let screen = text(&drawn(&visit, 80, 24, Palette::None));
    assert!(screen.contains('*'), "{screen}");
}

#[test]
fn a_world_from_a_file_is_a_table_of_its_objects_and_what_holds_of_them() {
    let mut visit = in_world(include_str!("../../../../docs/examples/worlds/vacuum.json"));
    let screen = text(&drawn(&visit, 80, 24, Palette::None));
    assert!(["vacuum0 ", "  vacuum in: hall room ", "  charged: low "].iter().all(|line| screen.contains(line)), "{screen}");
    "clean the hall".chars().for_each(|letter| visit.take(Intent::Write(letter), Duration::ZERO));
    visit.take(Intent::Say, Duration::ZERO);
    while visit.acted().is_none() {
        visit.tick(Duration::ZERO);
    }
    let screen = text(&drawn(&visit, 80, 24, Palette::None));
    assert!(screen.contains("room clean: hall") && screen.contains("Command: clean the hall"), "{screen}");
    visit.take(Intent::Drop, Duration::ZERO);
    visit.take(Intent::ToKeys, Duration::ZERO);
    visit.take(Intent::AnotherHome, Duration::ZERO);
    assert!(visit.message.contains("a world from a file"), "{}", visit.message);
}

#[test]
fn places_with_coordinates_are_a_plan_with_what_is_there() {
    let world = include_str!("../../../../docs/examples/worlds/vacuum.json")
        .replace("\"name\":[\"room\"]", "\"name\":[\"room\"],\"x\":[\"room\"],\"y\":[\"room\"]")
        .replace("\"name\":\"hall\"", "\"name\":\"hall\",\"x\":\"0\",\"y\":\"0\"")
        .replace("\"name\":\"kitchen\"", "\"name\":\"kitchen\",\"x\":\"1\",\"y\":\"0\"")
        .replace("\"name\":\"bedroom\"", "\"name\":\"bedroom\",\"x\":\"0\",\"y\":\"1\"");
    let screen = text(&drawn(&in_world(&world), 80, 24, Palette::None));
    let lines: Vec<&str> = screen.lines().skip(2).map(|line| line.get(..24).unwrap_or(line).trim_end()).collect();
    assert_eq!(lines[..4], ["[bedroom]", "", "[hall]      [kitchen]", "@vacuum0"], "{screen}");
}

#[test]
fn the_robot_waits_while_a_page_hides_what_it_asks() {
    let mut visit = first_lesson();
    let now = Duration::from_millis(100);
    visit.take(Intent::Explain, now);
    let steps = visit.done().len();
    let later = now + Duration::from_secs(3_600);
    visit.tick(later);
    assert!(visit.next().is_none() && visit.done().len() == steps, "nothing happens behind the page");
    visit.take(Intent::ToKeys, later);
    visit.tick(later);
    assert_eq!(visit.done().len(), steps, "there is time to read what it did");
    visit.tick(later + Duration::from_secs(60));
    assert!(visit.phase() == Phase::Planning || visit.done().len() > steps, "and then it goes on");
}

#[test]
fn a_stray_word_in_a_lesson_is_asked_about_and_said_twice_it_is_a_command() {
    let mut visit = visit(&first_home().unwrap(), false);
    visit.prompt.set("go to the red room");
    visit.take(Intent::Say, Duration::ZERO);
    while visit.acted().is_none() {
        visit.tick(Duration::ZERO);
    }
    visit.take(Intent::Good, Duration::ZERO);
    visit.take(Intent::ToCommand, Duration::ZERO);
    "keep going?".chars().for_each(|letter| visit.take(Intent::Write(letter), Duration::ZERO));
    visit.take(Intent::Say, Duration::ZERO);
    assert!(visit.message.starts_with("It asks: leave \"go to the red room\" unlearned"), "{}", visit.message);
    assert_eq!(visit.classroom.pupil.lesson.command(), Some("go to the red room"));
    assert_eq!(visit.prompt.text(), "keep going?");
    assert!(text(&drawn(&visit, 80, 24, Palette::None)).contains("F1 explain"), "a question mark is a letter there");
    visit.take(Intent::Say, Duration::ZERO);
    assert_eq!(visit.classroom.pupil.lesson.command(), Some("keep going?"));
    visit.take(Intent::Finish, Duration::ZERO);
    assert!(visit.message.starts_with("Nothing to learn from"), "{}", visit.message);
}
