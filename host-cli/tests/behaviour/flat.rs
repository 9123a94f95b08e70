//! A flat of ten rooms and ten things, and a lift of a hundred floors: more tasks than one machine word has bits, and more states than can
//! be numbered.

use crate::program::goodbot;
use crate::robot::{Robot, is_right};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

const COLOURS: [&str; 10] = ["red", "green", "blue", "yellow", "purple", "orange", "tan", "teal", "white", "black"];
const SHAPES: [&str; 4] = ["chair", "bag", "backpack", "basket"];

/// Two rows of five rooms with a thing in each, and the robot in the first.
fn flat() -> Value {
    let mut objects = vec![json!({"class": "agent", "name": "agent0", "x": 1, "y": 1})];
    for room in 0..10 {
        let (left, bottom) = (room % 5 * 4, room / 5 * 4);
        let color = COLOURS[room];
        objects.push(json!({"class": "room", "name": format!("room{room}"), "left": left, "bottom": bottom, "right": left + 4, "top": bottom + 4, "color": color}));
        if left > 0 {
            objects.push(json!({"class": "door", "name": format!("west{room}"), "left": left, "bottom": bottom + 2, "right": left, "top": bottom + 2}));
        }
        if bottom > 0 {
            objects.push(json!({"class": "door", "name": format!("south{room}"), "left": left + 2, "bottom": bottom, "right": left + 2, "top": bottom}));
        }
        let (color, shape) = (COLOURS[(room * 3 + 1) % 10], SHAPES[room % 4]);
        objects.push(
            json!({"class": "block", "name": format!("block{room}"), "x": left + 2, "y": bottom + 2, "color": color, "shape": shape}),
        );
    }
    json!({"version": 1, "objects": objects})
}

/// A lift on the first of this many floors, each with a number of its own.
fn lift(floors: usize) -> Value {
    let mut objects = vec![json!({"name": "lift0", "class": "lift"})];
    let floor = |floor| json!({"name": format!("floor{floor}"), "class": "floor", "attributes": {"name": format!("n{floor}")}});
    objects.extend((0..floors).map(floor));
    let mut facts = vec!["liftAtFloor(lift0,floor0)".to_owned()];
    facts.extend((1..floors).map(|floor| format!("above(floor{floor},floor{})", floor - 1)));
    json!({
        "type": "world", "name": "lift", "classes": ["lift", "floor"], "attributes": {"name": ["floor"]},
        "propositions": {"liftAtFloor": ["lift", "floor"], "above": ["floor", "floor"]}, "variables": ["liftAtFloor"],
        "objects": objects, "facts": facts, "task_kinds": ["liftAtFloor(?l,?f)"],
        "actions": [
            {"name": "up", "conditions": ["liftAtFloor(lift0,?a)", "above(?b,?a)"], "effects": ["liftAtFloor(lift0,?b)"]},
            {"name": "down", "conditions": ["liftAtFloor(lift0,?a)", "above(?a,?b)"], "effects": ["liftAtFloor(lift0,?b)"]},
        ],
    })
}

fn text(path: &Path) -> &str {
    path.to_str().expect("UTF-8")
}

/// A folder with a robot's home and its files.
struct Place {
    folder: tempfile::TempDir,
}

impl Place {
    fn new(place: &Value) -> Self {
        let it = Self { folder: tempfile::tempdir().expect("a folder") };
        std::fs::write(it.file("place.json"), serde_json::to_string_pretty(place).expect("JSON")).expect("a file");
        it
    }

    fn file(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Teaches these lessons with good and bad. Returns the number of tasks of the last.
    fn teach(&self, lessons: &[(&str, &str)]) -> usize {
        let mut robot = Robot::new(&[
            text(&self.file("place.json")),
            "--model",
            text(&self.file("robot.goodbot")),
            "--log",
            text(&self.file("log.jsonl")),
        ]);
        let mut tasks = 0;
        for (command, meant) in lessons {
            tasks = robot.one(&format!("command {command}"))["tasks"].as_array().expect("tasks").len();
            robot.walk(|step| if is_right(step, meant) { "good" } else { "bad" }.to_owned());
            robot.tell("finish");
        }
        tasks
    }

    fn asked(&self, command: &str) -> Value {
        let (model, place) = (self.file("robot.goodbot"), self.file("place.json"));
        let arguments = ["ask", "--with", text(&model), "--environment", text(&place), "--json", command];
        serde_json::from_str(&goodbot(&arguments, b"").output).expect("JSON")
    }
}

#[test]
fn a_flat_of_ten_rooms_and_ten_things_is_checked_taught_asked_and_replayed() {
    let place = Place::new(&flat());
    let checked = goodbot(&["check", text(&place.file("place.json"))], b"");
    assert_eq!(checked.code, 0, "{}", checked.messages);
    let lessons = [("go to the green room", "agentInRoom(agent0,room1)"), ("go to the orange room", "agentInRoom(agent0,room5)")];
    // Where the robot is already, and each thing, is a task too: one that is done.
    assert_eq!(place.teach(&lessons), 10 + 10 * 10);
    let asked = place.asked("go to the green room");
    assert_eq!(asked["task"], "agentInRoom(agent0,room1)", "{asked}");
    let replayed = goodbot(&["replay", "--json", text(&place.file("log.jsonl"))], b"");
    assert_eq!(replayed.code, 0, "{}", replayed.messages);
}

#[test]
fn a_robot_of_a_world_has_more_tasks_than_one_word_tells_apart() {
    let place = Place::new(&lift(101));
    let checked = goodbot(&["check", text(&place.file("place.json"))], b"");
    assert_eq!(checked.code, 0, "{}", checked.messages);
    assert_eq!(place.teach(&[("to n3 please", "liftAtFloor(lift0,floor3)"), ("to n12 please", "liftAtFloor(lift0,floor12)")]), 101);
    let asked = place.asked("to n3");
    assert_eq!(asked["task"], "liftAtFloor(lift0,floor3)", "{asked}");
    assert_eq!(asked["meanings"].as_array().map(Vec::len), Some(101), "{asked}");
}

#[test]
fn a_controller_is_promised_no_more_than_it_can_tell_apart() {
    let flat = Place::new(&flat());
    let refused = goodbot(&["size", text(&flat.file("place.json"))], b"");
    assert!(refused.code != 0 && refused.messages.contains("too large for a controller"), "{}", refused.messages);
    let lift = Place::new(&lift(101));
    for arguments in [&["size"][..], &["table", "--c"], &["table", "--rust"]] {
        let refused = goodbot(&[arguments, &[text(&lift.file("place.json"))]].concat(), b"");
        assert!(refused.code != 0 && refused.messages.contains("64 are the most"), "{arguments:?}: {}", refused.messages);
    }
}
