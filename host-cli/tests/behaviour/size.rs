//! `goodbot size`: the memory that a robot needs.

use crate::program;

use program::{AGENT, END, ROOMS, Run, goodbot, log, session, step};

const MAP: &str = include_str!("../../src/example/home.json");
const VACUUM: &str = include_str!("../../../docs/examples/worlds/vacuum.json");
const LOG: &str = include_str!("../../src/example/sessions.jsonl");

fn size(arguments: &[&str], input: &str) -> Run {
    goodbot(&[&["size"], arguments].concat(), input.as_bytes())
}

fn json(arguments: &[&str], input: &str) -> serde_json::Value {
    let run = size(&[arguments, &["--json"]].concat(), input);
    assert_eq!(run.code, 0, "{}", run.messages);
    serde_json::from_str(&run.output).expect("one line of JSON")
}

#[test]
fn a_robot_is_trained_on_the_log_in_that_memory_and_keeps_every_session() {
    let size = json(&["--log", "-"], LOG);
    let sessions = LOG.lines().filter(|line| line.contains(r#""learn":true"#)).count();
    assert!(sessions > 1);
    assert_eq!((size["sessions"].as_u64(), size["kept"].as_u64()), (Some(sessions as u64), Some(sessions as u64)));
}

#[test]
fn there_is_room_for_the_trainers_that_a_robot_in_c_tells_apart() {
    for place in [MAP, VACUUM] {
        let capacities = &json(&["-"], place)["capacities"];
        assert_eq!(capacities["strategies"], 3);
        assert_eq!(capacities["beliefs"].as_u64(), capacities["tasks"].as_u64().map(|tasks| 3 * tasks));
    }
}

#[test]
fn the_stack_is_the_one_that_the_page_about_footprints_has() {
    let page = include_str!("../../../docs/footprint.md");
    let stack = json(&["-"], MAP)["ram"]["stack"].as_u64().expect("a number");
    let grouped = format!("| {},{:03} |", stack / 1000, stack % 1000);
    assert!(page.contains(&grouped), "{grouped}");
}

#[test]
fn the_words_of_a_log_are_counted_once() {
    let lines = [
        session(AGENT, "feedback", "go to the green room", ""),
        step("north", "reward"),
        END.to_owned(),
        session(AGENT, "feedback", "Green room, go!", ""),
        step("north", "reward"),
        END.to_owned(),
    ];
    let size = json(&["--log", "-"], &String::from_utf8(log(lines.each_ref().map(String::as_str))).expect("text"));
    assert_eq!((size["words"].as_u64(), size["different_words"].as_u64(), size["word_bytes"].as_u64()), (Some(5), Some(5), Some(16)));
    assert_eq!((size["homes"].as_u64(), size["kept"].as_u64()), (Some(1), Some(2)));
}

#[test]
fn a_world_with_more_states_than_a_controller_can_plan_in_is_refused_with_their_number() {
    let lamps: Vec<String> = (0..40).map(|lamp| format!("{{\"name\":\"lamp{lamp}\",\"class\":\"lamp\"}}")).collect();
    let on: Vec<String> = (0..40).map(|lamp| format!("\"lampOn(lamp{lamp})\"")).collect();
    let world = format!(
        r#"{{"type":"world","name":"street","classes":["lamp"],"attributes":{{}},"propositions":{{"lampOn":["lamp"]}},"objects":[{}],"facts":[],"actions":[{{"name":"all","conditions":[],"effects":[{}]}}],"task_kinds":["lampOn(?l)"]}}"#,
        lamps.join(","),
        on.join(",")
    );
    let run = size(&["-"], &world);
    assert!(run.code == 2 && run.output.is_empty(), "{} {}", run.output, run.messages);
    assert!(run.messages.contains("1000000 are the most for a controller"), "{}", run.messages);
}

#[test]
fn more_sessions_take_more_memory() {
    let ram = |sessions: &str| json(&["-", "--sessions", sessions], MAP)["ram"]["controller"].as_u64().expect("a number");
    assert!(ram("4") < ram("8"));
}

/// Lessons of the vacuum cleaner: an action, and rests when the task is done.
fn lessons_of_vacuum() -> String {
    let world: serde_json::Value = serde_json::from_str(VACUUM).expect("JSON");
    let lesson = |(command, action): (&str, &str)| {
        format!(
            "{{\"type\":\"session\",\"version\":1,\"kind\":\"feedback\",\"world\":\"vacuum\",\"command\":\"{command}\"}}\n{}\n{}\n{END}\n",
            step(action, "reward"),
            step("noop", "reward")
        )
    };
    let lessons =
        [("go to the kitchen", "go(room1)"), ("clean the hall", "clean"), ("drive to the bedroom", "go(room2)"), ("dock", "dock")];
    format!("{world}\n{}", lessons.map(lesson).concat())
}

#[test]
fn the_robot_of_a_world_is_sized_by_its_log_with_far_less_than_at_worst() {
    let world = tempfile::Builder::new().suffix(".json").tempfile().expect("a file");
    std::fs::write(world.path(), VACUUM).expect("a file");
    let world = world.path().to_str().expect("UTF-8");
    let (worst, real) = (json(&[world, "--sessions", "4", "--words", "4"], ""), json(&[world, "--log", "-"], &lessons_of_vacuum()));
    let entry = |size: &serde_json::Value, name: &str| size["capacities"][name].as_u64().expect("a number");
    assert_eq!((real["world"].as_str(), real["homes"].as_u64(), real["kept"].as_u64()), (Some("vacuum"), Some(0), Some(4)));
    assert!(entry(&real, "command_tokens") * 2 < entry(&worst, "command_tokens"), "{real} {worst}");
    assert!(entry(&real, "states") == entry(&worst, "states") && entry(&real, "states") > 0, "a table's plans are exact");
    let run = size(&["--log", "-"], &lessons_of_vacuum());
    assert_eq!(run.code, 2);
    assert!(run.messages.contains("name the robot's world too"), "{}", run.messages);
}

#[test]
fn it_prints_source_for_both_languages() {
    let run = size(&["-", "--sessions", "6", "--words", "5"], MAP);
    assert_eq!(run.code, 0, "{}", run.messages);
    assert!(run.output.starts_with("A robot in 1 home that keeps 6 sessions of at most 5 words, 30 different:\n"), "{}", run.output);
    for line in ["    struct RobotMemory = goodbot::Capacities {", "        sessions: 6,", "    6, /* sessions */"] {
        assert!(run.output.lines().any(|it| it == line), "{line} is not in {}", run.output);
    }
}

#[test]
fn bad_use_and_bad_files_are_refused() {
    for (arguments, input, message) in [
        (&[][..], "", "PLACE"),
        (&["-", "--sessions", "0"], MAP, "65535"),
        (&["-", "--words", "65"], MAP, "64"),
        (&["no-such-home.json"], "", "no-such-home.json: cannot be read"),
        (&["-"], LOG, "not a home"),
        (&["--log", "-"], MAP, "not a session log"),
    ] {
        let run = size(arguments, input);
        assert_eq!(run.code, 2, "{arguments:?} {}", run.output);
        assert!(run.messages.contains(message) && run.output.is_empty(), "{arguments:?}: {}", run.messages);
    }
    let without_agent = format!(r#"{{"version":1,"objects":[{ROOMS}]}}"#);
    let run = size(&["-"], &without_agent);
    assert_eq!(
        (run.code, run.messages.trim_end()),
        (2, "error: standard input: field \"objects\": there is no agent; add one, inside a room")
    );
}
