//! A program that is killed at any moment loses no lesson that it has told of, and leaves a model and a log that are sound.

use crate::program::goodbot;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg32;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

const LESSON: &str = "command go to the red room\nstep\ngood\nfinish\n";

fn teach(model: &Path, log: &Path) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_goodbot"));
    command.args(["teach", "--lines", "--model"]).arg(model).arg("--log").arg(log);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program runs")
}

/// Teaches lesson after lesson until the program is killed, at a moment up to `most` after its first answer. Returns the number of lessons that
/// it told of.
fn teach_until_killed(model: &Path, log: &Path, most: Duration, random: &mut Pcg32) -> usize {
    let mut child = teach(model, log);
    let mut input = child.stdin.take().expect("an input");
    let mut output = BufReader::new(child.stdout.take().expect("an output"));
    let mut ready = String::new();
    output.read_line(&mut ready).expect("an answer");
    let mut messages = String::new();
    if ready.is_empty() {
        child.stderr.take().expect("messages").read_to_string(&mut messages).expect("messages are UTF-8");
    }
    assert!(ready.contains("ready"), "{ready}{messages}");
    let reader = std::thread::spawn(move || {
        let lines = output.lines().map_while(Result::ok);
        lines.filter(|line| line.contains("\"learned\":true")).count()
    });
    let writer = std::thread::spawn(move || while input.write_all(LESSON.as_bytes()).is_ok() {});
    std::thread::sleep(most.mul_f64(f64::from(random.next_u32()) / f64::from(u32::MAX)));
    child.kill().expect("the program is killed");
    child.wait().expect("the program ends");
    writer.join().expect("a closed pipe ends it");
    reader.join().expect("a closed pipe ends it")
}

fn killed(times: usize) {
    let folder = tempfile::tempdir().unwrap();
    let (model, log) = (folder.path().join("m.goodbot"), folder.path().join("m.jsonl"));
    let mut random = Pcg32::seed_from_u64(200);
    let mut told = 0;
    for _ in 0..times {
        told += teach_until_killed(&model, &log, Duration::from_millis(120), &mut random);
    }
    // The next teacher rolls back the end of a lesson that was under way, and can teach.
    let mut last = teach(&model, &log);
    last.stdin.take().expect("an input").write_all(LESSON.as_bytes()).expect("the program reads");
    let end = last.wait_with_output().expect("the program ends");
    assert!(end.status.success(), "{}", String::from_utf8_lossy(&end.stderr));
    told += String::from_utf8_lossy(&end.stdout).matches("\"learned\":true").count();
    let lessons = |arguments: &[&str]| {
        let run = goodbot(arguments, b"");
        assert_eq!(run.code, 0, "{arguments:?}: {}", run.messages);
        run.output.matches("go to the red room").count()
    };
    let (model, log) = (model.to_str().unwrap(), log.to_str().unwrap());
    assert_eq!(goodbot(&["check", log], b"").code, 0);
    let kept = std::fs::read_to_string(log).unwrap().matches("\"type\":\"end\",\"learn\":true").count();
    let listed = lessons(&["inspect", model, "--sessions"]);
    println!("kills of a teaching program: {times}; lessons told {told}, in the log {kept}, listed in the model {listed}");
    assert!(told > 0 && kept >= told && listed >= told, "{told} told, {kept} in the log, {listed} in the model");
}

#[test]
fn a_teacher_killed_at_any_moment_loses_no_lesson_that_was_told() {
    killed(40);
}

#[test]
#[ignore = "takes a minute; docs/reliability.md has its figures"]
fn two_hundred_kills() {
    killed(200);
}
