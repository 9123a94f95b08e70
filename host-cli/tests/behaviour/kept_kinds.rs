//! A model file keeps its kinds of task, and all programs that read it use them.

use crate::program::{AGENT, END, Run, THREE_STOREYS, goodbot, log, session};
use goodbot_lesson::kept_kinds;
use serde_json::Value;
use std::path::Path;

const BOTH: &str = "agentInRoom(?a,?r) & blockInRoom(?o,?r)";
const BLOCK: &str = r#"{"class":"block","name":"block0","x":4,"y":2,"color":"yellow","shape":"bag"}"#;

/// The files of one test.
struct Files {
    folder: tempfile::TempDir,
}

impl Files {
    fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    fn path(&self, name: &str) -> String {
        self.folder.path().join(name).to_str().unwrap().to_owned()
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) -> String {
        std::fs::write(self.path(name), content).unwrap();
        self.path(name)
    }

    /// A log of commands for one task, and for two tasks at once.
    fn both(&self) -> String {
        let told =
            |command: &str, meant: &str| session(&format!("{AGENT},{BLOCK}"), "labelled", command, &format!(r#","intended":[{meant}]"#));
        let (go, take) = (r#""agentInRoom(agent0,room1)""#, r#""blockInRoom(block0,room1)""#);
        let both = told("go there with the bag", &format!("{go},{take}"));
        self.write("both.jsonl", log([&told("go there", go), END, &told("bring the bag", take), END, &both, END]))
    }

    /// A log of commands with ways, in three storeys.
    fn ways(&self) -> String {
        let told = |(number, color): (usize, &str)| {
            ["through", "avoiding"].map(|clause| {
                let (said, room) = (if clause == "through" { "via" } else { "but avoid" }, format!("\"agentInRoom(agent0,room{})\"", number + 1));
                let way = if clause == "through" { format!("[[{room}]]") } else { format!("[{room}]") };
                format!(
                    r#"{{"type":"session","version":1,"id":"{said}{number}","kind":"labelled","environment":{THREE_STOREYS},"command":"go to the green room {said} the {color} room","intended":["agentInRoom(agent0,room0)"],"{clause}":{way}}}"#
                )
            })
        };
        let lines: Vec<String> =
            ["blue", "red", "yellow"].into_iter().enumerate().flat_map(told).flat_map(|line| [line, END.to_owned()]).collect();
        self.write("ways.jsonl", lines.join("\n") + "\n")
    }
}

fn sound(arguments: &[&str]) -> Run {
    let run = goodbot(arguments, b"");
    assert_eq!(run.code, 0, "{arguments:?}: {}{}", run.output, run.messages);
    run
}

fn learned(files: &Files, log: &str, name: &str, options: &[&str]) -> String {
    let model = files.path(name);
    sound(&[&["learn", log, "--learner", "roles", "--out", &model], options].concat());
    model
}

fn kinds(model: &str) -> Option<Vec<String>> {
    kept_kinds::of(&std::fs::read(model).unwrap()).unwrap()
}

#[test]
fn a_model_is_evaluated_and_asked_with_the_kinds_that_it_was_learned_for() {
    let files = Files::new();
    let log = files.both();
    let model = learned(&files, &log, "words.goodbot", &["--task", BOTH]);
    let apart = sound(&["evaluate", &log, "--test", &log, "--learner", "roles", "--task", BOTH, "--json"]);
    let answers = |run: &Run| {
        let line = |line: &str| serde_json::from_str::<Value>(line).unwrap();
        let told = |line: &Value| (line["predicted"].clone(), line["probability_expected"].clone());
        run.output.lines().map(line).filter(|line| line["type"] == "answer").map(|line| told(&line)).collect::<Vec<_>>()
    };
    for options in [&[][..], &["--task", BOTH], &["--task", "agentInRoom(?me, ?to) & blockInRoom(?it, ?to)"]] {
        let with = sound(&[&["evaluate", "--with", &model, "--test", &log, "--json"], options].concat());
        assert_eq!(answers(&with), answers(&apart), "{options:?}");
    }
    assert!(sound(&["inspect", &model]).output.contains("agentInRoom(?a,?b) & blockInRoom(?c,?b)"));
}

#[test]
fn a_robot_that_learned_ways_is_asked_and_taught_with_them() {
    let files = Files::new();
    let (log, home) = (files.ways(), files.write("home.json", THREE_STOREYS));
    let model = learned(&files, &log, "ways.goodbot", &["--routes"]);
    let asked = sound(&["ask", "--with", &model, "-e", &home, "go to the green room but avoid the red room"]);
    assert!(asked.output.contains("go to the green room, but not through the red room"), "{}", asked.output);
    let teach = |options: &[&str]| {
        let lines = b"command go to the green room but avoid the red room\nstep\ngood\nfinish\n";
        goodbot(&[&["teach", "--lines", "--model", &model, &home], options].concat(), lines)
    };
    let before = kinds(&model);
    for options in [&[][..], &["--routes"]] {
        let taught = teach(options);
        assert!(
            taught.code == 0 && taught.output.contains("agentInRoom(agent0,room0) avoiding agentInRoom(agent0,room2)"),
            "{}",
            taught.output
        );
        assert_eq!(kinds(&model), before, "what teach writes keeps them too");
    }
    let (without, both) = (files.path("without.goodbot"), files.path("both.goodbot"));
    sound(&["unlearn", &model, "1", "--out", &without]);
    assert_eq!(kinds(&without), before);
    let paper = learned(&files, &files.both(), "paper.goodbot", &["--keep-going"]);
    sound(&["merge", &paper, &without, "--out", &both]);
    assert!(kept_kinds::are_same(&kinds(&both).unwrap(), &before.unwrap()));
}

#[test]
fn other_kinds_than_those_of_the_file_are_refused_with_both() {
    let files = Files::new();
    let log = files.both();
    let model = learned(&files, &log, "words.goodbot", &["--task", BOTH]);
    let (home, ours) = (files.write("home.json", THREE_STOREYS), "agentInRoom(?a,?b) & blockInRoom(?c,?b)");
    let runs = [
        &["evaluate", "--with", &model, "--test", &log, "--routes"][..],
        &["ask", "--with", &model, "-e", &home, "--task", "blockInRoom(?o,?r) avoiding agentInRoom(?a,?x)", "go"],
        &["teach", "--lines", "--model", &model, "--routes", &home],
    ];
    for arguments in runs {
        let run = goodbot(arguments, b"");
        assert_eq!(run.code, 2, "{arguments:?}");
        let told = run.messages.split_once("was learned for the kinds of task").unwrap_or_else(|| panic!("{}", run.messages)).1;
        assert!(told.contains(ours) && told.contains("avoiding agentInRoom") && told.contains("leave out"), "{}", run.messages);
    }
}

#[test]
fn a_model_of_the_papers_kinds_is_the_same_file_for_every_robot() {
    let files = Files::new();
    let log = files.both();
    let model = learned(&files, &log, "words.goodbot", &["--keep-going"]);
    assert_eq!(kinds(&model), None);
    let also = learned(&files, &log, "also.goodbot", &["--keep-going", "--task", "blockInRoom(?thing,?place)"]);
    assert_eq!(std::fs::read(model).unwrap(), std::fs::read(also).unwrap());
}

#[test]
fn a_model_without_kinds_is_asked_with_those_of_the_options() {
    let files = Files::new();
    let log = files.both();
    let model = learned(&files, &log, "words.goodbot", &["--task", BOTH]);
    let bytes = std::fs::read(&model).unwrap();
    let older = files.write("older.goodbot", kept_kinds::model_alone(&bytes));
    assert!(bytes.len() > std::fs::read(&older).unwrap().len());
    assert_eq!(goodbot(&["evaluate", "--with", &older, "--test", &log], b"").code, 2);
    sound(&["evaluate", "--with", &older, "--test", &log, "--task", BOTH]);
}

#[test]
fn damaged_kinds_are_refused() {
    let files = Files::new();
    let log = files.both();
    let model = learned(&files, &log, "words.goodbot", &["--task", BOTH]);
    let mut bytes = std::fs::read(&model).unwrap();
    *bytes.last_mut().unwrap() ^= 1;
    let damaged = files.write("damaged.goodbot", &bytes);
    let run = goodbot(&["evaluate", "--with", &damaged, "--test", &log], b"");
    assert!(run.code == 2 && run.messages.contains("the kinds of task after the model are damaged"), "{}", run.messages);
}

#[test]
fn a_microbit_takes_no_model_of_kinds_that_it_does_not_have() {
    let files = Files::new();
    let model = learned(&files, &files.both(), "words.goodbot", &["--task", BOTH]);
    let hex = files.write(
        "program.hex",
        goodbot_formats::microbit::MicrobitFile::of_program([(0, &b"goodbot on the micro:bit; say help"[..])]).unwrap().to_text(),
    );
    let out = files.path("mine.hex");
    let run = goodbot(&["microbit", "--hex", &hex, "--model", &model, "--out", &out], b"");
    assert!(run.code == 2 && run.messages.contains("a micro:bit has agentInRoom(?a,?b); blockInRoom(?a,?b) alone"), "{}", run.messages);
    assert!(!Path::new(&out).exists());
}
