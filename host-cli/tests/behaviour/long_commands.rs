//! Commands with more words than a robot reads: their first words are read, and a message says so.

use crate::program::{AGENT, END, Run, goodbot, log, session, step};
use serde_json::Value;

const TOLD: &str = "1 command has more than 64 words; its first 64 are read: ";

/// A command of `count` words; the first five say where to go.
fn words(count: usize) -> String {
    let go = "go to the green room";
    (0..count - 5).fold(go.to_owned(), |said, number| format!("{said} w{number}"))
}

/// Sessions in homes, one of them with a command of 70 words on line 4.
fn homes() -> Vec<u8> {
    let intended = r#","intended":["agentInRoom(agent0,room1)"]"#;
    let told = |command: &str| session(AGENT, "feedback", command, intended);
    let north = step("north", "reward");
    log([&told("go to the green room"), &north, END, &told(&words(70)), &north, END, &told("green"), &north, END])
}

fn line(run: &Run, kind: &str) -> Value {
    let lines = run.output.lines().map(|line| serde_json::from_str::<Value>(line).expect("JSON"));
    lines.rev().find(|line| line["type"] == kind).unwrap_or_else(|| panic!("no {kind}: {}{}", run.output, run.messages))
}

#[test]
fn the_first_words_of_a_long_command_are_learned_evaluated_and_replayed() {
    let folder = tempfile::tempdir().unwrap();
    let [log, model] = ["log.jsonl", "words.goodbot"].map(|name| folder.path().join(name).to_str().unwrap().to_owned());
    std::fs::write(&log, homes()).unwrap();
    for arguments in [&["evaluate", &log, "--json"][..], &["learn", &log, "--json", "--out", &model], &["replay", &log, "--json"]] {
        let run = goodbot(arguments, b"");
        assert_eq!(run.code, 0, "{arguments:?}: {}", run.messages);
        assert!(run.messages.contains(&format!("{TOLD}{log}:4\n")), "{arguments:?}: {}", run.messages);
    }
    assert_eq!(line(&goodbot(&["evaluate", &log, "--json"], b""), "summary")["long_commands"], 1);
    let learned = line(&goodbot(&["learn", &log, "--json", "--out", &model], b""), "model");
    // go, to, the, green, room, and 59 of the others.
    assert_eq!((&learned["long_commands"], &learned["sessions"], &learned["words"]), (&1.into(), &3.into(), &64.into()), "{learned}");
    let asked = goodbot(&["evaluate", "--with", &model, "--test", &log, "--json"], b"");
    assert_eq!(line(&asked, "summary")["asked"], 3, "{}", asked.messages);
}

#[test]
fn a_long_command_is_a_warning_and_no_fault() {
    let run = goodbot(&["check", "-"], &homes());
    assert_eq!((run.code, run.output.as_str()), (0, "standard input: 3 sessions of 3 steps, no fault, 3 warnings\n"), "{}", run.messages);
    assert!(run.messages.contains(r#"4: field "command": warning: has 70 words; its first 64 are read"#), "{}", run.messages);
}

#[test]
fn a_long_command_in_a_world_is_read_like_any_other() {
    const WORLD: &str = r#"{"type":"world","name":"flat","classes":["lamp"],"attributes":{"kind":["lamp"]},"propositions":{"lampOn":["lamp"]},"objects":[{"name":"a","class":"lamp","attributes":{"kind":"big"}},{"name":"b","class":"lamp","attributes":{"kind":"small"}}],"facts":[],"task_kinds":["lampOn(?x)"]}"#;
    let told =
        |words: &str, lamp: &str| format!(r#"{{"type":"command","world":"flat","command":"{words}","intended":["lampOn({lamp})"]}}"#);
    let log = log([WORLD, &told("big one", "a"), &told(&words(70), "b"), &told("small one", "b")]);
    let folder = tempfile::tempdir().unwrap();
    let [model, world] = ["words.goodbot", "world.json"].map(|name| folder.path().join(name).to_str().unwrap().to_owned());
    std::fs::write(&world, WORLD).unwrap();
    for arguments in [&["evaluate", "-"][..], &["learn", "-", "--out", &model]] {
        let run = goodbot(arguments, &log);
        assert!(run.code == 0 && run.messages.contains(&format!("{TOLD}standard input:3\n")), "{arguments:?}: {}", run.messages);
    }
    let checked = goodbot(&["check", "-"], &log);
    assert!(checked.code == 0 && checked.messages.contains("3: field \"command\": warning: has 70 words"), "{}", checked.messages);
    let asked = goodbot(&["ask", "--with", &model, "-e", &world, &words(70)], b"");
    assert!(asked.code == 0 && asked.output.contains("the words after the first 64 were not read"), "{}{}", asked.output, asked.messages);
    let asked = goodbot(&["ask", "--with", &model, "-e", &world, "--json", &words(70)], b"");
    assert_eq!(line(&asked, "answer")["unread"], 6);
    let wrong = goodbot(&["evaluate", "-"], format!("{WORLD}\n{}\n", told(&"x".repeat(60), "a")).as_bytes());
    assert!(wrong.messages.contains(r#"2: field "command": has a word of more than 48 bytes; shorten it"#), "{}", wrong.messages);
}

#[test]
fn a_robot_is_taught_the_first_words_of_a_long_command() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("robot.goodbot").to_str().unwrap().to_owned();
    let said = format!("command {}\nstep\ngood\nfinish\nnext\n", words(70));
    let run = goodbot(&["teach", "--lines", "--model", &model], said.as_bytes());
    assert_eq!(run.code, 0, "{}{}", run.output, run.messages);
    let heard = line(&run, "heard");
    assert_eq!((&heard["unread"], heard["command"].as_str()), (&6.into(), Some(words(64).as_str())));
    assert_eq!(line(&run, "finished")["sessions"], 1, "{}", run.output);
}
