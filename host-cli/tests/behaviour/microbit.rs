//! `goodbot microbit`, as it is used.

use crate::program;

use goodbot_formats::microbit::{HOME, MicrobitFile, SLOTS};
use program::{goodbot, session};
use std::path::Path;

/// A folder with a program, and a model of one lesson.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let program = MicrobitFile::of_program([(0, &b"goodbot on the micro:bit; say help"[..])]).unwrap();
    std::fs::write(folder.path().join("goodbot.hex"), program.to_text()).unwrap();
    std::fs::write(folder.path().join("log.jsonl"), lesson("go to the green room")).unwrap();
    let learned = run(folder.path(), &["learn", "LOG", "--out", "MODEL"]);
    assert_eq!(learned.code, 0, "{}", learned.messages);
    folder
}

/// A recorded lesson, to go to the upper room.
fn lesson(command: &str) -> String {
    session(program::AGENT, "labelled", command, r#","intended":["agentInRoom(agent0,room1)"]"#) + "\n{\"type\":\"end\",\"learn\":true}\n"
}

/// Runs the program. Names in capital letters are files of the folder.
fn run(folder: &Path, arguments: &[&str]) -> program::Run {
    let file = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let arguments: Vec<String> = arguments
        .iter()
        .map(|&argument| match argument {
            "HEX" => file("goodbot.hex"),
            "LOG" => file("log.jsonl"),
            "MODEL" => file("words.goodbot"),
            "HOMEFILE" => file("home.json"),
            "OUT" => file("mine.hex"),
            other => other.to_owned(),
        })
        .collect();
    goodbot(&arguments.iter().map(String::as_str).collect::<Vec<_>>(), b"")
}

/// A home with a lower room of this width.
fn home(width: u32) -> String {
    format!(
        r#"{{"version":1,"objects":[{{"class":"room","name":"room0","left":0,"bottom":0,"right":{width},"top":4,"color":"red"}},{{"class":"agent","name":"agent0","x":1,"y":1}}]}}"#
    )
}

#[test]
fn the_file_has_the_program_the_model_the_home_and_the_commands() {
    let folder = folder();
    std::fs::write(folder.path().join("home.json"), home(4)).unwrap();
    let run = run(folder.path(), &["microbit", "--hex", "HEX", "-m", "MODEL", "--home", "HOMEFILE", "-c", "go there", "-o", "OUT"]);
    assert_eq!(run.code, 0, "{}", run.messages);
    assert!(run.messages.contains("1 lesson"), "{}", run.messages);
    let file = MicrobitFile::parse(&std::fs::read_to_string(folder.path().join("mine.hex")).unwrap()).unwrap();
    assert_eq!(file.bytes(0, 24), b"goodbot on the micro:bit");
    let text = b"room room0 0 0 4 4 red\nagent agent0 1 1\nsay go there\n\xff";
    assert_eq!(file.bytes(HOME, text.len()), text);
    assert_eq!(file.bytes(SLOTS, 4), b"slot");
}

#[test]
fn what_a_micro_bit_has_no_room_for_is_named() {
    let folder = folder();
    std::fs::write(folder.path().join("home.json"), home(60)).unwrap();
    let refused = run(folder.path(), &["microbit", "--hex", "HEX", "-m", "MODEL", "--home", "HOMEFILE", "-o", "OUT"]);
    assert_eq!(refused.code, 2);
    assert!(refused.messages.contains("on a micro:bit") && refused.messages.contains("cells"), "{}", refused.messages);
    let long = "so ".repeat(30);
    let refused = run(folder.path(), &["microbit", "--hex", "HEX", "-m", "MODEL", "-c", &long, "-o", "OUT"]);
    assert_eq!(refused.code, 2);
    assert!(refused.messages.contains("room for 64"), "{}", refused.messages);
    let same = lesson("go to the green room").repeat(40);
    // The words differ in their first letters.
    let different: String = ('a'..='e').map(|letter| lesson(&format!("{letter}oo {letter}ira {letter}ul {letter}em"))).collect();
    for (log, told) in
        [(same, "too many sessions in one model: "), (different, "too many different words in one model: 20 or more, and 14 ")]
    {
        std::fs::write(folder.path().join("log.jsonl"), log).unwrap();
        assert_eq!(run(folder.path(), &["learn", "LOG", "--out", "MODEL"]).code, 0);
        let refused = run(folder.path(), &["microbit", "--hex", "HEX", "-m", "MODEL", "-o", "OUT"]);
        assert_eq!(refused.code, 2);
        assert!(refused.messages.contains(&format!("on a micro:bit: {told}")), "{}", refused.messages);
        assert!(!refused.messages.contains("Capacities"), "{}", refused.messages);
    }
    assert!(!folder.path().join("mine.hex").exists());
}

#[test]
fn a_board_gets_the_role_model_of_what_the_default_learner_learned() {
    let folder = folder();
    let on_the_board = |learner: &str| {
        assert_eq!(run(folder.path(), &["learn", "LOG", "--learner", learner, "--out", "MODEL", "--force"]).code, 0);
        let made = run(folder.path(), &["microbit", "--hex", "HEX", "-m", "MODEL", "-o", "OUT", "--force"]);
        assert_eq!(made.code, 0, "{}", made.messages);
        let model = std::fs::read(folder.path().join("words.goodbot")).unwrap();
        let file = MicrobitFile::parse(&std::fs::read_to_string(folder.path().join("mine.hex")).unwrap()).unwrap();
        let slot = file.bytes(SLOTS + 16, model.len());
        (model, slot)
    };
    let (alone, slot) = on_the_board("roles");
    assert_eq!(slot, alone);
    let (layered, slot) = on_the_board("default");
    assert_eq!((layered[8], slot[8]), (3, 2));
    assert_eq!(slot[..alone.len()], alone);
}

#[test]
fn a_folder_in_the_place_of_the_program_is_refused_with_what_the_system_says() {
    let folder = folder();
    let run = run(folder.path(), &["microbit", "--hex", folder.path().to_str().unwrap(), "-m", "MODEL", "-o", "OUT"]);
    assert!(run.code == 2 && run.messages.contains("cannot be read ("), "{}", run.messages);
}

#[test]
fn what_is_no_program_for_a_micro_bit_or_no_model_for_it_is_refused() {
    let folder = folder();
    for (arguments, problem) in [
        (&["--hex", "LOG", "-m", "MODEL"][..], "no Intel HEX"),
        (&["--hex", "MODEL", "-m", "MODEL"], "is no micro:bit program"),
        (&["--hex", "HEX", "-m", "HEX"], "not a goodbot model"),
        (&["--hex", "HEX", "-m", "MODEL", "-c", " "], "no command"),
    ] {
        let run = run(folder.path(), &[&["microbit"], arguments, &["-o", "OUT"]].concat());
        assert_eq!(run.code, 2, "{arguments:?}");
        assert!(run.messages.contains(problem), "{arguments:?}: {}", run.messages);
    }
    assert_eq!(run(folder.path(), &["learn", "LOG", "--learner", "paper", "--out", "MODEL"]).code, 0);
    let refused = run(folder.path(), &["microbit", "--hex", "HEX", "-m", "MODEL", "-o", "OUT"]);
    assert!(refused.messages.contains("role model alone"), "{}", refused.messages);
    // An input file is never replaced.
    let refused = run(folder.path(), &["microbit", "--hex", "HEX", "-m", "MODEL", "-o", "HEX"]);
    assert!(refused.messages.contains("would be replaced"), "{}", refused.messages);
}
