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
fn with_no_argument_one_run_is_told_as_a_story_and_no_file_is_written() {
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
        "colorGreen     green",
    ] {
        assert!(story.contains(part), "no {part:?} in\n{story}");
    }
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0);
}

#[test]
fn the_picture_of_one_run_shows_whole_words() {
    let file = folder("one-run").join("words.svg");
    output(&["--plot", file.to_str().unwrap()]);
    let picture = std::fs::read_to_string(file).unwrap();
    assert!(picture.starts_with("<svg") && picture.contains("shapeBag") && picture.contains("chair"), "{picture}");
}

#[test]
fn json_and_csv_show_the_same_experiment_as_the_story() {
    let json = output(&["paper", "--seed", "3", "--json"]);
    assert!(json.lines().last().unwrap().contains(r#""layouts":"fixed""#), "{json}");
    let run: Value = serde_json::from_str(json.lines().next().unwrap()).unwrap();
    let story = output(&["paper", "--seed", "3"]);
    for (lesson, steps) in ["go to the green room", "go to the red room"].iter().zip(run["steps"].as_array().unwrap()) {
        let line = story.lines().find(|line| line.trim_start().starts_with(lesson) && line.ends_with("goal")).unwrap();
        assert!(line.split_whitespace().any(|part| part.parse() == Ok(steps.as_u64().unwrap())), "{line}: {steps}");
    }
    let csv = output(&["paper", "--seed", "3", "--csv"]);
    assert!(csv.lines().nth(1).unwrap().contains(",fixed,"), "{csv}");
}

#[test]
fn the_second_trainer_never_rewards_while_the_agent_believes_the_papers_numbers() {
    let punish = summary(&["paper", "--runs", "20", "--trainer", "punish-only", "--json"]);
    assert_eq!((&punish["trainer"], &punish["believes"]), (&"punish-only".into(), &"punish-only".into()));
    assert_eq!(punish["feedback"]["reward"], 0);
    assert!(punish["feedback"]["punish"].as_u64().unwrap() > 0);
    let reward = summary(&["paper", "--runs", "20", "--trainer", "reward-only", "--json"]);
    assert_eq!(reward["feedback"]["punish"], 0);
    // A trainer by numbers both rewards and punishes.
    let numbers = summary(&["paper", "--runs", "20", "--trainer", "0.7,0.05,0.1", "--json"]);
    assert!(numbers["feedback"]["reward"].as_u64().unwrap() > 0);
}

#[test]
fn what_the_agent_believes_of_its_trainer_is_another_thing_than_what_the_trainer_does() {
    let believes = |more: &[&str]| {
        let arguments = [&["paper", "--runs", "5", "--trainer", "punish-only", "--layouts", "random", "--json"], more].concat();
        (summary(&arguments), output(&arguments))
    };
    let (same, same_text) = believes(&["--believes", "0.7,0.05,0.1"]);
    let (default, default_text) = believes(&[]);
    assert_eq!(same_text.lines().next(), default_text.lines().next(), "the paper's numbers are the default");
    assert_eq!((&same["believes"], &default["believes"]), (&"0.7,0.05,0.1".into(), &"punish-only".into()));
    let (balanced, balanced_text) = believes(&["--believes", "balanced"]);
    assert_eq!(balanced["believes"], "balanced");
    assert_ne!(balanced_text.lines().next(), default_text.lines().next());
    goodbot(&["paper", "--believes", "strict"]).assert().code(2);
}

#[test]
fn the_papers_own_numbers_and_intervals_stand_beside_ours() {
    let balanced = summary(&["paper", "--runs", "20", "--json"]);
    assert_eq!((&balanced["paper"]["tests_right"], &balanced["paper"]["translations"]["agentInRoom"]["go"]), (&5.into(), &0.51.into()));
    let interval = balanced["test_all_right_interval"].as_array().unwrap();
    let share = balanced["test_all_right"].as_f64().unwrap();
    assert!(interval[0].as_f64().unwrap() < share && share <= interval[1].as_f64().unwrap());
    assert_eq!(summary(&["paper", "--runs", "2", "--trainer", "punish-only", "--json"])["paper"]["tests_right"], 4);
    assert!(summary(&["paper", "--runs", "2", "--trainer", "reward-only", "--json"])["paper"].is_null());
    let text = output(&["paper", "--runs", "20", "--trainer", "punish-only"]);
    assert!(text.contains("(never rewards)") && text.contains("paper: 4 of 5 right"), "{text}");
}

#[test]
fn comma_separated_values_have_a_line_of_names_and_one_of_values_in_their_order() {
    let csv = output(&["paper", "--runs", "2", "--trainer", "0.5,0.7,0.1", "--csv"]);
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines.len(), 2);
    assert!(lines[0].starts_with("trainer,believes,layouts,learner,seed,runs,all_right,"), "{csv}");
    assert!(lines[1].starts_with(r#""0.5,0.7,0.1","0.5,0.7,0.1",random,roles,1,2,"#), "{csv}");
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
    let fields = [
        "type",
        "trainer",
        "believes",
        "layouts",
        "learner",
        "runs",
        "train_right",
        "train_right_intervals",
        "test_right",
        "test_right_intervals",
        "test_all_right",
        "test_all_right_interval",
        "translations",
        "translations_half_intervals",
        "feedback",
        "paper",
    ];
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
    let alone = output(&["--seed", "4", "--layouts", "random", "--json"]);
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
        summary(&["--runs", "40", "--json", "--learner", "paper", "--weights", weights])["translations"]["blockInRoom"]["take"]
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
    for arguments in
        [&["--runs", "0"][..], &["--layouts", "round"], &["--seed", "-1"], &["dance"], &["--plot", "-", "--runs", "2"], &["--force"]]
    {
        goodbot(arguments).assert().code(2);
    }
    let missing = folder("bad-plot").join("missing").join("a.svg");
    // A file that cannot be written is refused before the run.
    goodbot(&["--plot", missing.to_str().unwrap()]).assert().code(2);
}

#[test]
#[cfg(unix)]
fn a_reader_who_leaves_early_is_no_error() {
    use std::process::{Command, Stdio};
    let mut child = Command::new(env!("CARGO_BIN_EXE_goodbot"))
        .args(["--runs", "20", "--json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{output:?}");
    assert!(output.stderr.is_empty(), "{output:?}");
}
