//! `goodbot ways`.

use crate::program;

use program::goodbot;

const SMALL: [&str; 9] = ["ways", "--runs", "2", "--lessons", "3", "--every", "2", "--tests", "4"];

fn with<'a>(more: &[&'a str]) -> Vec<&'a str> {
    SMALL.into_iter().chain(more.iter().copied()).collect()
}

#[test]
fn robots_that_learn_ways_are_tested_before_between_and_after_their_lessons() {
    let run = goodbot(&with(&[]), b"");
    assert_eq!(run.code, 0, "{}", run.messages);
    let rows: Vec<Vec<&str>> = run.output.lines().map(|line| line.split_whitespace().collect()).collect();
    let tests: Vec<&Vec<&str>> = rows.iter().filter(|row| ["none", "asked"].contains(&row[0])).collect();
    let told: Vec<(&str, &str)> = tests.iter().map(|test| (test[0], test[1])).collect();
    assert_eq!(told, [("none", "0"), ("none", "2"), ("none", "3"), ("asked", "0"), ("asked", "2"), ("asked", "3")]);
    for test in &tests {
        let (share, right): (f64, f64) = (test[2].parse().unwrap(), test[6].parse().unwrap());
        assert_eq!(test[8], "8");
        assert!((100.0 * right / 8.0 - share).abs() < 0.051, "{test:?}");
    }
    // Both kinds of robots get the same questions before their first lesson.
    assert_eq!(tests[0][6], tests[3][6]);
    let questions: Vec<f64> =
        rows.iter().filter(|row| row.ends_with(&["questions"])).map(|row| row[row.len() - 2].parse().unwrap()).collect();
    assert!(questions[0] == 0.0 && questions[1] > 0.0, "{}", run.output);
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
