//! The same sentence means the same through `goodbot ask` and `goodbot teach`: in a home, and in a world from a file.

use crate::program::goodbot;
use crate::robot::Robot;
use crate::talk::{self, Home};
use serde_json::{Value, json};
use std::path::Path;

const LAMPS: [(&str, &str); 3] = [("desk", "lamp0"), ("door", "lamp1"), ("shelf", "lamp2")];
const VALVES: [(&str, &str); 2] = [("north", "valve0"), ("south", "valve1")];

/// The words for each kind of task, and the proposition that holds before it is done.
const KINDS: [(&str, &str, &[&str]); 4] = [
    ("lampOn", "lampOff", &["turn on the {} lamp", "switch on the {} lamp", "turn the {} lamp on", "light the {} lamp"]),
    ("lampOff", "lampOn", &["turn off the {} lamp", "switch off the {} lamp", "turn the {} lamp off", "put out the {} lamp"]),
    ("valveOpen", "valveShut", &["open the {} valve", "open up the {} valve", "please open the {} valve"]),
    ("valveShut", "valveOpen", &["close the {} valve", "shut the {} valve", "please close the {} valve"]),
];

/// What holds when the sentences are said.
const FACTS: [&str; 5] = ["lampOn(lamp0)", "lampOff(lamp1)", "lampOff(lamp2)", "valveShut(valve0)", "valveOpen(valve1)"];

/// Sentences that ask for a task.
const COMMANDS: [(&str, &str); 10] = [
    ("turn on the door lamp", "lampOn(lamp1)"),
    ("please switch on the shelf lamp", "lampOn(lamp2)"),
    ("turn the desk lamp off", "lampOff(lamp0)"),
    ("open the north valve", "valveOpen(valve0)"),
    ("could you close the south valve", "valveShut(valve1)"),
    ("shut the south valve please", "valveShut(valve1)"),
    ("switch off the desk lamp", "lampOff(lamp0)"),
    ("light the door lamp", "lampOn(lamp1)"),
    ("can you open the north valve", "valveOpen(valve0)"),
    ("put out the desk lamp", "lampOff(lamp0)"),
];

/// Sentences that ask for what holds already.
const DONE: [(&str, &str); 5] = [
    ("turn on the desk lamp", "lampOn(lamp0)"),
    ("close the north valve", "valveShut(valve0)"),
    ("open the south valve", "valveOpen(valve1)"),
    ("turn off the shelf lamp", "lampOff(lamp2)"),
    ("switch off the door lamp", "lampOff(lamp1)"),
];

/// Sentences for which a robot must do nothing now: prohibitions, questions, thanks, times and statements.
const NOTHING: [&str; 26] = [
    "don't turn on the door lamp",
    "never open the north valve",
    "do not close the south valve",
    "don't switch off the desk lamp",
    "you must not open the north valve",
    "is the door lamp on",
    "is the door lamp on?",
    "did you open the north valve",
    "why is the desk lamp on",
    "which lamp is on",
    "have you closed the south valve",
    "can the north valve be opened",
    "thanks for turning on the desk lamp",
    "thank you for opening the south valve",
    "good that you closed the north valve",
    "well done with the door lamp",
    "turn on the door lamp tonight",
    "open the north valve in ten minutes",
    "close the south valve tomorrow",
    "turn the desk lamp off at noon",
    "open the north valve when it rains",
    "the door lamp is broken",
    "the north valve leaks",
    "the desk lamp is too bright",
    "i like the shelf lamp",
    "the south valve was open yesterday",
];

/// A greenhouse with three lamps and two valves.
fn greenhouse() -> Value {
    let object =
        |class: &str, attribute: &str, value: &str, name: &str| json!({"name": name, "class": class, "attributes": {attribute: value}});
    let lamps = LAMPS.iter().map(|(place, name)| object("lamp", "place", place, name));
    let valves = VALVES.iter().map(|(side, name)| object("valve", "side", side, name));
    let action = |name: &str, class: &str, from: &str, to: &str| json!({"name": name, "parameters": {"?x": class}, "conditions": [format!("{from}(?x)")], "effects": [format!("{to}(?x)"), format!("!{from}(?x)")]});
    json!({
        "type": "world", "name": "greenhouse", "classes": ["lamp", "valve"], "attributes": {"place": ["lamp"], "side": ["valve"]},
        "propositions": {"lampOn": ["lamp"], "lampOff": ["lamp"], "valveOpen": ["valve"], "valveShut": ["valve"]},
        "objects": lamps.chain(valves).collect::<Vec<_>>(), "facts": FACTS,
        "actions": [
            action("light", "lamp", "lampOff", "lampOn"), action("dim", "lamp", "lampOn", "lampOff"),
            action("open", "valve", "valveShut", "valveOpen"), action("shut", "valve", "valveOpen", "valveShut"),
        ],
        "task_kinds": ["lampOn(?l)", "lampOff(?l)", "valveOpen(?v)", "valveShut(?v)"],
    })
}

/// A log of 60 commands in the greenhouse, each said when its task was to do.
fn commands() -> String {
    let mut lines = vec![greenhouse().to_string()];
    for round in 0..15 {
        for (kind, before, said) in KINDS {
            let things: &[(&str, &str)] = if kind.starts_with("lamp") { &LAMPS } else { &VALVES };
            let (name, thing) = things[round % things.len()];
            let words = said[round / things.len() % said.len()].replace("{}", name);
            let mut facts: Vec<String> =
                FACTS.iter().filter(|fact| !fact.ends_with(&format!("({thing})"))).map(|&fact| fact.to_owned()).collect();
            facts.push(format!("{before}({thing})"));
            let intended = [format!("{kind}({thing})")];
            lines.push(
                json!({"type": "command", "world": "greenhouse", "command": words, "intended": intended, "facts": facts}).to_string(),
            );
        }
    }
    lines.join("\n")
}

fn text(path: &Path) -> &str {
    path.to_str().expect("UTF-8")
}

/// What `ask` answers to each sentence in a place.
fn asked(model: &Path, place: &Path, sentences: &[String]) -> Vec<Value> {
    let run = goodbot(&["ask", "--with", text(model), "--environment", text(place), "--json", "-"], sentences.join("\n").as_bytes());
    assert_eq!(run.code, 0, "{}", run.messages);
    run.output.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
}

/// Asserts that `teach` is as certain of each sentence as `ask`.
fn assert_same_through_teach(folder: &Path, model: &Path, place: &Path, sentences: &[String], answers: &[Value]) {
    let own = folder.join("teach.goodbot");
    std::fs::copy(model, &own).expect("a copy");
    let mut robot = Robot::new(&[text(place), "--model", text(&own), "--log", text(&folder.join("teach.jsonl"))]);
    let mut differ = Vec::new();
    for (words, answer) in sentences.iter().zip(answers) {
        let heard = robot.one(&format!("command {words}"));
        robot.tell("reset");
        let certain = |it: &Value, name: &str| it[name].as_str().expect("a verdict").to_owned();
        // Where the first of several commands is done, `teach` goes on with the rest.
        let (here, there) = (certain(&heard, "certainty"), certain(answer, "verdict"));
        let is_of_rest = answer["taken_for"] == "several commands";
        // `ask` is sure of all commands, `teach` of the first: of the others it asks when it comes to them.
        let is_first_sure = is_of_rest && here == "sure" && there == "unsure";
        if here != there && !is_first_sure || heard["taken_for"] != answer["taken_for"] && !is_of_rest {
            differ.push(format!("{words}: teach {here} {}, ask {there} {}", heard["taken_for"], answer["taken_for"]));
        }
    }
    assert!(differ.is_empty(), "{}", differ.join("\n"));
}

#[test]
fn a_robot_in_a_world_does_what_it_is_told_and_nothing_for_other_talk_and_teach_agrees_with_ask() {
    let folder = tempfile::tempdir().expect("a folder");
    let [log, place, model] = ["log.jsonl", "greenhouse.json", "words.goodbot"].map(|name| folder.path().join(name));
    std::fs::write(&log, commands()).expect("a log");
    std::fs::write(&place, greenhouse().to_string()).expect("a world");
    let learned = goodbot(&["learn", text(&log), "--out", text(&model)], b"");
    assert_eq!(learned.code, 0, "{}", learned.messages);
    let told = |verdict: &'static str| move |&(words, task): &(&str, &str)| (words.to_owned(), Some((verdict, task.to_owned())));
    let nothing = NOTHING.iter().map(|words| ((*words).to_owned(), None));
    let said: Vec<(String, Option<(&str, String)>)> =
        COMMANDS.iter().map(told("sure")).chain(DONE.iter().map(told("done"))).chain(nothing).collect();
    let sentences: Vec<String> = said.iter().map(|(words, _)| words.clone()).collect();
    let answers = asked(&model, &place, &sentences);
    let (mut wrong, mut missed) = (Vec::new(), Vec::new());
    for ((words, meant), answer) in said.iter().zip(&answers) {
        let task = answer["task"].as_str().unwrap_or_default();
        match meant {
            Some((verdict, meant)) if (answer["verdict"].as_str(), task) != (Some(*verdict), meant.as_str()) => {
                missed.push(format!("{words}: {} {task}, not {verdict} {meant}", answer["verdict"]));
            }
            // To keep what is forbidden from happening is no act of another's wish.
            None if answer["verdict"] == "sure" && !task.starts_with('!') => wrong.push(words),
            _ => {}
        }
    }
    assert!(missed.len() <= 3, "{}", missed.join("\n"));
    assert!(wrong.len() <= 3, "of {} sentences that ask for nothing, these are carried out: {wrong:?}", NOTHING.len());
    assert_same_through_teach(folder.path(), &model, &place, &sentences, &answers);
}

#[test]
fn a_sentence_in_a_home_has_one_verdict_through_ask_and_teach_after_few_lessons_and_after_many() {
    let home = Home::number(1_010);
    let sentences = talk::sentences(&home);
    assert!(sentences.len() >= 40, "{}", sentences.len());
    for lessons in [6, 40] {
        let (folder, model) = talk::taught(lessons, &talk::ENGLISH);
        let model = Path::new(&model);
        let place = folder.path().join("place.json");
        std::fs::write(&place, home.json().to_string()).expect("a home");
        let answers = asked(model, &place, &sentences);
        assert_same_through_teach(folder.path(), model, &place, &sentences, &answers);
    }
}
