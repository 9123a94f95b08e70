//! A session as the lines of a log. goodbot's formats read their records again when they write them, which takes much code; these lines are
//! only written, and a test reads them.

use goodbot::feedback::Strategy;
use goodbot::home::Home;
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Domain, action_name};
use goodbot::task::{GroundedTask, LiftedTask, TaskText};
use goodbot_lesson::live::Lesson;
use serde::Serialize;
use serde_json::ser::{Formatter, Serializer};
use std::fmt::Write;

/// The session under way as lines, each with its end; `None` without a session.
pub fn lines(lesson: &Lesson, learn: bool) -> Option<String> {
    let (walk, session) = lesson.session()?;
    let (agent, home) = (&lesson.agent, lesson.home());
    let environment = json(&session.environment);
    let command = json(&walk.command);
    // "Again" has no words to learn.
    let learn = learn && !agent.sentence().is_empty();
    let mut log = format!(r#"{{"type":"session","version":1,"kind":"feedback","environment":{environment},"command":{command}"#);
    if let Some(listening) = &walk.listening {
        log = log + r#","utterance":"# + &json(&listening.utterance);
        if let Some(after) = &session.after
            && let Some(kind) = agent.lifted().get(usize::from(after.lifted))
        {
            log = log + r#","after":"# + &json(&task_name(home, kind, after));
        }
        if let Some(record) = listening.conversation.recorded(home, agent.lifted()) {
            let record: Vec<String> = record.iter().map(|(name, text)| json(name) + ":" + &json(text)).collect();
            log = log + r#","conversation":{"# + &record.join(",") + "}";
        }
    }
    if let Some(names) = lesson.named_actions() {
        log = log + r#","actions":"# + &list(names.map(json));
    }
    if let Some(strategies) = session.named_strategies() {
        let strategies = strategies.iter().enumerate().map(|(at, (it, prior))| strategy(at + 1, it, *prior));
        log = log + r#","strategies":"# + &list(strategies);
    }
    log += "}\n";
    let mut answers = walk.answers.iter().peekable();
    for done in 0..=walk.steps.len() {
        while let Some(given) = answers.next_if(|answer| answer.after <= done) {
            let name = |position: usize| {
                let task = agent.tasks().get(position)?;
                Some(json(&task_name(home, agent.lifted().get(usize::from(task.lifted))?, task)))
            };
            let (tasks, yes, eta, others) = (list(given.tasks.iter().filter_map(name)), given.yes, json(&given.eta), given.others);
            let words = given.words.as_ref().map_or_else(String::new, |words| r#","words":"#.to_owned() + &json(words));
            let _ = writeln!(log, r#"{{"type":"answer","tasks":{tasks},"yes":{yes},"eta":{eta},"others":{others}{words}}}"#);
        }
        if let Some(step) = walk.steps.get(done) {
            let (action, feedback) = (json(action_name(home, step.action)), step.feedback.name());
            let _ = writeln!(log, r#"{{"type":"step","action":{action},"feedback":"{feedback}"}}"#);
        }
    }
    let _ = writeln!(log, r#"{{"type":"end","learn":{learn}}}"#);
    Some(log)
}

/// The task as logs write it.
pub(crate) fn task_name(home: &Home<impl HomeMemory>, lifted: &LiftedTask, task: &GroundedTask) -> String {
    TaskText::new(task, lifted, home.world()).to_string()
}

fn strategy(number: usize, strategy: &Strategy, prior: f32) -> String {
    let [plus, minus, mistakes, prior] = [strategy.mu_plus(), strategy.mu_minus(), strategy.epsilon(), prior].map(|number| json(&number));
    let mut record = format!(r#"{{"name":"strategy {number}","mu_plus":{plus},"mu_minus":{minus},"epsilon":{mistakes},"prior":{prior}"#);
    if strategy.lags() != Strategy::NO_LAG {
        record = record + r#","lags":"# + &json(&strategy.lags());
    }
    if !strategy.rests_as_it_moves() {
        record = record + r#","rests":"# + &json(&strategy.rests());
    }
    record + "}"
}

/// A JSON list of items that are JSON already.
fn list(items: impl Iterator<Item = String>) -> String {
    let mut list = String::new();
    for item in items {
        list.push(if list.is_empty() { '[' } else { ',' });
        list += &item;
    }
    if list.is_empty() { "[]".to_owned() } else { list + "]" }
}

/// A text, a number or numbers as JSON.
pub(crate) fn json<T: Serialize + ?Sized>(it: &T) -> String {
    try_json(it).unwrap_or_default()
}

/// A value as JSON. `None` only for a key that is no text, which neither the view nor logs have.
pub(crate) fn try_json<T: Serialize + ?Sized>(value: &T) -> Option<String> {
    let mut text = Vec::new();
    value.serialize(&mut Serializer::with_formatter(&mut text, Short)).ok()?;
    String::from_utf8(text).ok()
}

/// Writes without spaces. In the page, the browser writes the numbers: the tables for that would take two kilobytes of it.
struct Short;

impl Formatter for Short {
    #[cfg(target_family = "wasm")]
    fn write_f32<W: std::io::Write + ?Sized>(&mut self, writer: &mut W, value: f32) -> std::io::Result<()> {
        use wasm_bindgen::JsCast;
        use wasm_bindgen::prelude::*;

        #[wasm_bindgen]
        extern "C" {
            type Number;
            #[wasm_bindgen(method, js_name = toPrecision)]
            fn with_digits(this: &Number, digits: u32) -> String;
            #[wasm_bindgen(js_name = parseFloat)]
            fn number(text: &str) -> f64;
            #[wasm_bindgen(js_name = String)]
            fn shortest(number: f64) -> String;
        }

        // The fewest digits, six or more, that are read as the same number; nine always are.
        let exact: Number = JsValue::from_f64(value.into()).unchecked_into();
        let near = (6..9).map(|digits| number(&exact.with_digits(digits))).find(|near| *near as f32 == value);
        let text = shortest(near.unwrap_or_else(|| number(&exact.with_digits(9))));
        writer.write_all(text.as_bytes())?;
        // Rust writes a whole number with `.0`.
        if text.bytes().all(|letter| letter == b'-' || letter.is_ascii_digit()) { writer.write_all(b".0") } else { Ok(()) }
    }
}
