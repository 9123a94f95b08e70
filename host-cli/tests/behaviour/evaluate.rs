//! `goodbot evaluate`: the training data, the questions, and the report.

use crate::program;

use program::{AGENT, END, Run, goodbot, session, shown, step};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// An agent in the upper room.
const ABOVE: &str = r#"{"class":"agent","name":"agent0","x":2,"y":6}"#;

/// A demonstration of the way to the other room.
fn demonstration(id: &str, above: bool, command: &str) -> String {
    let (agent, room, action) = if above { (ABOVE, "room0", "south") } else { (AGENT, "room1", "north") };
    let intended = format!(r#","intended":["agentInRoom(agent0,{room})"]"#);
    // The star can be mistaken for the intended object.
    let agent = format!(r#"{agent},{{"class":"block","name":"block0","x":6,"y":2,"color":"tan","shape":"star"}}"#);
    let header = session(&agent, "demonstration", command, &intended).replace(r#""id":"s""#, &format!(r#""id":"{id}""#));
    let steps = if above { 3 } else { 2 };
    [vec![header], vec![shown(action); steps], vec![END.to_owned()]].concat().join("\n")
}

/// Sessions of three workers: each goes up and down.
fn log(worker: &str) -> String {
    let up = ["up to the green room", "please walk to the green one", "green"];
    let down = ["down to the red room", "please walk to the red one", "red"];
    let each = up.iter().zip(down).enumerate();
    let both = each.flat_map(|(number, (up, down))| {
        [demonstration(&format!("{worker}.{number}-up"), false, up), demonstration(&format!("{worker}.{number}-down"), true, down)]
    });
    both.collect::<Vec<_>>().join("\n") + "\n"
}

fn three_workers() -> String {
    ["w1", "w2", "w3"].map(log).concat()
}

fn file(folder: &Path, name: &str, content: &str) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, content).expect("a file");
    path
}

fn summary(run: &Run) -> Value {
    assert_eq!(run.code, 0, "{}", run.messages);
    serde_json::from_str(run.output.lines().last().expect("a line")).expect("JSON")
}

fn evaluate(arguments: &[&str], input: &str) -> Value {
    summary(&goodbot(&[&["evaluate", "-", "--json"], arguments].concat(), input.as_bytes()))
}

#[test]
fn each_accuracy_has_an_interval_a_loss_a_calibration_and_a_control_without_words() {
    let all = evaluate(&[], &three_workers());
    assert_eq!((all["asked"].as_u64(), all["sessions"].as_u64()), (Some(18), Some(18)));
    let number = |value: &Value| value.as_f64().expect("a number");
    let (low, high) = (number(&all["interval"][0]), number(&all["interval"][1]));
    assert!(low < number(&all["accuracy"]) && number(&all["accuracy"]) <= high);
    assert!(number(&all["log_loss"]) > 0.0 && number(&all["calibration_error"]) < 1.0);
    // In this log each task has a starting room of its own, so the control without words is right too.
    assert_eq!(all["without_words"]["right"], 18);
    let ranges = all["reliability"].as_array().expect("a table");
    assert_eq!(ranges.iter().map(|range| range["count"].as_u64().unwrap()).sum::<u64>(), 18);
    let text = goodbot(&["evaluate", "-"], three_workers().as_bytes()).output;
    for part in ["accuracy", "without words", "by chance", "calibration error", "how sure"] {
        assert!(text.contains(part), "{part} in {text}");
    }
}

#[test]
fn a_learner_without_words_is_no_better_than_chance_in_random_layouts() {
    let all = evaluate(&["--novel-environments", "5"], &three_workers());
    assert_eq!(all["asked"], 90);
    let wordless = all["without_words"]["accuracy"].as_f64().unwrap();
    assert!(wordless <= 1.0 && all["chance"].as_f64().unwrap() <= 1.0, "{all}");
}

#[test]
fn other_files_are_asked_of_a_model_of_all_that_is_trained_on() {
    let folder = tempfile::tempdir().unwrap();
    let (train, test) = (file(folder.path(), "train.jsonl", &log("w1")), file(folder.path(), "test.jsonl", &log("w2")));
    let run = goodbot(&["evaluate", train.to_str().unwrap(), "--test", test.to_str().unwrap(), "--json"], b"");
    let all = summary(&run);
    assert_eq!((all["sessions"].as_u64(), all["asked"].as_u64(), all["right"].as_u64()), (Some(6), Some(6), Some(6)));
}

#[test]
fn a_model_that_was_learned_before_is_asked_and_answers_as_the_robot_would() {
    let folder = tempfile::tempdir().unwrap();
    let (train, test) = (file(folder.path(), "train.jsonl", &log("w1")), file(folder.path(), "test.jsonl", &log("w2")));
    let model = folder.path().join("model");
    let (train, test, model) = (train.to_str().unwrap(), test.to_str().unwrap(), model.to_str().unwrap());
    assert_eq!(goodbot(&["learn", train, "--out", model], b"").code, 0);
    let run = goodbot(&["evaluate", "--with", model, "--test", test, "--json"], b"");
    assert_eq!(summary(&run)["right"], 6);
    let trained = goodbot(&["evaluate", train, "--test", test, "--json"], b"");
    let probabilities = |run: &Run| -> Vec<f64> {
        let lines = run.output.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
        lines.filter(|line| line["type"] == "answer").map(|line| line["probability_expected"].as_f64().unwrap()).collect()
    };
    for (a, b) in probabilities(&run).iter().zip(probabilities(&trained)) {
        assert!((a - b).abs() < 1e-5, "{a} {b}");
    }
}

#[test]
fn copies_of_sessions_trained_on_are_named_and_counted_apart() {
    let folder = tempfile::tempdir().unwrap();
    let (train, test) = (file(folder.path(), "train.jsonl", &log("w1")), file(folder.path(), "test.jsonl", &(log("w1") + &log("w9"))));
    let run = goodbot(&["evaluate", train.to_str().unwrap(), "--test", test.to_str().unwrap(), "--json"], b"");
    let all = summary(&run);
    // Six have the same id, the other six the same content.
    assert_eq!((all["copies"].as_u64(), all["without_copies"]["asked"].as_u64()), (Some(12), Some(0)));
    assert!(run.messages.contains("w1.0-up of w1.0-up") && run.messages.contains("and 7 more"), "{}", run.messages);
    let none = evaluate(&[], &log("w1"));
    assert_eq!(none["copies"], 0);
}

#[test]
fn groups_are_left_out_together() {
    // A sentence that one worker says twice is no copy if whole workers are left out.
    let twice = log("w1") + &log("w1").replace("w1.", "w1.again") + &log("w2").replace("the ", "that ");
    let apart = |run: Value| run["copies"].as_u64().unwrap();
    let alone = apart(evaluate(&[], &twice));
    let grouped = apart(evaluate(&["--group", "worker"], &twice));
    assert!(grouped < alone, "{grouped} {alone}");
    assert_eq!(evaluate(&["--group", "worker", "--k-fold", "2"], &three_workers())["asked"], 18);
    let one = goodbot(&["evaluate", "-", "--group", "worker"], log("w1").as_bytes());
    assert!(one.code == 2 && one.messages.contains("one worker alone"), "{}", one.messages);
}

#[test]
fn whole_environments_and_tasks_can_be_left_out() {
    // Each environment has one task, so the task asked for was never trained, and the control knows nothing of it.
    for split in ["--leave-environment-out", "--leave-task-out"] {
        let all = evaluate(&[split], &three_workers());
        assert_eq!((all["asked"].as_u64(), all["copies"].as_u64()), (Some(18), Some(0)), "{split}");
    }
}

#[test]
fn sessions_that_do_not_say_what_was_meant_are_counted_and_none_that_does_is_refused() {
    let without = log("w1").replace(r#","intended":["agentInRoom(agent0,room1)"]"#, "");
    let run = goodbot(&["evaluate", "-", "--json"], without.as_bytes());
    assert_eq!((summary(&run)["asked"].as_u64(), summary(&run)["not_asked_without_intended"].as_u64()), (Some(3), Some(3)));
    assert!(run.messages.contains("3 sessions not asked: without \"intended\""), "{}", run.messages);
    let none = without.replace(r#","intended":["agentInRoom(agent0,room0)"]"#, "");
    let run = goodbot(&["evaluate", "-"], none.as_bytes());
    assert_eq!(run.code, 2);
    assert!(run.messages.contains("no session has an intended task"), "{}", run.messages);
}

#[test]
fn sessions_whose_steps_are_clear_are_asked_without_an_intended_task_and_counted_apart() {
    let all = evaluate(&[], &three_workers());
    let without = three_workers().replace(r#","intended":["agentInRoom(agent0,room1)"]"#, "");
    let some = evaluate(&["--clear", "0.6"], &without);
    assert_eq!((some["asked"].as_u64(), some["by_the_steps"]["asked"].as_u64()), (Some(9), Some(9)));
    assert_eq!(some["not_asked_without_intended"].as_u64(), Some(0));
    // Both together are right as often as with what was recorded, and steps that told what was meant are no proof of themselves.
    let right = |summary: &Value| summary["right"].as_u64().unwrap();
    assert_eq!(right(&some) + right(&some["by_the_steps"]), right(&all));
    assert_eq!((some["steps_alone"]["of"].as_u64(), all["steps_alone"]["of"].as_u64()), (Some(9), Some(18)));
    let none = without.replace(r#","intended":["agentInRoom(agent0,room0)"]"#, "");
    let told = evaluate(&["--clear", "0.6"], &none);
    assert_eq!((right(&told), right(&told["by_the_steps"])), (right(&all), right(&all)));
    let text = goodbot(&["evaluate", "-", "--clear", "0.6"], none.as_bytes()).output;
    assert!(text.contains("by the steps       "), "{text}");
    let dark = goodbot(&["evaluate", "-", "--clear", "0.9999999"], none.as_bytes());
    assert!(dark.code == 2 && dark.messages.contains("--clear 0.9"), "{}", dark.messages);
    assert_eq!(goodbot(&["evaluate", "-", "--clear", "0.3"], none.as_bytes()).code, 2);
}

#[test]
fn it_is_told_how_often_the_steps_alone_point_at_what_was_meant() {
    let all = evaluate(&[], &three_workers());
    assert_eq!((all["steps_alone"]["right"].as_u64(), all["steps_alone"]["of"].as_u64()), (Some(18), Some(18)));
    // A trainer without feedback shows nothing: the blocks of both rooms are equally likely.
    let block = format!(r#"{AGENT},{{"class":"block","name":"block0","x":4,"y":2,"color":"tan","shape":"star"}}"#);
    let silent = |id: &str| {
        let intended = r#","intended":["agentInRoom(agent0,room1)"]"#;
        let header = session(&block, "feedback", "up", intended).replace(r#""id":"s""#, &format!(r#""id":"{id}""#));
        [header, step("noop", "neutral"), END.to_owned()].join("\n")
    };
    let all = evaluate(&[], &[silent("a"), silent("b")].join("\n"));
    assert_eq!((all["steps_alone"]["right"].as_u64(), all["steps_alone"]["of"].as_u64()), (Some(0), Some(2)));
}

#[test]
fn labelled_sessions_teach_and_those_with_a_way_are_left_out() {
    let labelled = |number: usize, command: &str, room: &str, above: bool, more: &str| {
        let intended = format!(r#","intended":["agentInRoom(agent0,{room})"]{more}"#);
        let agent = if above { ABOVE } else { AGENT };
        let header = session(agent, "labelled", command, &intended).replace(r#""id":"s""#, &format!(r#""id":"l{number}""#));
        [header, END.to_owned()].join("\n")
    };
    let block = |text: String| {
        text.replace(r#"]},"command""#, r#",{"class":"block","name":"b","x":4,"y":6,"color":"tan","shape":"star"}]},"command""#)
    };
    let lines: Vec<String> = (0..6)
        .flat_map(|number| {
            [labelled(2 * number, "to the green room", "room1", false, ""), labelled(2 * number + 1, "to the red room", "room0", true, "")]
        })
        .map(block)
        .collect();
    let way = labelled(99, "around to the green room", "room1", false, r#","avoiding":["agentInRoom(agent0,room0)"]"#);
    let log = lines.join("\n") + "\n" + &way;
    let run = goodbot(&["evaluate", "-", "--json"], log.as_bytes());
    let all = summary(&run);
    assert_eq!((all["sessions"].as_u64(), all["left_out_with_way"].as_u64(), all["right"].as_u64()), (Some(12), Some(1), Some(12)));
    assert!(run.messages.contains("1 session with a way (through, avoiding) left out"), "{}", run.messages);
    assert_eq!(all["steps_alone"]["of"], 0, "what was told is no evidence of steps");
    let replayed = goodbot(&["replay", "-"], log.as_bytes());
    assert!(replayed.code == 2 && replayed.messages.contains("a labelled session has no steps to go through"), "{}", replayed.messages);
}

#[test]
fn json_and_text_tell_of_the_same_experiment() {
    for split in [&[][..], &["--k-fold", "3"], &["--novel-environments", "2"], &["--group", "worker"]] {
        let json = evaluate(split, &three_workers());
        let text = goodbot(&[&["evaluate", "-"], split].concat(), three_workers().as_bytes()).output;
        let told = format!("{} of {}, log loss {:.3}", json["right"], json["asked"], json["log_loss"].as_f64().unwrap());
        assert!(text.contains(&told), "{told} in {text}");
    }
}

#[test]
fn what_cannot_be_counted_is_said_and_not_counted_as_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (log, model) = (path("log.jsonl"), path("model"));
    fs::write(&log, three_workers()).unwrap();
    let copies = goodbot(&["evaluate", &log, "--test", &log], b"").output;
    assert!(copies.contains("without copies     nothing is left to ask"), "{copies}");
    assert_eq!(goodbot(&["learn", &log, "--out", &model], b"").code, 0);
    let asked = goodbot(&["evaluate", "--with", &model, "--test", &log], b"").output;
    assert!(asked.contains("trained on         nothing here: the model was there"), "{asked}");
    let idle = goodbot(&["evaluate", "--with", &model, "--test", &log, "--seed", "3"], b"");
    assert!(idle.code == 2 && idle.messages.contains("--seed has no effect here"), "{}", idle.messages);
}

#[test]
fn absurd_numbers_and_options_without_effect_are_refused() {
    for arguments in [
        &["--k-fold", "1"][..],
        &["--k-fold", "0"],
        &["--k-fold", "-3"],
        &["--k-fold", "99999999999"],
        &["--k-fold", "ten"],
        &["--k-fold", "19"],
        &["--novel-environments", "0"],
        &["--novel-environments", "100000"],
        &["--runs", "5"],
        &["--force"],
        &["--seed", "5"],
        &["--leave-one-out", "--k-fold", "3"],
        &["--leave-environment-out", "--k-fold", "3"],
        &["--ablation", "--learner", "paper"],
        &["--with", "none", "--learner", "paper"],
    ] {
        let run = goodbot(&[&["evaluate", "-"], arguments].concat(), three_workers().as_bytes());
        assert_eq!(run.code, 2, "{arguments:?}");
        assert!(!run.messages.contains("invalid digit") && !run.messages.contains("non-zero type"), "{}", run.messages);
    }
}

#[test]
fn the_reliability_diagram_has_a_point_for_each_range_of_certainty() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("reliability.svg");
    let run = goodbot(&["evaluate", "-", "--plot", picture.to_str().unwrap(), "--json"], three_workers().as_bytes());
    let ranges = summary(&run)["reliability"].as_array().unwrap().len();
    let svg = fs::read_to_string(picture).unwrap();
    assert_eq!(svg.matches("<circle").count(), ranges, "{svg}");
    assert!(svg.contains("% right"));
}

#[test]
fn more_than_500_sessions_are_left_out_in_ten_parts() {
    let many: String = (0..300)
        .map(|worker| {
            format!(
                "{}\n{}\n",
                demonstration(&format!("{worker}-up"), false, "green"),
                demonstration(&format!("{worker}-down"), true, "red")
            )
        })
        .collect();
    let ten = evaluate(&["--k-fold", "10"], &many);
    let default = evaluate(&[], &many);
    assert_eq!((&default["asked"], &default["log_loss"]), (&600.into(), &ten["log_loss"]));
}

#[test]
fn of_a_model_that_is_there_already_nothing_is_told_that_needs_its_sessions() {
    let folder = tempfile::tempdir().unwrap();
    let [log, model] = ["log.jsonl", "words.goodbot"].map(|name| folder.path().join(name).to_str().unwrap().to_owned());
    std::fs::write(&log, goodbot(&["example", "log"], b"").output).unwrap();
    assert_eq!(goodbot(&["learn", &log, "--out", &model], b"").code, 0);
    let run = goodbot(&["evaluate", "--with", &model, "--test", &log, "--json"], b"");
    let summary: Value = serde_json::from_str(run.output.lines().last().unwrap()).unwrap();
    for part in ["without_words", "copies", "without_copies"] {
        assert!(summary[part].is_null() && summary.get(part).is_some(), "{part}: {summary}");
    }
    assert!(!goodbot(&["evaluate", "--with", &model, "--test", &log], b"").output.contains("without words"));
}
