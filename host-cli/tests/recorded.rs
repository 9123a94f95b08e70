//! Sessions of real trainers, from the data beside the project. Ignored without these data.

#[allow(dead_code, reason = "other tests need more of it")]
#[path = "behaviour/program/mod.rs"]
mod program;

use goodbot_formats::posterior::PosteriorLine;
use libtest_mimic::{Arguments, Failed, Trial};
use program::goodbot;
use std::collections::{HashMap, HashSet};
use std::process::ExitCode;

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data");

fn main() -> ExitCode {
    let absent = !std::path::Path::new(DATA).is_dir();
    let test =
        |name: &str, run: fn() -> Result<(), Failed>| Trial::test(name, run).with_ignored_flag(absent).with_kind("needs ../shared/data");
    let tests = vec![
        test("recorded_files_are_sound", recorded_files_are_sound),
        test(
            "recorded_sessions_give_the_recorded_beliefs_where_there_are_no_blocks",
            recorded_sessions_give_the_recorded_beliefs_where_there_are_no_blocks,
        ),
        test(
            "recorded_commands_need_no_word_where_they_were_given_and_words_in_random_layouts",
            recorded_commands_need_no_word_where_they_were_given_and_words_in_random_layouts,
        ),
    ];
    libtest_mimic::run(&Arguments::from_args(), tests).exit_code()
}

fn data(file: &str) -> String {
    format!("{DATA}/{file}")
}

fn recorded_files_are_sound() -> Result<(), Failed> {
    for file in ["feedback.jsonl", "turk-simplified.jsonl", "feedback-beliefs.jsonl", "routes.jsonl"] {
        let run = goodbot(&["check", &data(file)], b"");
        assert_eq!(run.code, 0, "{}", run.messages);
    }
    Ok(())
}

/// How the beliefs of a replay compare with recorded ones.
#[derive(Debug, Default)]
struct Agreement {
    beliefs: usize,
    within: usize,
    same_task: usize,
    largest: f64,
}

fn largest_difference<'a, K: PartialEq + 'a>(ours: &[(K, f64)], reference: &[(K, f64)]) -> f64 {
    assert_eq!(ours.len(), reference.len());
    let find = |name: &K| reference.iter().find(|(other, _)| other == name).expect("the same names").1;
    ours.iter().map(|(name, probability)| (probability - find(name)).abs()).fold(0.0, f64::max)
}

fn recorded_sessions_give_the_recorded_beliefs_where_there_are_no_blocks() -> Result<(), Failed> {
    let (file, reference) = (data("feedback.jsonl"), data("feedback-beliefs.jsonl"));
    let recorded = std::fs::read_to_string(&file).unwrap();
    let with_blocks: HashSet<String> = goodbot_formats::session::SessionReader::new(recorded.as_bytes())
        .map(|session| session.unwrap().header)
        .filter(|header| header.environment.to_json_line().contains(r#""class":"block""#))
        .map(|header| header.id.unwrap())
        .collect();
    let reference = std::fs::read_to_string(reference).unwrap();
    let parsed = reference.lines().zip(1..).map(|(line, number)| PosteriorLine::parse(line, number).unwrap());
    let reference: HashMap<(String, u64), PosteriorLine> = parsed.map(|belief| ((belief.session.clone(), belief.step), belief)).collect();
    let run = goodbot(&["replay", "--json", &file], b"");
    assert_eq!(run.code, 0, "{}", run.messages);
    let ours: Vec<_> = run.output.lines().zip(1..).map(|(line, number)| PosteriorLine::parse(line, number).unwrap()).collect();
    assert_eq!(ours.len(), reference.len());
    let (mut bare, mut blocks) = (Agreement::default(), Agreement::default());
    for belief in &ours {
        let other = &reference[&(belief.session.clone(), belief.step)];
        let tasks = largest_difference(&belief.tasks, &other.tasks);
        let difference = tasks.max(largest_difference(&belief.strategies, &other.strategies));
        let best = |belief: &PosteriorLine| belief.tasks.iter().map(|&(_, value)| value).fold(0.0, f64::max);
        let likely = belief.tasks.iter().any(|(name, value)| {
            *value >= best(belief) - 1e-6 && other.tasks.iter().any(|(task, value)| task == name && *value >= best(other) - 1e-6)
        });
        let agreement = if with_blocks.contains(&belief.session) { &mut blocks } else { &mut bare };
        agreement.beliefs += 1;
        agreement.within += usize::from(difference <= 1e-4);
        agreement.same_task += usize::from(likely);
        agreement.largest = agreement.largest.max(difference);
    }
    println!("without blocks: {bare:?}");
    println!("with blocks, where the recording planned approximately: {blocks:?}");
    assert!(bare.beliefs > 0);
    assert_eq!(bare.within, bare.beliefs, "{bare:?}");
    Ok(())
}

/// The summary of an evaluation of the simplified commands.
fn evaluation(options: &[&str]) -> serde_json::Value {
    let file = data("turk-simplified.jsonl");
    let run = goodbot(&[&["evaluate", &file, "--json"], options].concat(), b"");
    let summary = run.output.lines().last().expect("a summary");
    serde_json::from_str(summary).expect("the summary is JSON")
}

fn recorded_commands_need_no_word_where_they_were_given_and_words_in_random_layouts() -> Result<(), Failed> {
    let given = evaluation(&[]);
    assert_eq!((&given["asked"], &given["without_words"]["right"]), (&240.into(), &240.into()));
    let elsewhere = evaluation(&["--k-fold", "10", "--novel-environments", "1"]);
    assert!(elsewhere["without_words"]["accuracy"].as_f64().unwrap() < 0.5, "{elsewhere}");
    assert!(elsewhere["accuracy"].as_f64().unwrap() > 0.8, "{elsewhere}");
    Ok(())
}
