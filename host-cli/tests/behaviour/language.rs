//! `goodbot learn`, `ask`, `inspect` and `evaluate`, as their users run them.

use crate::program;

use program::{AGENT, END, goodbot, session, shown};
use std::path::PathBuf;

/// Sessions in which "up" means the way north, and "stay low" means no way.
fn lessons(count: usize) -> String {
    let intended = r#","intended":["agentInRoom(agent0,room1)"]"#;
    let lesson = [session(AGENT, "demonstration", "up to the green one", intended), shown("north"), shown("north"), END.to_owned()];
    vec![lesson.join("\n"); count].join("\n")
}

fn file(name: &str, content: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("goodbot-language-{}-{name}", std::process::id()));
    std::fs::write(&path, content).expect("a file");
    path
}

#[test]
fn a_learned_model_is_asked_and_inspected() {
    let model = file("model", "");
    let (model, log) = (model.to_str().expect("a name"), lessons(3));
    let learned = goodbot(&["learn", "-", "--out", model], log.as_bytes());
    assert_eq!(learned.code, 0, "{}", learned.messages);
    assert!(learned.output.starts_with("3 sessions, 5 words"), "{}", learned.output);
    let environment = format!(r#"{{"version":1,"objects":[{},{AGENT}]}}"#, program::ROOMS);
    let asked = goodbot(&["ask", "--with", model, "--environment", "-", "--json", "green sky"], environment.as_bytes());
    assert_eq!(asked.code, 0, "{}", asked.messages);
    let answer: serde_json::Value = serde_json::from_str(&asked.output).expect("a line of JSON");
    assert_eq!(answer["task"], "agentInRoom(agent0,room1)");
    assert_eq!(answer["plan"], serde_json::json!(["north", "north"]));
    assert_eq!(answer["words"][1]["token"], "never heard");
    let inspected = goodbot(&["inspect", model, "--json"], b"");
    assert!(inspected.output.contains(r#""token":"colorGreen""#), "{}", inspected.output);
}

#[test]
fn an_evaluation_ends_with_its_summary() {
    let run = goodbot(&["evaluate", "-", "--json"], lessons(4).as_bytes());
    assert_eq!(run.code, 0, "{}", run.messages);
    let last: serde_json::Value = serde_json::from_str(run.output.lines().last().expect("a line")).expect("JSON");
    assert_eq!((last["type"].as_str(), last["sessions"].as_u64(), last["right"].as_u64()), (Some("summary"), Some(4), Some(4)));
}

#[test]
fn a_log_cut_in_the_middle_is_refused_with_its_line_or_passed_over() {
    let whole = lessons(3);
    let cut = &whole[..whole.len() - 5];
    let refused = goodbot(&["evaluate", "-"], cut.as_bytes());
    assert_eq!(refused.code, 2);
    assert!(refused.messages.contains("standard input:12:"), "{}", refused.messages);
    let counted = goodbot(&["evaluate", "-", "--keep-going", "--json"], cut.as_bytes());
    assert!(counted.output.contains(r#""skipped":1"#), "{} {}", counted.output, counted.messages);
}

#[test]
fn what_was_meant_must_be_a_task_of_the_home() {
    let wrong = lessons(2).replacen("agentInRoom(agent0,room1)", "agentInRoom(agent0,room0)", 1);
    let run = goodbot(&["evaluate", "-"], wrong.as_bytes());
    assert_eq!(run.code, 2);
    assert!(run.messages.contains("standard input:1: field \"intended\""), "{}", run.messages);
}

#[test]
fn a_model_file_that_is_none_is_refused_by_name() {
    let path = file("none", "no model");
    let run = goodbot(&["inspect", path.to_str().expect("a name")], b"");
    assert_eq!(run.code, 2);
    assert!(run.messages.contains("goodbot-language-"), "{}", run.messages);
}

#[test]
fn the_default_learns_from_as_many_sessions_as_the_role_model_alone() {
    // Each session has one pair and dozens of tasks: in total, more tasks than a model has pairs.
    let session = |number: usize| {
        let room = 1 + number % 2;
        let command = format!("go to room number {room}");
        format!(
            r#"{{"type":"session","version":1,"id":"s{number}","kind":"labelled","environment":{HOME},"command":"{command}","intended":["agentInRoom(agent0,room{room})"]}}
{{"type":"end","learn":true}}
"#
        )
    };
    let log: String = (0..2_000).map(session).collect();
    for learner in ["default", "roles"] {
        let model = file(learner, "");
        let model = model.to_str().unwrap();
        let learned = goodbot(&["learn", "-", "--routes", "--learner", learner, "--force", "--out", model], log.as_bytes());
        assert_eq!((learned.code, learned.messages.as_str()), (0, ""), "{learner}");
        assert!(learned.output.starts_with("2000 sessions"), "{}", learned.output);
        let asked = goodbot(&["ask", "--routes", "--with", model, "--environment", "-", "--json", "go to room number 1"], HOME.as_bytes());
        assert_eq!(asked.code, 0, "{}", asked.messages);
    }
}

#[test]
fn a_model_that_was_learned_answers_to_the_bit_what_evaluate_answers_that_learns_from_the_same_sessions() {
    // In two of four commands the robot stays in its room.
    let session = |number: usize| {
        let rooms = ["red", "green", "blue"];
        let (goes, takes) = [(0, 1), (1, 2), (0, 2), (2, 1)][number % 4];
        let (to, into) = (rooms[goes], rooms[takes]);
        format!(
            r#"{{"type":"session","version":1,"id":"s{number}","kind":"labelled","environment":{HOME},"command":"go to the {to} room and take the bag to the {into} one","intended":["agentInRoom(agent0,room{goes})","blockInRoom(block0,room{takes})"]}}
{{"type":"end","learn":true}}
"#
        )
    };
    let [taught, asked]: [String; 2] = [0..10, 10..14].map(|numbers| numbers.map(session).collect());
    let (taught, asked, model) = (file("taught", &taught), file("asked", &asked), file("agreed", ""));
    let [taught, asked, model] = [&taught, &asked, &model].map(|path| path.to_str().unwrap());
    let kinds = ["--task", "agentInRoom(?a,?r1) & blockInRoom(?o,?r2)"];
    let run = |arguments: &[&str]| {
        let run = goodbot(&[arguments, &kinds].concat(), b"");
        assert_eq!(run.code, 0, "{}", run.messages);
        run.output
    };
    for learner in ["default", "roles", "paper"] {
        run(&["learn", taught, "--learner", learner, "--out", model, "--force"]);
        let answers = |output: String| -> Vec<serde_json::Value> {
            let lines = output.lines().map(|line| serde_json::from_str::<serde_json::Value>(line).unwrap());
            lines.filter(|line| line["type"] == "answer").map(|line| line["probability_expected"].clone()).collect()
        };
        let learned = answers(run(&["evaluate", asked, "--with", model, "--json"]));
        assert_eq!(learned.len(), 4);
        assert_eq!(answers(run(&["evaluate", taught, "--test", asked, "--learner", learner, "--json"])), learned, "{learner}");
    }
}

#[test]
fn a_model_that_was_learned_with_ways_answers_to_the_bit_what_evaluate_answers_in_a_home_with_the_same_colors_elsewhere() {
    // Five rooms in a row, so that a description has several colors of rooms that the task does not name.
    let session = |number: usize, colors: [&str; 5]| {
        let (goal, way) = [(1, 2), (2, 1), (3, 4)][number % 3];
        let mut objects = vec![serde_json::json!({"class": "agent", "name": "agent0", "x": 2, "y": 2})];
        for (room, color) in colors.iter().enumerate() {
            let left = 4 * room;
            objects.push(serde_json::json!({"class": "room", "name": format!("room{room}"), "left": left, "bottom": 0, "right": left + 4, "top": 4, "color": color}));
            if room > 0 {
                objects.push(
                    serde_json::json!({"class": "door", "name": format!("door{room}"), "left": left, "bottom": 2, "right": left, "top": 2}),
                );
            }
        }
        let home = serde_json::json!({"version": 1, "objects": objects});
        let (to, through) = (colors[goal], colors[way]);
        format!(
            r#"{{"type":"session","version":1,"id":"s{number}","kind":"labelled","environment":{home},"command":"go to the {to} room through the {through} one","intended":["agentInRoom(agent0,room{goal})"],"through":[["agentInRoom(agent0,room{way})"]]}}
{{"type":"end","learn":true}}
"#
        )
    };
    let taught: String = (0..12).map(|number| session(number, ["red", "green", "blue", "yellow", "pink"])).collect();
    let asked: String = (0..3).map(|number| session(number, ["red", "pink", "yellow", "blue", "green"])).collect();
    let (taught, asked, model) = (file("ways taught", &taught), file("ways asked", &asked), file("ways agreed", ""));
    let [taught, asked, model] = [&taught, &asked, &model].map(|path| path.to_str().unwrap());
    let answers = |arguments: &[&str]| -> Vec<serde_json::Value> {
        let run = goodbot(arguments, b"");
        assert_eq!(run.code, 0, "{}", run.messages);
        let lines = run.output.lines().filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok());
        lines.filter(|line| line["type"] == "answer").map(|line| line["probability_expected"].clone()).collect()
    };
    answers(&["learn", taught, "--routes", "--out", model, "--force"]);
    let learned = answers(&["evaluate", asked, "--routes", "--with", model, "--json"]);
    assert_eq!((answers(&["evaluate", taught, "--routes", "--test", asked, "--json"]), learned.len()), (learned, 3));
}

/// Three rooms in a row, and two things.
const HOME: &str = r#"{"version":1,"objects":[{"class":"room","name":"room0","left":0,"bottom":0,"right":4,"top":4,"color":"red"},{"class":"room","name":"room1","left":4,"bottom":0,"right":8,"top":4,"color":"green"},{"class":"room","name":"room2","left":8,"bottom":0,"right":12,"top":4,"color":"blue"},{"class":"door","name":"door0","left":4,"bottom":2,"right":4,"top":2},{"class":"door","name":"door1","left":8,"bottom":2,"right":8,"top":2},{"class":"block","name":"block0","x":2,"y":2,"color":"yellow","shape":"bag"},{"class":"block","name":"block1","x":6,"y":1,"color":"pink","shape":"chair"},{"class":"agent","name":"agent0","x":1,"y":1}]}"#;
