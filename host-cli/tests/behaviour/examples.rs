//! The examples of the documents, with the files of `docs/examples`.

use crate::program;

use program::goodbot;
use std::path::Path;

fn example(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/examples").join(name);
    path.to_str().expect("a name").to_owned()
}

#[test]
fn the_examples_have_no_fault() {
    let run = goodbot(&["check", &example("home.json"), &example("sessions.jsonl")], b"");
    assert_eq!(run.code, 0, "{}", run.messages);
}

/// The rows of docs/how-it-works.md: the probability of four tasks after each word.
#[test]
fn the_first_lesson_is_as_the_document_tells_it() {
    let document = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/how-it-works.md")).expect("the document");
    let rows: Vec<Vec<&str>> = document
        .lines()
        .filter(|line| line.contains("| 0."))
        .map(|line| line.trim_matches('|').split('|').skip(2).map(str::trim).collect())
        .collect();
    assert_eq!(rows.len(), 4);
    let run = goodbot(&["replay", "--json", &example("sessions.jsonl")], b"");
    let tasks = ["blockInRoom(block0,room1)", "agentInRoom(agent0,room1)", "blockInRoom(block0,room2)", "agentInRoom(agent0,room2)"];
    for (line, row) in run.output.lines().zip(rows) {
        let belief: serde_json::Value = serde_json::from_str(line).expect("a line of JSON");
        assert_eq!(tasks.map(|task| format!("{:.3}", belief["tasks"][task].as_f64().expect("a number"))).as_slice(), row);
    }
}

#[test]
fn four_sessions_are_enough_to_understand_a_new_command_in_a_new_home() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = folder.path().join("words.goodbot");
    let model = model.to_str().expect("a name");
    assert_eq!(goodbot(&["learn", &example("sessions.jsonl"), "--out", model], b"").code, 0);
    let command = "take the yellow bag to the blue room";
    let asked = goodbot(&["ask", "--with", model, "--environment", &example("home.json"), "--json", command], b"");
    let answer: serde_json::Value = serde_json::from_str(&asked.output).expect("a line of JSON");
    assert_eq!(answer["task"], "blockInRoom(block0,room1)");
    assert!(answer["tasks"]["blockInRoom(block0,room1)"].as_f64().expect("a number") > 0.99);
    assert_eq!(answer["tied"], 1);
}

#[test]
fn words_that_no_lesson_had_are_taken_for_nothing_that_the_robot_can_do() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = folder.path().join("words.goodbot");
    let model = model.to_str().expect("a name");
    assert_eq!(goodbot(&["learn", &example("sessions.jsonl"), "--out", model], b"").code, 0);
    let asked = goodbot(&["ask", "--with", model, "--environment", &example("home.json"), "xyzzy plugh"], b"");
    assert!(asked.output.contains("answer: none of what I can do here"), "{}", asked.output);
}

#[test]
fn a_command_that_says_nothing_leaves_the_tasks_tied_in_the_papers_model_and_the_answer_says_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = folder.path().join("words.goodbot");
    let model = model.to_str().expect("a name");
    assert_eq!(goodbot(&["learn", &example("sessions.jsonl"), "--learner", "paper", "--out", model], b"").code, 0);
    let asked = goodbot(&["ask", "--with", model, "--environment", &example("home.json"), "xyzzy plugh"], b"");
    assert!(asked.output.contains("one of 2 equally likely"), "{}", asked.output);
}
