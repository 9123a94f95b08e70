//! What the page exported in the browser, on the host: the same belief to the last bit, a log that its reader takes, a home that is one.
//!
//! The browser tests leave the files in the folder that `GOODBOT_PAGE_EXPORT` names; without it, these tests are ignored.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use goodbot_formats::session::SessionReader;
use goodbot_wasm::World;
use goodbot_wasm::world::check;
use libtest_mimic::{Arguments, Failed, Trial};
use serde_json::Value;

const EXPORT: &str = "GOODBOT_PAGE_EXPORT";

fn main() -> ExitCode {
    let folder = std::env::var_os(EXPORT).map(PathBuf::from);
    // With `later` they are skipped now, and run after the browser tests.
    if folder.as_deref() == Some(Path::new("later")) {
        return libtest_mimic::run(&Arguments::from_args(), Vec::new()).exit_code();
    }
    let test = |name: &str, run: fn(&Path)| {
        let folder = folder.clone();
        let absent = folder.is_none();
        let run = move || folder.as_deref().map(run).ok_or(Failed::from(format!("{EXPORT} is not set")));
        Trial::test(name, run).with_ignored_flag(absent).with_kind("needs the page's export")
    };
    let tests = vec![
        test("a_model_from_the_page_answers_here_with_the_same_bits", a_model_from_the_page_answers_here_with_the_same_bits),
        test(
            "the_session_log_of_the_page_is_read_back_and_teaches_the_same_model",
            the_session_log_of_the_page_is_read_back_and_teaches_the_same_model,
        ),
        test("a_home_drawn_in_the_page_is_accepted_here", a_home_drawn_in_the_page_is_accepted_here),
    ];
    libtest_mimic::run(&Arguments::from_args(), tests).exit_code()
}

fn read(folder: &Path, file: &str) -> Vec<u8> {
    std::fs::read(folder.join(file)).unwrap_or_else(|error| panic!("{file}: {error}"))
}

fn a_model_from_the_page_answers_here_with_the_same_bits(folder: &Path) {
    let asked: Value = serde_json::from_slice(&read(folder, "asked.json")).unwrap();
    let mut world = World::new(1).unwrap();
    world.restore(&read(folder, "model.goodbot")).unwrap();
    while !world.learn(u32::MAX) {}
    world.set_environment(asked["environment"].as_str().unwrap()).unwrap();
    world.hear(asked["command"].as_str().unwrap()).unwrap();
    let tasks = world.belief().tasks;
    let theirs = asked["belief"]["tasks"].as_array().unwrap();
    assert_eq!(tasks.len(), theirs.len());
    for (ours, theirs) in tasks.iter().zip(theirs) {
        assert_eq!(ours.name, theirs["name"].as_str().unwrap());
        // The page writes the shortest decimal that is read as the same number: no bit is lost on the way.
        let probability: f32 = theirs["probability"].to_string().parse().unwrap();
        assert_eq!(ours.probability.to_bits(), probability.to_bits(), "{}", ours.name);
    }
}

fn the_session_log_of_the_page_is_read_back_and_teaches_the_same_model(folder: &Path) {
    let log = read(folder, "sessions.jsonl");
    let mut world = World::new(1).unwrap();
    for session in SessionReader::new(&log[..]) {
        let session = session.unwrap();
        assert!(session.learn);
        world.replay(&session).unwrap();
    }
    assert_eq!(world.sessions(), 7);
    assert_eq!(world.save().unwrap(), read(folder, "model.goodbot"));
}

fn a_home_drawn_in_the_page_is_accepted_here(folder: &Path) {
    check(&String::from_utf8(read(folder, "home.json")).unwrap()).unwrap();
}
