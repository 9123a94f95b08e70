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
fn the_pictures_in_the_documentation_are_those_of_their_commands() {
    const DOCS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs");
    let folder = tempfile::tempdir().unwrap();
    let world = format!("{DOCS}/examples/worlds/vacuum.json");
    let vacuum: &[&str] = &["teach", &world, "--command", "clean the kitchen", "--intended", "roomClean(room1)", "--picture"];
    for (name, command) in
        [("learned-words", &["paper", "--seed", "1", "--plot"][..]), ("teach", &["teach", "--picture"]), ("vacuum", vacuum)]
    {
        let picture = folder.path().join(name);
        assert_eq!(goodbot(&[command, &[picture.to_str().unwrap()]].concat(), b"").code, 0);
        let shown = fs::read_to_string(format!("{DOCS}/{name}.svg")).unwrap();
        assert!(fs::read_to_string(picture).unwrap() == shown, "make it anew: goodbot {} docs/{name}.svg", command.join(" "));
    }
}

#[test]
fn a_picture_of_a_home_takes_a_lesson_whose_task_is_possible_there() {
    let world = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/examples/worlds/vacuum.json");
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("lesson.svg");
    let teach = |more: &[&str]| goodbot(&[&["teach", world, "--picture", picture.to_str().unwrap()], more].concat(), b"");
    let alone = teach(&[]);
    assert!(alone.code == 2 && alone.messages.contains("give --command and --intended"), "{}", alone.messages);
    let impossible = teach(&["--command", "fly", "--intended", "roomClean(moon)"]);
    assert!(impossible.code == 2 && impossible.messages.contains("is no task here"), "{}", impossible.messages);
    assert!(!picture.exists());
}

#[test]
fn a_lesson_that_is_over_at_once_has_no_picture_and_ends() {
    let folder = tempfile::tempdir().unwrap();
    let [home, picture] = ["home.txt", "lesson.svg"].map(|name| folder.path().join(name).to_str().unwrap().to_owned());
    // The first guess pushes the chair into the lane, from which it never returns.
    let drawn =
        ["##########", "####g#####", "####g#####", "####+#####", "#bbbCb#rr#", "#bbb@b+rr#", "#bbbbb#rr#", "##########", "C: yellow chair"];
    fs::write(&home, drawn.join("\n")).unwrap();
    let lesson = ["--command", "move it", "--intended", "blockInRoom(block0,room2)"];
    let run = goodbot(&[&["teach", &home, "--picture", &picture][..], &lesson].concat(), b"");
    assert!(run.code == 2 && run.messages.contains("over before step 3"), "{}", run.messages);
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
