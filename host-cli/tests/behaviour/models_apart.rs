//! `goodbot diff`, `goodbot unlearn`, `goodbot learn --without` and `goodbot doctor`: differences, removed sessions, and faults.

use crate::program::{AGENT, END, goodbot, session};
use std::fs;
use tempfile::TempDir;

/// A folder with a log of three labelled lessons, and their model.
struct Place(TempDir);

impl Place {
    fn new() -> Self {
        let place = Self(tempfile::tempdir().unwrap());
        let lesson = |id: &str, command: &str| {
            let told = session(AGENT, "labelled", command, r#","intended":["agentInRoom(agent0,room1)"]"#);
            told.replace(r#""id":"s""#, &format!(r#""id":"{id}""#)) + "\n" + END + "\n"
        };
        let log = lesson("first", "go to the green room") + &lesson("second", "upstairs please") + &lesson("third", "go to the green room");
        fs::write(place.path("log.jsonl"), log).unwrap();
        place.run(&["learn", "LOG", "--out", "A"]);
        place
    }

    fn path(&self, name: &str) -> String {
        self.0.path().join(name).to_str().unwrap().to_owned()
    }

    /// Runs the program, which must succeed. LOG, A, B and C are files in the folder.
    #[track_caller]
    fn run(&self, arguments: &[&str]) -> String {
        let run = self.try_run(arguments);
        assert_eq!(run.code, 0, "{arguments:?}: {}", run.messages);
        run.output
    }

    fn try_run(&self, arguments: &[&str]) -> crate::program::Run {
        let file = |name: &&str| match *name {
            "LOG" => self.path("log.jsonl"),
            "A" | "B" | "C" => self.path(&name.to_lowercase()),
            other => other.to_owned(),
        };
        let arguments: Vec<String> = arguments.iter().map(file).collect();
        goodbot(&arguments.iter().map(String::as_str).collect::<Vec<_>>(), b"")
    }
}

#[test]
fn a_session_is_unlearned_by_its_number_and_left_out_of_learning() {
    let place = Place::new();
    assert!(place.run(&["inspect", "A", "--sessions"]).contains("    2  upstairs please"));
    place.run(&["unlearn", "A", "2", "--out", "B"]);
    assert!(!place.run(&["inspect", "B"]).contains("upstairs"));
    place.run(&["learn", "LOG", "--without", "second", "--out", "C"]);
    assert!(place.run(&["diff", "B", "C"]).contains("They know the same."));
}

#[test]
fn a_session_that_there_is_not_is_told_with_where_to_look() {
    let place = Place::new();
    for (arguments, parts) in [
        (&["unlearn", "A", "4", "--out", "B"][..], ["has 3 sessions", "goodbot inspect --sessions"]),
        (&["unlearn", "A", "second", "--out", "B"], ["is no number", "goodbot inspect --sessions"]),
        (&["learn", "LOG", "--without", "fourth", "--out", "B"], ["no session has the id \"fourth\"", "--without"]),
    ] {
        let run = place.try_run(arguments);
        assert_eq!(run.code, 2, "{arguments:?}");
        assert!(parts.iter().all(|part| run.messages.contains(part)), "{arguments:?}: {}", run.messages);
    }
}

#[test]
fn a_difference_is_told_by_sessions_and_words() {
    let place = Place::new();
    assert!(place.run(&["diff", "A", "A"]).contains("They know the same."));
    place.run(&["unlearn", "A", "2", "--out", "B"]);
    let told = place.run(&["diff", "A", "B"]);
    let name = place.path("a");
    assert!(told.contains(&format!("Sessions that only {name} has:\n  upstairs please")), "{told}");
    assert!(told.contains(&format!("Words that only {name} has:\n")) && told.contains("\n  upstairs\n"), "{told}");
    let lines = place.run(&["diff", "B", "A", "--json", "--least", "0"]);
    assert!(lines.contains(r#"{"type":"session added","text":"upstairs please"}"#), "{lines}");
    assert!(lines.contains(r#""type":"word moved""#), "{lines}");
}

#[test]
#[cfg(unix)]
fn control_characters_in_the_names_of_compared_models_are_shown_and_not_obeyed() {
    let place = Place::new();
    let odd = place.path("m\u{1b}[31m.goodbot");
    place.run(&["unlearn", "A", "2", "--out", &odd]);
    let told = place.run(&["diff", "A", &odd]);
    assert!(told.contains("m\\u001b[31m.goodbot: 2 sessions") && !told.contains('\u{1b}'), "{told:?}");
    let told = place.run(&["diff", &odd, "A"]);
    assert!(told.contains("m\\u001b[31m.goodbot: 2 sessions") && !told.contains('\u{1b}'), "{told:?}");
}

#[test]
#[cfg(target_os = "linux")]
fn the_doctor_finds_damaged_robots_broken_logs_and_robots_that_lack_sessions_of_their_log() {
    let place = Place::new();
    let folder = place.0.path().join("goodbot");
    fs::create_dir(&folder).unwrap();
    place.run(&["unlearn", "A", "1", "--out", "B"]);
    fs::copy(place.path("b"), folder.join("rex.goodbot")).unwrap();
    fs::copy(place.path("log.jsonl"), folder.join("rex.jsonl")).unwrap();
    fs::write(folder.join(".rex.goodbot.Ab3dEf.part"), "half").unwrap();
    let model = fs::read(place.path("a")).unwrap();
    fs::write(folder.join("torn.goodbot"), &model[..model.len() / 2]).unwrap();
    fs::copy(place.path("a"), folder.join("other.goodbot")).unwrap();
    fs::write(folder.join("other.jsonl"), r#"{"version":1,"objects":[]}"#).unwrap();
    let mut doctor = std::process::Command::new(env!("CARGO_BIN_EXE_goodbot"));
    let told = doctor.arg("doctor").env("XDG_DATA_HOME", place.0.path()).output().unwrap();
    assert_eq!(told.status.code(), Some(1));
    assert!(String::from_utf8(told.stderr).unwrap().contains("2 things wrong; see above what to do"));
    let told = String::from_utf8(told.stdout).unwrap();
    let wrong = |name: &str| told.lines().find(|line| line.contains(name)).unwrap().trim_start().starts_with("wrong");
    assert!(wrong("torn.goodbot") && wrong("other.jsonl"), "{told}");
    assert!(told.contains("rex.goodbot: knows 2 sessions, and its log has 3"), "{told}");
    assert!(told.contains("was stopped while it wrote this"), "{told}");
}
