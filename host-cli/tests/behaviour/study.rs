//! `goodbot study`, as people and programs use it.

#[allow(dead_code, reason = "the rest is for other tests")]
use crate::program;

use program::{Run, goodbot};
use serde_json::Value;
use std::path::PathBuf;

/// A folder of its own, emptied.
fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

fn study(arguments: &[&str]) -> Run {
    goodbot(&[&["study"], arguments].concat(), b"")
}

fn output(arguments: &[&str]) -> String {
    let run = study(arguments);
    assert_eq!(run.code, 0, "{}", run.messages);
    run.output
}

fn refused(arguments: &[&str], fault: &str) {
    let run = study(arguments);
    assert_eq!(run.code, 2, "{arguments:?}: {}", run.messages);
    assert!(run.messages.contains(fault), "{arguments:?}: no {fault:?} in {}", run.messages);
    assert!(run.output.is_empty(), "{}", run.output);
}

const SMALL: [&str; 10] =
    ["--courses", "paper", "--agents", "paper,tamer+roles", "--trainers", "balanced,population", "--runs", "4", "--seed", "40"];

fn small(more: &[&str]) -> Vec<String> {
    SMALL.iter().chain(more).map(|argument| (*argument).to_owned()).collect()
}

fn small_output(more: &[&str]) -> String {
    let arguments = small(more);
    output(&arguments.iter().map(String::as_str).collect::<Vec<_>>())
}

#[test]
fn there_is_a_line_for_each_run_and_one_for_each_course_trainer_and_agent() {
    let text = small_output(&["--json"]);
    let lines: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let of = |kind: &str| lines.iter().filter(|line| line["type"] == kind).collect::<Vec<_>>();
    assert_eq!((of("study").len(), of("run").len()), (1, 4 * 2 * 2));
    let names: Vec<(&str, &str)> =
        of("summary").iter().map(|line| (line["trainer"].as_str().unwrap(), line["agent"].as_str().unwrap())).collect();
    let trainers = ["balanced", "population"];
    assert_eq!(names, trainers.iter().flat_map(|trainer| [(*trainer, "paper"), (*trainer, "tamer+roles")]).collect::<Vec<_>>());
    // The summary matches the runs above it.
    let paper = |line: &&&Value| line["trainer"] == "balanced" && line["agent"] == "paper";
    let (runs, summaries) = (of("run"), of("summary"));
    let words: u64 = runs.iter().filter(paper).flat_map(|run| run["words"].as_array().unwrap()).map(|count| count.as_u64().unwrap()).sum();
    let mean = summaries.iter().find(paper).unwrap()["words"]["mean"].as_f64().unwrap();
    assert!((mean - words as f64 / 4.0).abs() < 1e-9, "{mean}");
}

#[test]
fn the_same_seed_gives_the_same_bytes_on_one_core_and_on_many_and_among_other_agents() {
    let many = small_output(&["--json"]);
    let one = std::process::Command::new(env!("CARGO_BIN_EXE_goodbot"))
        .arg("study")
        .args(small(&["--json"]))
        .env("RAYON_NUM_THREADS", "1")
        .output()
        .expect("the program runs");
    assert_eq!(many, String::from_utf8(one.stdout).unwrap());
    let alone = output(&["--courses", "paper", "--agents", "paper", "--trainers", "population", "--runs", "1", "--seed", "43", "--json"]);
    let run = alone.lines().nth(1).unwrap();
    assert!(many.lines().any(|line| line == run), "{run}");
}

#[test]
fn names_that_are_none_are_refused_with_those_that_are_alike() {
    refused(&["--agents", "tamer+rolls"], "'tamer+roles'");
    refused(&["--courses", "freed"], "'free'");
    refused(&["--trainers", "punish"], "'punish-only'");
    refused(&["--agents", ""], "possible values");
}

/// A program that answers every command with these numbers: `ZEROS` is a zero for each task.
#[cfg(unix)]
fn language(name: &str, answer: &str) -> String {
    let file = folder(name).join("language.sh");
    let zeros = r#"$(printf %s "$line" | grep -o '\],\[' | sed 's/.*/,0/' | tr -d '\n')"#;
    let answer = answer.replace("ZEROS", &format!("0{zeros}"));
    let script = format!(r#"while read -r line; do case "$line" in *'"hear"'*) echo "[{answer}]";; esac; done"#);
    std::fs::write(&file, script).expect("a script");
    format!("sh {}", file.display())
}

#[test]
#[cfg(unix)]
fn a_program_is_a_language_and_one_that_knows_nothing_is_as_good_as_none() {
    let ask = |agent: &str, more: &[&str]| {
        let text = output(&[&["--courses", "told", "--trainers", "balanced", "--runs", "2", "--json", "--agents", agent], more].concat());
        text.lines().filter(|line| line.contains(r#""type":"run""#)).map(|line| line.replace(agent, "AGENT")).collect::<Vec<_>>()
    };
    let zeros = language("study-zeros", "ZEROS");
    let asked = ask("sabl+program", &["--program", &zeros]);
    assert_eq!((asked.len(), &asked), (2, &ask("sabl+none", &[])));
}

#[test]
#[cfg(unix)]
fn a_program_that_is_missing_or_answers_wrongly_is_a_fault_with_its_name() {
    refused(
        &["--agents", "sabl+program", "--runs", "1"],
        "the language of sabl+program is a program of yours; give its command by --program",
    );
    refused(&["--agents", "sabl+roles", "--runs", "1", "--program", "sh"], "no agent asks the program; name one, such as sabl+program");
    for (program, fault) in [
        ("no-such-program".to_owned(), "cannot be started"),
        ("true".to_owned(), "its own messages say why"),
        (language("study-few", "0"), "which is no list of 9 finite numbers"),
        (language("study-huge", "1e99,ZEROS"), "which is no list of 9 finite numbers"),
        (language("study-text", "x"), "which is no list of 9 finite numbers"),
    ] {
        let run = study(&["--agents", "sabl+program", "--courses", "told", "--runs", "1", "--program", &program]);
        assert_eq!(run.code, 1, "{program}: {}", run.messages);
        assert!(run.messages.contains(fault) && run.messages.contains(&program), "{program}: {}", run.messages);
    }
}

#[test]
#[cfg(unix)]
fn a_program_that_never_answers_ends_the_study_with_what_to_do() {
    let asked = ["--agents", "sabl+program", "--courses", "told", "--runs", "1", "--program", "sleep 600", "--program-seconds", "1"];
    let run = study(&asked);
    assert_eq!(run.code, 1, "{}", run.messages);
    for part in ["\"sleep 600\" gave no answer in 1 second;", "raise --program-seconds"] {
        assert!(run.messages.contains(part), "no {part:?} in {}", run.messages);
    }
}

#[test]
#[cfg(unix)]
fn with_a_program_every_inference_has_it_as_one_of_its_languages() {
    let zeros = language("study-every", "ZEROS");
    let text = output(&["--courses", "told", "--trainers", "mute", "--runs", "2", "--program", &zeros, "--program-runs", "1", "--csv"]);
    let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 6 * 5, "{text}");
    let agents: Vec<&str> = rows[..5].iter().map(|row| row[2]).collect();
    assert_eq!(agents, ["this+roles", "this+model2", "this+loglinear", "this+program", "this+none"]);
    let with: Vec<&str> = rows.iter().filter(|row| row[2].ends_with("+program")).map(|row| row[4]).collect();
    assert_eq!(with, ["1"; 6], "the program has the first seed only: {text}");
}

#[test]
fn numbers_that_are_none_are_refused_with_what_to_give() {
    refused(&["--runs", "0"], "give a whole number from 1 to 100000");
    refused(&["--runs", "-3"], "give a whole number from 1 to 100000");
    refused(&["--seed", "x"], "give a whole number from 0");
}

#[test]
fn a_fit_tells_what_trainers_of_a_log_do_and_checks_simulated_ones() {
    let log = goodbot(&["example", "log"], b"").output;
    let folder = folder("study-fit");
    let file = folder.join("log.jsonl");
    std::fs::write(&file, &log).unwrap();
    let text = output(&["--fit", file.to_str().unwrap(), "--runs", "5"]);
    for part in ["people", "judge the last action", "silence after a wrong action", "(fitted)"] {
        assert!(text.contains(part), "no {part:?} in {text}");
    }
    assert_eq!(text, output(&["--fit", file.to_str().unwrap(), "--runs", "5"]));
    assert_eq!(text.lines().filter(|line| line.starts_with("| ")).count(), 1 + 11, "{text}");
    let home = folder.join("home.json");
    std::fs::write(&home, goodbot(&["example", "home"], b"").output).unwrap();
    refused(&["--fit", home.to_str().unwrap()], "not a session log");
}

#[test]
fn help_teaches_and_names_all_courses_agents_and_trainers() {
    let help = goodbot(&["study", "--help"], b"").output;
    for part in ["told", "tamer+roles", "punish-only", "wrongly_certain"] {
        assert!(help.contains(part), "no {part:?} in {help}");
    }
}

#[test]
fn tables_are_for_a_page_and_a_plot_is_for_beside_them() {
    let folder = folder("study-plot");
    let plot = folder.join("study.svg");
    let named = plot.to_str().unwrap();
    let tables = small_output(&["--tables", "--plot", named]);
    assert!(tables.contains("### Course paper") && tables.contains("| `tamer+roles` |"), "{tables}");
    assert!(std::fs::read_to_string(&plot).unwrap().contains("<svg"));
    // The study's own picture may be replaced; a foreign one may not.
    small_output(&["--plot", named]);
    std::fs::write(&plot, "mine").unwrap();
    refused(&["--plot", named, "--runs", "1"], "is no picture of goodbot's");
    assert_eq!(std::fs::read_to_string(&plot).unwrap(), "mine");
}
