//! `goodbot learn`, `ask`, `inspect` and `evaluate`, as their users run them.

use crate::program;

use program::{AGENT, END, goodbot, session, shown};
use std::path::PathBuf;

/// Sessions in which "up" shows the way north, and "stay low" none at all.
fn lessons(count: usize) -> String {
    let intended = r#","intended":["agentInRoom(agent0,room1)"]"#;
    let lesson = [session(AGENT, "demonstration", "up to the green one", intended), shown("north"), shown("north"), END.to_owned()];
    vec![lesson.join("\n"); count].join("\n")
}

fn file(name: &str, content: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("goodbot-language-{}-{name}", std::process::id()));
    std::fs::write(&path, content).expect("a file");
    path
}

#[test]
fn a_learned_model_is_asked_and_inspected() {
    let model = file("model", "");
    let (model, log) = (model.to_str().expect("a name"), lessons(3));
    let learned = goodbot(&["learn", "-", "--out", model], log.as_bytes());
    assert_eq!(learned.code, 0, "{}", learned.messages);
    assert!(learned.output.starts_with("3 sessions, 5 words"), "{}", learned.output);
    let environment = format!(r#"{{"version":1,"objects":[{},{AGENT}]}}"#, program::ROOMS);
    let asked = goodbot(&["ask", "--with", model, "--environment", "-", "--json", "green sky"], environment.as_bytes());
    assert_eq!(asked.code, 0, "{}", asked.messages);
    let answer: serde_json::Value = serde_json::from_str(&asked.output).expect("a line of JSON");
    assert_eq!(answer["task"], "agentInRoom(agent0,room1)");
    assert_eq!(answer["plan"], serde_json::json!(["north", "north"]));
    assert_eq!(answer["words"][1]["token"], "never heard");
    let inspected = goodbot(&["inspect", model, "--json"], b"");
    assert!(inspected.output.contains(r#""token":"colorGreen""#), "{}", inspected.output);
}

#[test]
fn an_evaluation_ends_with_its_summary() {
    let run = goodbot(&["evaluate", "-", "--json"], lessons(4).as_bytes());
    assert_eq!(run.code, 0, "{}", run.messages);
    let last: serde_json::Value = serde_json::from_str(run.output.lines().last().expect("a line")).expect("JSON");
    assert_eq!((last["type"].as_str(), last["sessions"].as_u64(), last["right"].as_u64()), (Some("summary"), Some(4), Some(4)));
}

#[test]
fn a_log_cut_in_the_middle_is_refused_with_its_line_or_passed_over() {
    let whole = lessons(3);
    let cut = &whole[..whole.len() - 5];
    let refused = goodbot(&["evaluate", "-"], cut.as_bytes());
    assert_eq!(refused.code, 2);
    assert!(refused.messages.contains("standard input:12:"), "{}", refused.messages);
    let counted = goodbot(&["evaluate", "-", "--keep-going", "--json"], cut.as_bytes());
    assert!(counted.output.contains(r#""skipped":1"#), "{} {}", counted.output, counted.messages);
}

#[test]
fn what_was_meant_must_be_a_task_of_the_home() {
    let wrong = lessons(2).replacen("agentInRoom(agent0,room1)", "agentInRoom(agent0,room0)", 1);
    let run = goodbot(&["evaluate", "-"], wrong.as_bytes());
    assert_eq!(run.code, 2);
    assert!(run.messages.contains("standard input:1: field \"intended\""), "{}", run.messages);
}

#[test]
fn a_model_file_that_is_none_is_refused_by_name() {
    let path = file("none", "no model");
    let run = goodbot(&["inspect", path.to_str().expect("a name")], b"");
    assert_eq!(run.code, 2);
    assert!(run.messages.contains("goodbot-language-"), "{}", run.messages);
}
