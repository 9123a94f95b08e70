//! Hearing a command and learning among thousands of possible tasks, in worlds given by a log.

use std::hint::black_box;
use std::time::Duration;

use goodbot::language::{LanguageModel, Settings};
use goodbot::memory::AgentHeap;
use goodbot_benches::timing::{in_turn, median, ratio, time};
use goodbot_console::training_data::{Lesson, training, worlds};
use goodbot_console::{Learner, name_of};
use serde_json::json;

/// The commands in a world.
const COMMANDS: usize = 20;

/// Lessons in a world with this many tasks: to switch lamps on or off, each in one of up to 125 rooms, on a shelf.
fn lessons(tasks: usize) -> Vec<Lesson> {
    const COLORS: [&str; 8] = ["red", "green", "blue", "yellow", "white", "black", "orange", "brown"];
    let (color, room) = (|lamp: usize| COLORS[lamp % 8], |lamp: usize| format!("room{}", lamp / 8 % 125));
    let lamp = |lamp: usize| {
        let attributes = json!({ "color": color(lamp), "room": room(lamp), "shelf": format!("shelf{}", lamp / 1_000) });
        json!({ "name": format!("lamp{lamp}"), "class": "lamp", "attributes": attributes })
    };
    let world = json!({
        "type": "world", "name": "house", "classes": ["lamp"],
        "attributes": { "color": ["lamp"], "room": ["lamp"], "shelf": ["lamp"] },
        "propositions": { "lampOn": ["lamp"], "lampOff": ["lamp"] },
        "objects": (0..tasks / 2).map(lamp).collect::<Vec<_>>(),
        "task_kinds": ["lampOn(?x)", "lampOff(?x)"],
    });
    let command = |number: usize| {
        let (lamp, is_on) = (number * 37 % 40, number.is_multiple_of(2));
        let verb = if is_on { "please light" } else { "switch off" };
        let (command, meant) = (format!("{verb} the {} lamp in {}", color(lamp), room(lamp)), if is_on { "lampOn" } else { "lampOff" });
        json!({ "type": "command", "world": "house", "command": command, "intended": [format!("{meant}(lamp{lamp})")] })
    };
    let lines: Vec<String> = std::iter::once(world).chain((0..COMMANDS).map(command)).map(|line| line.to_string()).collect();
    let (mut lessons, mut left) = (Vec::new(), COMMANDS);
    let read = worlds::read("house", lines.join("\n").as_bytes(), Learner::Default.options(), None, &mut left, |lesson| {
        lesson.map(|lesson| lessons.extend(lesson))
    });
    read.expect("a log of a world");
    assert_eq!((lessons.len(), lessons[0].readings.len()), (COMMANDS, tasks));
    lessons
}

/// A model trained in a world, and a lesson that it hears there.
struct Trained<'m> {
    model: LanguageModel<&'m mut AgentHeap>,
    lesson: Lesson,
}

impl<'m> Trained<'m> {
    fn new(memory: &'m mut AgentHeap, lessons: &[Lesson], settings: Settings) -> Self {
        Self { model: training::train(memory, lessons.iter(), settings).expect("room"), lesson: lessons[0].clone() }
    }

    fn hear(&mut self) {
        let posterior = training::posterior(&mut self.model, &self.lesson).expect("room");
        assert!((posterior.iter().sum::<f32>() - 1.0).abs() < 1e-3);
        black_box(posterior);
    }
}

fn learn(lessons: &[Lesson], settings: Settings) -> Duration {
    let mut memory = training::memory(lessons, &settings);
    time(&mut || drop(black_box(training::train(&mut memory, lessons.iter(), settings))))
}

#[test]
fn ten_times_as_many_tasks_take_about_ten_times_as_long_to_hear_and_to_learn_among() {
    let (few, many) = (lessons(500), lessons(5_000));
    for learner in [Learner::Roles, Learner::Default] {
        let settings = learner.options().language;
        let (mut memory, mut large) = (training::memory(&few, &settings), training::memory(&many, &settings));
        let (mut one, mut ten) = (Trained::new(&mut memory, &few, settings), Trained::new(&mut large, &many, settings));
        let heard = ratio(in_turn(&mut || ten.hear(), &mut || one.hear()));
        let times = |lessons: &[Lesson]| median((0..3).map(|_| learn(lessons, settings)).collect());
        let learned = ratio((times(&many), times(&few)));
        // A quadratic cost would be a hundred times as high. The bound is this loose because a busy machine interrupts longer work more
        // often.
        assert!(heard < 60.0 && learned < 60.0, "{}: {heard}, {learned}", name_of(learner));
    }
}

/// The table of docs/appendix/performance.md.
#[test]
#[ignore = "a measurement"]
fn the_cost_of_up_to_ten_thousand_tasks() {
    println!("| tasks | hear, roles | hear, default | learn, roles | learn, default |\n|---:|---:|---:|---:|---:|");
    for tasks in [1_000, 2_000, 5_000, 10_000] {
        let lessons = lessons(tasks);
        let (mut hearing, mut learning) = (String::new(), String::new());
        for learner in [Learner::Roles, Learner::Default] {
            let settings = learner.options().language;
            let mut memory = training::memory(&lessons, &settings);
            let mut heard = Trained::new(&mut memory, &lessons, settings);
            let milliseconds = |time: Duration| format!(" {:.1} ms |", time.as_secs_f64() * 1e3);
            hearing += &milliseconds(median((0..9).map(|_| time(&mut || heard.hear())).collect()));
            learning += &milliseconds(median((0..3).map(|_| learn(&lessons, settings)).collect()));
        }
        println!("| {tasks} |{hearing}{learning}");
    }
}
