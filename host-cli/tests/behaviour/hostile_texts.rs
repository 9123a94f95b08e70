//! Files of strangers, whose names, words and ids have characters that a terminal obeys: no command sends them on, and lines of JSON and
//! pictures stay well-formed.

use crate::program::goodbot;
use goodbot_tests::hostile::{COMMANDS, PICTURES, Place, TRIES, assert_harmless};
use serde_json::Value;

#[test]
fn no_command_sends_the_terminal_what_it_would_obey() {
    for hostile in TRIES {
        let place = Place::new(hostile);
        for command in COMMANDS {
            let run = assert_harmless(&place, command, hostile, &goodbot);
            let is_misused = run.messages.contains("For more information");
            assert!(!is_misused || command.contains("--task"), "{command}: {}", run.messages);
        }
        for picture in PICTURES {
            assert!(std::path::Path::new(&place.file(picture)).exists(), "{picture}");
        }
    }
}

#[test]
fn lines_of_json_keep_the_words_of_a_stranger() {
    let hostile = "\u{9b}\u{202e}\u{e0041}";
    let run = Place::new(hostile).run("check --json log.jsonl", hostile, "", &goodbot);
    assert_eq!((run.code, run.output.is_ascii()), (0, true), "{}", run.output);
    let run = Place::new(hostile).run("replay log.jsonl --json", hostile, "", &goodbot);
    let first: Value = serde_json::from_str(run.output.lines().next().expect("a line")).unwrap();
    assert_eq!(first["session"], format!("s0{hostile}"));
}

#[test]
fn memory_follows_what_a_model_contains_and_not_what_it_claims() {
    // Its head says that it was saved from memory with room for 2^32 - 1 strategies.
    let claims = include_bytes!("hostile_texts/strategies-ffffffff.goodbot");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("claims.goodbot");
    std::fs::write(&file, claims).unwrap();
    let file = file.to_str().unwrap();
    let limited = format!("ulimit -v 300000; exec {} inspect {file}", env!("CARGO_BIN_EXE_goodbot"));
    let run = std::process::Command::new("sh").args(["-c", &limited]).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
}
