//! `goodbot ways`.

use crate::program;

use program::goodbot;
use serde_json::Value;

const SMALL: [&str; 9] = ["ways", "--runs", "2", "--lessons", "3", "--every", "2", "--tests", "4"];

fn with<'a>(more: &[&'a str]) -> Vec<&'a str> {
    SMALL.into_iter().chain(more.iter().copied()).collect()
}

#[test]
fn robots_that_learn_ways_are_tested_before_between_and_after_their_lessons() {
    let run = goodbot(&with(&["--json"]), b"");
    assert_eq!(run.code, 0, "{}", run.messages);
    let lines: Vec<Value> = run.output.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let tests: Vec<&Value> = lines.iter().filter(|line| line["type"] == "test").collect();
    let told: Vec<(&str, u64)> =
        tests.iter().map(|test| (test["questions"].as_str().unwrap(), test["lessons"].as_u64().unwrap())).collect();
    assert_eq!(told, [("none", 0), ("none", 2), ("none", 3), ("asked", 0), ("asked", 2), ("asked", 3)]);
    for test in &tests {
        assert_eq!(test["asked"], 8);
        let (right, accuracy) = (test["right"].as_f64().unwrap(), test["accuracy"].as_f64().unwrap());
        assert!((right / 8.0 - accuracy).abs() < 1e-9, "{test}");
    }
    // Both kinds of robots get the same questions before their first lesson.
    assert_eq!(tests[0]["right"], tests[3]["right"]);
    let lessons: Vec<&Value> = lines.iter().filter(|line| line["type"] == "lessons").collect();
    assert_eq!(lessons[0]["questions_asked"], 0.0);
    assert!(lessons[1]["questions_asked"].as_f64().unwrap() > 0.0, "{lessons:?}");
}

#[test]
fn the_same_seed_gives_the_same_robots() {
    assert_eq!(goodbot(&with(&[]), b"").output, goodbot(&with(&["--seed", "1"]), b"").output);
    assert_ne!(goodbot(&with(&[]), b"").output, goodbot(&with(&["--seed", "2"]), b"").output);
}

#[test]
fn what_they_came_to_can_be_drawn() {
    let run = goodbot(&with(&["--plot", "-"]), b"");
    assert_eq!(run.code, 0, "{}", run.messages);
    assert!(run.output.starts_with("<svg") && run.output.contains("never asks"), "{}", run.output);
    assert!(run.messages.contains("robots with 9 of 10 right"), "{}", run.messages);
}

#[test]
fn what_cannot_be_is_refused() {
    for (arguments, message) in
        [(["--runs", "0"], "--runs"), (["--lessons", "501"], "--lessons"), (["--tests", "-1"], "--tests"), (["--kappa", "0"], "kappa")]
    {
        let run = goodbot(&["ways", arguments[0], arguments[1]], b"");
        assert_eq!(run.code, 2, "{arguments:?}: {}", run.output);
        assert!(run.messages.contains(message), "{arguments:?}: {}", run.messages);
    }
    assert_eq!(goodbot(&["ways", "--force"], b"").code, 2);
}
