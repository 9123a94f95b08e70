//! A new user's first hour: messages say what to do next in the user's words, and no text of a file controls the terminal.

use crate::program::{Run, goodbot};
use std::fs;

/// A home of one room with this width.
fn home(width: u32, name: &str) -> String {
    format!(
        r#"{{"version":1,"objects":[{{"class":"room","name":"{name}","left":0,"bottom":0,"right":{width},"top":{width},"color":"red"}},{{"class":"agent","name":"agent0","x":1,"y":1}}]}}"#
    )
}

#[track_caller]
fn assert_refused(run: &Run, parts: &[&str]) {
    assert_eq!(run.code, 2, "{}{}", run.output, run.messages);
    for part in parts {
        assert!(run.messages.contains(part), "{part:?} in {}", run.messages);
    }
    for library in ["Capacities::", "capacity::", "Asking::", "raise it"] {
        assert!(!run.messages.contains(library), "{library:?} in {}", run.messages);
    }
}

#[test]
fn a_micro_bits_program_that_is_not_there_is_told_with_how_to_make_it() {
    let run = goodbot(&["microbit", "--hex", "not/there.hex", "-m", "words.goodbot", "-o", "mine.hex"], b"");
    assert_refused(&run, &["not/there.hex: is not there", "cargo xtask microbit"]);
}

#[test]
fn a_number_that_cannot_be_is_refused_with_one_that_can() {
    for number in ["-1", "NaN"] {
        assert_refused(&goodbot(&["evaluate", "--clear", number], b""), &["--clear", "such as"]);
    }
    assert_refused(&goodbot(&["paper", "--runs", "-1"], b""), &["--runs", "give a whole number"]);
}

#[test]
fn a_home_that_is_too_large_is_refused_in_words_of_homes() {
    let folder = tempfile::tempdir().unwrap();
    let (large, long) = (folder.path().join("large.json"), folder.path().join("long.json"));
    fs::write(&large, home(60, "room0")).unwrap();
    fs::write(&long, home(6, &"r".repeat(300))).unwrap();
    for (file, parts) in [(&large, ["free cells in a home", "make rooms smaller"]), (&long, ["bytes in a word or name", "shorten it"])] {
        let file = file.to_str().unwrap();
        assert_refused(&goodbot(&["check", file], b""), &parts);
        assert_refused(&goodbot(&["teach", file], b""), &parts);
        assert_refused(&goodbot(&["size", file], b""), &parts);
    }
}

#[test]
#[cfg(unix)]
fn a_name_of_a_file_does_not_move_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("red\u{1b}[31m.json");
    fs::write(&file, "not a home").unwrap();
    let file = file.to_str().unwrap();
    for arguments in
        [&["check", file][..], &["learn", file, "-o", "m"], &["replay", file], &["inspect", file], &["teach", file], &["evaluate", file]]
    {
        let run = goodbot(arguments, b"");
        assert!(!run.messages.contains('\u{1b}') && !run.output.contains('\u{1b}'), "{arguments:?}: {}{}", run.output, run.messages);
        assert!(run.messages.contains(r"red\u001b[31m"), "{arguments:?}: {}", run.messages);
    }
    let run = goodbot(&["paper", "--trainer", "\u{1b}[31m"], b"");
    assert!(run.code == 2 && !run.messages.contains('\u{1b}'), "{}", run.messages);
}

#[test]
fn the_story_fits_a_terminal_of_eighty_columns() {
    for trainer in ["balanced", "punish-only"] {
        let run = goodbot(&["paper", "--trainer", trainer, "--layouts", "random"], b"");
        for line in run.output.lines() {
            assert!(line.chars().count() <= 80, "{line}");
        }
    }
}

#[test]
fn the_picture_of_learned_words_in_the_documentation_is_that_of_its_command() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("learned-words.svg");
    assert_eq!(goodbot(&["paper", "--seed", "1", "--plot", picture.to_str().unwrap()], b"").code, 0);
    let shown = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/learned-words.svg")).unwrap();
    assert!(fs::read_to_string(picture).unwrap() == shown, "make it anew: goodbot paper --seed 1 --plot docs/learned-words.svg");
}

#[test]
fn a_log_of_teach_tells_what_was_meant_and_evaluate_takes_it() {
    let folder = tempfile::tempdir().unwrap();
    let [model, log] = ["robot.goodbot", "robot.jsonl"].map(|name| folder.path().join(name).to_str().unwrap().to_owned());
    let lesson = |color: &str| format!("command go to the {color} room\nintended go to the {color} room\nstep\ngood\nstep\ngood\nfinish\n");
    let taught = goodbot(&["teach", "--lines", "--model", &model], (lesson("red") + &lesson("blue") + &lesson("red")).as_bytes());
    assert_eq!(taught.code, 0, "{}{}", taught.output, taught.messages);
    assert!(taught.output.contains(r#""type":"intended""#) && taught.output.contains(r#""kept":3"#), "{}", taught.output);
    assert_eq!(fs::read_to_string(&log).unwrap().matches(r#""intended":["agentInRoom(agent0,"#).count(), 3);
    let evaluated = goodbot(&["evaluate", &log], b"");
    assert_eq!(evaluated.code, 0, "{}", evaluated.messages);
    let refused = goodbot(&["teach", "--lines"], b"command go to the red room\nintended fly to the moon\n");
    assert!(refused.output.contains("is no task here") && refused.output.contains("such as: go to the"), "{}", refused.output);
}
