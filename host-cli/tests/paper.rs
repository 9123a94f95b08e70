//! `goodbot paper`, as people and programs use it.

use assert_cmd::Command;
use serde_json::Value;
use std::path::PathBuf;

fn goodbot(arguments: &[&str]) -> Command {
    let mut command = Command::cargo_bin("goodbot").expect("the binary is built");
    command.args(arguments);
    command
}

fn output(arguments: &[&str]) -> String {
    let output = goodbot(arguments).assert().success().get_output().stdout.clone();
    String::from_utf8(output).expect("output is UTF-8")
}

/// A folder of its own, emptied.
fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

fn summary(arguments: &[&str]) -> Value {
    let text = output(arguments);
    serde_json::from_str(text.lines().last().expect("a last line")).expect("the last line is JSON")
}

#[test]
fn with_no_argument_one_run_is_told_as_a_story_with_a_picture() {
    let folder = folder("story");
    let assert = goodbot(&[]).current_dir(&folder).assert().success();
    let story = String::from_utf8(assert.get_output().stdout.clone()).unwrap();
    for part in [
        "Lesson 7 of 7",
        "#bbb@bbb#",
        "Trainer: \"take the yellow bag to the red room\"",
        "good bot",
        "bad bot",
        "  <- meant",
        "\"take the purple chair to the green room\": right",
        "5 of 5 right",
        "roomIsGreen    gree",
        "picture: goodbot-paper.svg",
    ] {
        assert!(story.contains(part), "no {part:?} in\n{story}");
    }
    let picture = std::fs::read_to_string(folder.join("goodbot-paper.svg")).unwrap();
    assert!(picture.starts_with("<svg") && picture.contains("shapeBag"), "{picture}");
}

#[test]
fn the_story_leaves_no_picture_where_none_is_wanted() {
    let folder = folder("no-plot");
    goodbot(&["paper", "--no-plot"]).current_dir(&folder).assert().success();
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0);
}

#[test]
fn json_gives_a_line_for_each_run_and_a_summary_in_the_stated_shape() {
    let text = output(&["paper", "--runs", "3", "--seed", "5", "--json"]);
    let lines: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(lines.len(), 4);
    for (line, seed) in lines.iter().zip(5..8) {
        assert_eq!((&line["type"], &line["seed"]), (&"run".into(), &seed.into()));
    }
    let summary = &lines[3];
    let fields = ["type", "trainer", "layouts", "runs", "train_right", "test_right", "test_all_right", "translations", "feedback"];
    assert_eq!(summary.as_object().unwrap().keys().collect::<Vec<_>>(), fields);
    assert_eq!((&summary["type"], &summary["trainer"]), (&"summary".into(), &"balanced".into()));
    assert_eq!((&summary["layouts"], &summary["runs"]), (&"random".into(), &3.into()));
    assert_eq!(summary["train_right"].as_array().unwrap().len(), 7);
    assert_eq!(summary["test_right"].as_array().unwrap().len(), 5);
    for (token, word) in [("agentInRoom", "go"), ("shapeBag", "bag"), ("roomIsRed", "red"), ("blockInRoom", "take")] {
        let mean = lines[..3].iter().map(|run| run["translations"][token][word].as_f64().unwrap()).sum::<f64>() / 3.0;
        assert!((summary["translations"][token][word].as_f64().unwrap() - mean).abs() < 1e-6);
    }
    for said in ["reward", "punish", "neutral"] {
        let sum: u64 = lines[..3].iter().map(|run| run["feedback"][said].as_u64().unwrap()).sum();
        assert_eq!(summary["feedback"][said], sum);
    }
}

#[test]
fn the_same_seed_gives_the_same_bytes_alone_and_among_others() {
    let (first, again) = (output(&["--runs", "8", "--json"]), output(&["paper", "--runs", "8", "--json"]));
    assert_eq!(first, again);
    let alone = output(&["--seed", "4", "--json"]);
    assert_eq!(first.lines().nth(3), alone.lines().next());
    assert_ne!(first.lines().next(), alone.lines().next());
}

/// All five tests right in at least this share of 200 runs, in drawn and in random homes.
fn assert_understood(trainer: &str, bar: f64) {
    for layouts in ["fixed", "random"] {
        let summary = summary(&["paper", "--runs", "200", "--seed", "1", "--json", "--trainer", trainer, "--layouts", layouts]);
        let share = summary["test_all_right"].as_f64().unwrap();
        assert!(share >= bar, "{share} of the runs with {trainer} in {layouts} homes, {bar} wanted");
    }
}

#[test]
fn a_balanced_trainer_gets_all_tests_right_in_19_of_20_runs() {
    assert_understood("balanced", 0.95);
}

#[test]
fn a_trainer_who_only_punishes_gets_all_tests_right_in_49_of_50_runs() {
    assert_understood("punish-only", 0.98);
}

#[test]
fn the_weights_of_the_authors_program_tell_go_from_take_more_clearly() {
    let take = |weights| {
        summary(&["--runs", "40", "--json", "--model", "paper", "--weights", weights])["translations"]["blockInRoom"]["take"]
            .as_f64()
            .unwrap()
    };
    assert!(take("belief") > take("paper"));
}

#[test]
fn a_trainer_that_is_none_is_refused_with_what_would_be_one() {
    for (trainer, fault) in [
        ("strict", "no trainer has this name"),
        ("0.7,0.7", "2 numbers where three are needed"),
        ("0.7,x,0.1", "MU_MINUS is \"x\""),
        ("1.7,0.7,0.1", "mu+ must be a number from 0 to 1"),
        ("0.7,-0.1,0.1", "mu- must be"),
        ("0.7,0.7,NaN", "epsilon must be"),
        ("", "no trainer has this name"),
    ] {
        let assert = goodbot(&["paper", "--trainer", trainer]).assert().code(2);
        let message = String::from_utf8(assert.get_output().stderr.clone()).unwrap();
        assert!(message.contains(fault) && message.contains("MU_PLUS,MU_MINUS,EPSILON such as 0.7,0.7,0.1"), "{message}");
        assert!(assert.get_output().stdout.is_empty());
    }
}

#[test]
fn other_bad_use_exits_with_2() {
    for arguments in [&["--runs", "0"][..], &["--layouts", "round"], &["--seed", "-1"], &["dance"], &["--plot", "a.svg", "--no-plot"]] {
        goodbot(arguments).assert().code(2);
    }
    let missing = folder("bad-plot").join("missing").join("a.svg");
    // So many runs would take an hour: what cannot be written is said before the work.
    goodbot(&["--runs", "1000000", "--plot", missing.to_str().unwrap()]).assert().code(2);
}

#[test]
fn the_picture_of_many_runs_has_a_bar_for_each_lesson_and_test() {
    let file = folder("plot").join("shares.svg");
    let text = output(&["--runs", "5", "--plot", file.to_str().unwrap()]);
    assert!(text.contains("all five"), "{text}");
    let picture = std::fs::read_to_string(file).unwrap();
    for command in ["go to the green room", "take the yellow bag to the red room", "take the blue bag to the yellow room"] {
        assert!(picture.contains(command), "no {command:?}");
    }
}

#[test]
fn help_and_completions_teach() {
    assert!(output(&["--help"]).contains("goodbot --runs 200 --json | tail -1"));
    assert!(output(&["paper", "--help"]).contains("punish-only  0.7,0.05,0.1"));
    for shell in ["bash", "zsh", "fish"] {
        assert!(output(&["completions", shell]).contains("trainer"));
    }
}

#[test]
#[cfg(unix)]
fn a_reader_who_leaves_early_is_no_error() {
    use std::process::{Command, Stdio};
    let mut child = Command::new(env!("CARGO_BIN_EXE_goodbot"))
        .args(["--runs", "400", "--json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{output:?}");
    assert!(output.stderr.is_empty(), "{output:?}");
}
