//! Robots in worlds from files, taught line by line.

use crate::program::goodbot;
use crate::robot::{Robot, is_right};
use goodbot::snapshot::Contents;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// A command, and its task.
type Lesson<'l> = (&'l str, &'l str);

/// A world, the lessons of its robot, and a command that it then understands.
struct Course {
    world: &'static str,
    lessons: &'static [Lesson<'static>],
    asked: Lesson<'static>,
}

const COURSES: [Course; 4] = [
    Course {
        world: "lift",
        lessons: &[
            ("to the roof please", "liftAtFloor(lift0,floor3)"),
            ("to the garage please", "liftAtFloor(lift0,floor0)"),
            ("to the office", "liftAtFloor(lift0,floor2)"),
        ],
        asked: ("to the roof", "liftAtFloor(lift0,floor3)"),
    },
    Course {
        world: "lamps",
        lessons: &[
            ("the red one in the kitchen on", "lampOn(lamp0)"),
            ("the blue one in the kitchen on", "lampOn(lamp1)"),
            ("the red one in the bedroom on", "lampOn(lamp2)"),
            ("the green one off", "lampOff(lamp3)"),
        ],
        asked: ("bedroom on", "lampOn(lamp2)"),
    },
    Course {
        world: "arm",
        lessons: &[
            ("red cup to the black tray", "cupIn(cup0,tray1)"),
            ("blue cup to the white tray", "cupIn(cup1,tray0)"),
            ("red cup to the yellow tray", "cupIn(cup0,tray2)"),
        ],
        asked: ("blue cup to the yellow tray", "cupIn(cup1,tray2)"),
    },
    Course {
        world: "vacuum",
        lessons: &[
            ("go to the kitchen", "vacuumIn(vacuum0,room1)"),
            ("go to the bedroom", "vacuumIn(vacuum0,room2)"),
            ("clean the kitchen", "roomClean(room1)"),
            ("clean the hall", "roomClean(room0)"),
            ("clean the kitchen now", "roomClean(room1)"),
        ],
        asked: ("clean the bedroom", "roomClean(room2)"),
    },
];

fn world_file(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/examples/worlds").join(name).with_extension("json");
    path.to_str().expect("UTF-8").to_owned()
}

/// Teaches all lessons, with feedback to each step, until the robot has rightly rested three times. Returns the answers that have beliefs.
fn teach(arguments: &[&str], lessons: &[Lesson<'_>]) -> Vec<Value> {
    let mut robot = Robot::new(arguments);
    let mut answers = vec![];
    for (command, meant) in lessons {
        let mut heard = robot.one(&format!("command {command}"));
        // What a robot takes for done already it tries if it is told again.
        if heard["verdict"] == "done" {
            heard = robot.one(&format!("command {command}"));
        }
        answers.push(heard);
        robot.one(&format!("intended {meant}"));
        let mut rests = 0;
        while rests < 3 {
            let step = robot.one("step");
            let right = is_right(&step, meant);
            rests = if right && step["action"] == "noop" { rests + 1 } else { 0 };
            answers.push(robot.one(if right { "good" } else { "bad" }));
            assert!(answers.len() < 1_000, "{command}: the robot does not learn");
        }
        robot.tell("finish");
        robot.tell("reset");
    }
    answers
}

/// Teaches a robot that is kept in a folder. Returns the answers that have beliefs.
fn taught(folder: &Path, course: &Course) -> (PathBuf, Vec<Value>) {
    let model = folder.join(course.world).with_extension("goodbot");
    let answers = teach(&[&world_file(course.world), "--seed", "5", "--model", model.to_str().expect("UTF-8")], course.lessons);
    (model, answers)
}

fn lines_of(run: &crate::program::Run) -> Vec<Value> {
    assert_eq!(run.code, 0, "{}", run.messages);
    run.output.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
}

#[test]
fn the_example_worlds_are_taught_line_by_line_and_every_command_reads_what_came_of_it() {
    for course in &COURSES {
        let folder = tempfile::tempdir().expect("a folder");
        let (model, _) = taught(folder.path(), course);
        let (log, world) = (model.with_extension("jsonl"), world_file(course.world));
        let [model, log] = [&model, &log].map(|path| path.to_str().expect("UTF-8"));
        let (command, meant) = course.asked;
        let asked = lines_of(&goodbot(&["ask", "--with", model, "--environment", &world, "--json", command], b""));
        assert_eq!(asked[0]["task"].as_str(), Some(meant), "{}: {}", course.world, asked[0]);
        let checked = goodbot(&["check", log], b"");
        let count = course.lessons.len();
        assert!(
            checked.output.contains(&format!("a log of worlds with {count} sessions, no fault")),
            "{}{}",
            checked.output,
            checked.messages
        );
        // A model that is trained again from the log understands these commands.
        let anew = folder.path().join("anew.goodbot");
        let anew = anew.to_str().expect("UTF-8");
        assert_eq!(goodbot(&["learn", log, "--out", anew], b"").code, 0);
        let evaluated = lines_of(&goodbot(&["evaluate", "--with", anew, "--test", log, "--json"], b""));
        assert_eq!(evaluated.last().expect("a summary")["right"].as_u64(), Some(count as u64), "{}", course.world);
        // What it learned is shown, compared, merged, and left out again; the model stays one for this world.
        assert_eq!(lines_of(&goodbot(&["inspect", model, "--sessions", "--json"], b"")).len(), count);
        let [less, both] = ["less.goodbot", "both.goodbot"].map(|name| folder.path().join(name).to_str().expect("UTF-8").to_owned());
        assert_eq!(goodbot(&["unlearn", model, "1", "--out", &less], b"").code, 0);
        let gone = lines_of(&goodbot(&["diff", model, &less, "--json"], b""));
        assert_eq!(gone.iter().filter(|line| line["type"] == "session gone").count(), 1, "{gone:?}");
        assert_eq!(goodbot(&["merge", &less, model, "--out", &both], b"").code, 0);
        let vocabulary = |file: &str| Contents::read(&std::fs::read(file).expect("a model")).expect("a model").vocabulary;
        assert_eq!([&less, &both].map(|file| vocabulary(file)), [vocabulary(model); 2], "{}", course.world);
        for file in [&less, &both] {
            let asked = lines_of(&goodbot(&["ask", "--with", file, "--environment", &world, "--json", command], b""));
            assert!(asked[0]["verdict"].is_string(), "{}", course.world);
        }
        let first = lines_of(&goodbot(&["inspect", &less, "--sessions", "--json"], b""));
        assert_eq!(first.len(), count - 1);
    }
}

const ROOMS: [&str; 10] = ["kitchen", "bedroom", "hall", "bath", "attic", "cellar", "study", "garage", "porch", "loft"];
const COLOURS: [&str; 4] = ["red", "blue", "green", "white"];

/// A house with a lamp of each colour in each of these rooms, and an action for each lamp to light it, and one to dim it. All are off but
/// the kitchen's blue one and the last room's green one.
fn house(rooms: usize) -> Value {
    let lamps = rooms * COLOURS.len();
    let lamp = |lamp: usize| json!({"name": format!("lamp{lamp}"), "class": "lamp", "attributes": {"color": COLOURS[lamp % 4], "room": ROOMS[lamp / 4]}});
    let is = |lamp: usize| format!("{}(lamp{lamp})", if [1, lamps - 2].contains(&lamp) { "lampOn" } else { "lampOff" });
    let action = |name, from, to| {
        let [from, to] = [from, to].map(|proposition| format!("{proposition}(?l)"));
        json!({"name": name, "parameters": {"?l": "lamp"}, "conditions": [from], "effects": [to, format!("!{from}")]})
    };
    json!({
        "type": "world", "name": "house", "classes": ["lamp"], "attributes": {"color": ["lamp"], "room": ["lamp"]},
        "propositions": {"lampOn": ["lamp"], "lampOff": ["lamp"]}, "objects": (0..lamps).map(lamp).collect::<Vec<_>>(),
        "facts": (0..lamps).map(is).collect::<Vec<_>>(), "task_kinds": ["lampOn(?l)", "lampOff(?l)"],
        "actions": [action("light", "lampOff", "lampOn"), action("dim", "lampOn", "lampOff")]
    })
}

#[test]
fn a_house_of_sixteen_actions_and_one_of_eighty_are_taught_and_obey() {
    for rooms in [2, 10] {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
        let (world, model, log) = (path("house.json"), path("house.goodbot"), path("house.jsonl"));
        std::fs::write(&world, house(rooms).to_string()).expect("a file");
        let checked = goodbot(&["check", &world], b"");
        assert!(checked.output.contains(&format!("a robot of {} actions", 8 * rooms)), "{}{}", checked.output, checked.messages);
        let lesson = |lamp: usize, how: &str, meant: &str| {
            (format!("the {} one in the {} {how}", COLOURS[lamp % 4], ROOMS[lamp / 4]), format!("{meant}(lamp{lamp})"))
        };
        let on = (0..rooms.max(4)).map(|number| lesson(number % rooms * 4 + number % 4, "on", "lampOn"));
        let lessons: Vec<_> = on.chain([1, 4 * rooms - 2].map(|lamp| lesson(lamp, "off", "lampOff"))).collect();
        let lessons: Vec<Lesson<'_>> = lessons.iter().map(|(command, meant)| (command.as_str(), meant.as_str())).collect();
        teach(&[&world, "--seed", "5", "--model", &model], &lessons);
        // No lesson was about this lamp.
        let (command, meant) = lesson(4, "on", "lampOn");
        let asked = lines_of(&goodbot(&["ask", "--with", &model, "--environment", &world, "--json", &command], b""));
        assert_eq!((asked[0]["task"].as_str(), &asked[0]["plan"]), (Some(meant.as_str()), &json!(["light(lamp4)"])), "{}", asked[0]);
        let mut robot = Robot::new(&[&world, "--model", &model]);
        robot.one(&format!("command {command}"));
        assert_eq!([robot.one("step"), robot.one("step")].map(|step| step["action"].clone()), ["light(lamp4)", "noop"]);
        drop(robot);
        for command in ["check", "replay"] {
            assert_eq!(goodbot(&[command, &log], b"").code, 0);
        }
        for command in [["size", &world].as_slice(), &["table", &world, "--c"], &["table", &world, "--rust"]] {
            let refused = goodbot(command, b"");
            let told = format!("actions\": give the robot {} actions with their objects, and 15 are the most for a controller", 8 * rooms);
            assert!(refused.code == 2 && refused.messages.contains(&told), "{}", refused.messages);
        }
    }
}

#[test]
fn models_of_two_worlds_are_not_merged() {
    let folder = tempfile::tempdir().expect("a folder");
    let [lift, lamps] = [0, 1].map(|course| taught(folder.path(), &COURSES[course]).0.to_str().expect("UTF-8").to_owned());
    let out = folder.path().join("both.goodbot");
    let run = goodbot(&["merge", &lift, &lamps, "--out", out.to_str().expect("UTF-8")], b"");
    assert!(run.code == 2 && run.messages.contains("another vocabulary") && !out.exists(), "{}", run.messages);
}

#[test]
#[cfg(target_os = "linux")]
fn the_doctor_finds_nothing_wrong_with_a_robot_in_a_world() {
    let folder = tempfile::tempdir().expect("a folder");
    let robots = folder.path().join("goodbot");
    std::fs::create_dir(&robots).expect("a folder");
    let lamps = COURSES.get(1).expect("a course");
    let _ = taught(&robots, lamps);
    let mut doctor = std::process::Command::new(env!("CARGO_BIN_EXE_goodbot"));
    let told = doctor.arg("doctor").env("XDG_DATA_HOME", folder.path()).output().expect("the program");
    let told = String::from_utf8(told.stdout).expect("UTF-8");
    let robot = told.lines().find(|line| line.contains("lamps.goodbot")).expect("a robot");
    assert!(robot.trim_start().starts_with("ok") && robot.ends_with("4 sessions"), "{told}");
}

#[test]
fn a_command_in_a_world_that_is_refused_keeps_no_other_from_being_asked() {
    let folder = tempfile::tempdir().expect("a folder");
    let course = COURSES.first().expect("a course");
    let (model, _) = taught(folder.path(), course);
    let (command, long) = (course.asked.0, "x".repeat(60));
    let model = model.to_str().expect("a name");
    let ask = ["ask", "--with", model, "--environment", &world_file(course.world), "--json", "-"];
    let run = goodbot(&ask, format!("{command}\n{long}\n{command}\n").as_bytes());
    let types: Vec<Value> = run.output.lines().map(|line| serde_json::from_str::<Value>(line).expect("JSON")["type"].clone()).collect();
    assert_eq!((run.code, types), (2, vec!["answer".into(), "error".into(), "answer".into()]), "{}", run.messages);
    assert!(run.messages.contains(&format!("{long:?}: ")) && run.messages.contains("1 of 3 commands were refused"), "{}", run.messages);
}

/// The probabilities of the tasks of an answer, or of a belief, to the bit.
fn beliefs(tasks: impl Iterator<Item = (String, f64)>) -> BTreeMap<String, u32> {
    tasks.map(|(task, probability)| (task, (probability as f32).to_bits())).collect()
}

#[test]
fn a_replay_believes_to_the_bit_what_the_live_session_believed() {
    for course in &COURSES {
        let folder = tempfile::tempdir().expect("a folder");
        let (model, answers) = taught(folder.path(), course);
        let log = model.with_extension("jsonl");
        let log = log.to_str().expect("UTF-8");
        let replayed = lines_of(&goodbot(&["replay", "--json", "--every-session", "--believes", "population", log], b""));
        let replayed: Vec<Value> = replayed.into_iter().filter(|line| line["type"] != "summary").collect();
        let live = answers.iter().map(|answer| {
            let tasks = answer["tasks"].as_array().expect("tasks").iter();
            beliefs(tasks.map(|task| (task["task"].as_str().expect("a task").to_owned(), task["probability"].as_f64().expect("a number"))))
        });
        let live: Vec<_> = live.collect();
        let again: Vec<_> = replayed
            .iter()
            .map(|line| {
                beliefs(line["tasks"].as_object().expect("tasks").iter().map(|(task, it)| (task.clone(), it.as_f64().expect("a number"))))
            })
            .collect();
        let begins: Vec<bool> = answers.iter().map(|answer| answer["type"] == "heard").collect();
        let mut again = again.iter();
        for (position, belief) in live.iter().enumerate() {
            // The end of a session is evidence, and a replay prints the belief after it too.
            if position > 0 && begins[position] {
                again.next();
            }
            assert_eq!(again.next(), Some(belief), "{}: {position}", course.world);
        }
        again.next();
        assert_eq!(again.next(), None);
    }
}

#[test]
fn a_robot_of_a_world_tells_what_holds_there_and_is_led_into_no_home() {
    let run = goodbot(
        &["teach", &world_file("lamps"), "--lines"],
        b"state\nhome random 3\nnext\ncommand all red\nstep\ngood\nback\nforget\nundo\n",
    );
    assert_eq!(run.code, 2);
    let answers: Vec<Value> = run.output.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!((&answers[0]["type"], &answers[0]["world"]), (&Value::from("ready"), &Value::from("lamps")));
    assert_eq!(answers[0]["facts"], serde_json::json!(["lampOn(lamp3)", "lampOff(lamp0)", "lampOff(lamp1)", "lampOff(lamp2)"]));
    let refused: Vec<&str> = answers.iter().filter_map(|answer| answer["message"].as_str()).collect();
    assert!(
        matches!(refused.as_slice(), [home, undo] if home.contains("a world from a file") && undo.contains("nothing was learned")),
        "{refused:?}"
    );
    let heard = answers.iter().find(|answer| answer["type"] == "heard").expect("heard");
    assert!(heard["tasks"].as_array().expect("tasks").iter().any(|task| task["words"] == "lamp on: red kitchen lamp"), "{heard}");
    let acted = answers.iter().find(|answer| answer["type"] == "acted").expect("acted");
    assert!(acted["facts"].is_array() && acted["plan"] == "toward", "{acted}");
}

/// A robot that does things, and one kind of task, for this many of them together.
fn chores(objects: usize, together: usize) -> String {
    let objects: Vec<String> =
        (0..objects).map(|at| format!(r#"{{"name":"x{at}","class":"thing","attributes":{{"name":"x{at}"}}}}"#)).collect();
    let kind: Vec<String> = (0..together).map(|at| format!("done(?x{at})")).collect();
    format!(
        r#"{{"type":"world","name":"w","classes":["thing"],"attributes":{{"name":["thing"]}},"propositions":{{"done":["thing"]}},"objects":[{}],"actions":[{{"name":"do","parameters":{{"?x":"thing"}},"conditions":["!done(?x)"],"effects":["done(?x)"]}}],"task_kinds":["{}"]}}"#,
        objects.join(","),
        kind.join(" & ")
    )
}

#[test]
fn things_to_be_done_together_are_one_task_in_whatever_order() {
    for (objects, together, tasks) in [(5, 3, 10), (6, 4, 15), (4, 2, 6)] {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("w.json");
        std::fs::write(&file, chores(objects, together)).expect("a file");
        let file = file.to_str().expect("UTF-8");
        let checked = goodbot(&["check", file], b"").output;
        assert!(checked.contains(&format!("{tasks} tasks")), "{checked}");
        // Its name in the log has another order.
        let meant: Vec<String> = (0..together).rev().map(|at| format!("done(x{at})")).collect();
        let lesson = format!("command clean up\nintended {}\n{}", meant.join(" & "), "step\nauto\n".repeat(12));
        let run = goodbot(&["teach", file, "--lines"], lesson.as_bytes());
        let answers: Vec<Value> = run.output.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
        assert_eq!(answers[1]["tasks"].as_array().expect("tasks").len(), tasks, "{}", answers[1]);
        let judged = answers.iter().rfind(|answer| answer["type"] == "judged").expect("judged");
        let best = &judged["tasks"][0];
        // With a task for each order, the feedback would count for all of them alike.
        let orders: usize = (1..=together).product();
        assert!(best["probability"].as_f64() > Some(1.0 / orders as f64), "{best}");
        assert!((0..together).all(|at| best["task"].as_str().is_some_and(|task| task.contains(&format!("done(x{at})")))), "{best}");
    }
}

#[test]
fn a_world_that_was_changed_is_told_anew_in_the_same_log() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("lamps.json");
    let model = folder.path().join("lamps.goodbot");
    let world = std::fs::read_to_string(world_file("lamps")).expect("a world");
    let lesson = |lamp: &str| format!("command {lamp} on\nintended lampOn({lamp})\n{}finish\n", "step\nauto\n".repeat(6));
    let teach = |text: &str, lesson: &str| {
        std::fs::write(&file, text).expect("a file");
        let run =
            goodbot(&["teach", file.to_str().expect("UTF-8"), "--lines", "--model", model.to_str().expect("UTF-8")], lesson.as_bytes());
        assert_eq!(run.code, 0, "{}{}", run.output, run.messages);
    };
    teach(&world, &lesson("lamp0"));
    teach(&world, &lesson("lamp1"));
    let more = r#""objects":[{"name":"lamp4","class":"lamp","attributes":{"color":"pink"}},"#;
    teach(&world.replace("\"objects\":[", more).replace("\"lampOff(lamp0)\",", "\"lampOff(lamp0)\",\"lampOff(lamp4)\","), &lesson("lamp4"));
    let log = model.with_extension("jsonl");
    let text = std::fs::read_to_string(&log).expect("a log");
    assert_eq!(text.lines().filter(|line| line.starts_with(r#"{"type":"world""#)).count(), 2);
    let checked = goodbot(&["check", log.to_str().expect("UTF-8")], b"");
    assert!(checked.output.contains("a log of worlds with 3 sessions, no fault"), "{}{}", checked.output, checked.messages);
    assert_eq!(goodbot(&["replay", log.to_str().expect("UTF-8")], b"").code, 0);
}

#[test]
fn what_was_learned_in_a_home_is_understood_in_another_world_with_the_same_words_and_attributes() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = folder.path().join("home.goodbot");
    let model = model.to_str().expect("UTF-8");
    let home = "#############\n#rrr#ggg#bbb#\n#r@r+ggg+bbb#\n#rrr#ggg#bbb#\n#############\n";
    let file = folder.path().join("home.txt");
    std::fs::write(&file, home).expect("a file");
    let lessons = [
        ("go to the green one", "agentInRoom(agent0,room1)"),
        ("go to the blue one", "agentInRoom(agent0,room2)"),
        ("the green one please", "agentInRoom(agent0,room1)"),
        ("the blue one now", "agentInRoom(agent0,room2)"),
    ];
    // All lamps are off, so all tasks are of one kind: no home tells which word means "on".
    let lamps = std::fs::read_to_string(world_file("lamps")).expect("a world").replace("lampOn(lamp3)\"]", "lampOff(lamp3)\"]");
    let world = folder.path().join("lamps.json");
    std::fs::write(&world, lamps).expect("a file");
    let world = world.to_str().expect("UTF-8");
    teach(&[file.to_str().expect("UTF-8"), "--model", model], &lessons);
    for (words, lamp) in [("the blue one", "lampOn(lamp1)"), ("the green one", "lampOn(lamp3)")] {
        let asked = lines_of(&goodbot(&["ask", "--with", model, "--environment", world, "--json", words], b""));
        assert_eq!(asked[0]["task"].as_str(), Some(lamp), "{words}: {}", asked[0]);
    }
    // It continues to learn there, with its learned words.
    let log = folder.path().join("lamps.jsonl");
    let run = goodbot(&["teach", world, "--lines", "--model", model, "--log", log.to_str().expect("UTF-8")], b"command the blue one\n");
    let heard: Value = serde_json::from_str(run.output.lines().nth(1).expect("an answer")).expect("JSON");
    assert_eq!(heard["tasks"][0]["task"].as_str(), Some("lampOn(lamp1)"), "{heard}");
    assert!(run.messages.contains("taken along"), "{}", run.messages);
}

#[test]
fn a_robot_of_a_world_listens_after_twenty_lessons_and_its_log_says_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = folder.path().join("lamps.goodbot");
    let arguments = [&world_file("lamps"), "--model", model.to_str().expect("UTF-8")];
    let lessons = [
        ("switch the red one in the kitchen on", "lampOn(lamp0)"),
        ("switch the blue one in the kitchen on", "lampOn(lamp1)"),
        ("switch the red one in the bedroom on", "lampOn(lamp2)"),
        ("switch the green one off", "lampOff(lamp3)"),
        ("turn the green one in the hall off", "lampOff(lamp3)"),
        ("turn the blue one on", "lampOn(lamp1)"),
    ];
    teach(&arguments.map(|it| it), &lessons.repeat(4));
    let mut robot = Robot::new(&arguments.map(|it| it));
    let heard = robot.one("command switch the red one in the kitchen on and then switch the green one off");
    assert_eq!((&heard["verdict"], &heard["rest"]), (&Value::from("try"), &Value::from("switch the green one off")), "{heard}");
    assert_eq!(robot.walk(|_| "good".to_owned()), "lampOn(lamp0)");
    assert_eq!(robot.tell("finish")[1]["command"], "switch the green one off");
    assert_eq!(robot.walk(|_| "good".to_owned()), "lampOff(lamp3)");
    robot.tell("finish");
    assert_eq!(robot.one("command hello robot")["verdict"], "none");
    drop(robot);
    let log = model.with_extension("jsonl");
    let log = log.to_str().expect("UTF-8");
    assert!(
        std::fs::read_to_string(log)
            .expect("a log")
            .contains("\"utterance\":\"switch the red one in the kitchen on and then switch the green one off\"")
    );
    for command in ["check", "replay"] {
        let run = goodbot(&[command, log], b"");
        assert!(
            run.code == 0 && run.output.contains("26 sessions") | run.output.contains("sessions             26"),
            "{}{}",
            run.output,
            run.messages
        );
    }
}

#[test]
fn a_task_whose_variables_are_interchangeable_is_one_task_that_can_be_believed_in() {
    let jobs = ["sweep", "mop", "dust", "iron", "cook"];
    let objects: Vec<Value> = jobs.iter().map(|job| json!({"name": job, "class": "job"})).collect();
    let actions: Vec<Value> =
        jobs.iter().map(|job| json!({"name": format!("do-{job}"), "conditions": [], "effects": [format!("done({job})")]})).collect();
    let world = json!({
        "type": "world", "name": "chores", "classes": ["job"], "attributes": {}, "propositions": {"done": ["job"]},
        "objects": objects, "facts": [], "actions": actions, "task_kinds": ["done(?a) & done(?b)"]
    });
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("chores.json");
    std::fs::write(&file, world.to_string()).expect("a file");
    let checked = goodbot(&["check", file.to_str().expect("UTF-8")], b"");
    assert!(checked.output.contains("10 tasks"), "{}{}", checked.output, checked.messages);
    let mut robot = Robot::new(&[file.to_str().expect("UTF-8"), "--seed", "1"]);
    robot.one("command sweep and mop");
    let (mut done, mut belief) = (BTreeSet::new(), Value::Null);
    while done.len() < 2 {
        let step = robot.one("step");
        let action = step["action"].as_str().expect("an action").to_owned();
        let right = ["do-sweep", "do-mop"].contains(&action.as_str());
        belief = robot.one(if right { "good" } else { "bad" });
        if right {
            done.insert(action);
        }
    }
    let first = &belief["tasks"][0];
    assert_eq!(first["task"], "done(sweep) & done(mop)", "{belief}");
    assert!(first["probability"].as_f64().is_some_and(|probability| probability > 0.9), "{belief}");
}

#[test]
fn a_model_is_migrated_to_the_next_version_of_its_robot() {
    let course = &COURSES[0];
    let folder = tempfile::tempdir().expect("a folder");
    let (model, _) = taught(folder.path(), course);
    let path = |name: &str| folder.path().join(name).to_str().expect("UTF-8").to_owned();
    let old = world_file(course.world);
    let text = std::fs::read_to_string(&old).expect("a world");
    std::fs::write(path("new.json"), text.replace("liftAtFloor", "cabinAtFloor")).expect("a file");
    let (model, new) = (model.to_str().expect("UTF-8"), path("new.json"));
    let out = path("new.goodbot");
    let migrate = |rename: &[&str]| {
        let arguments = [&["migrate", model, "--from", &old, "--to", &new, "--out", &out, "--force"], rename].concat();
        goodbot(&arguments, b"")
    };
    let run = migrate(&["--rename", "liftAtFloor=cabinAtFloor"]);
    assert_eq!(run.code, 0, "{}", run.messages);
    let asked = lines_of(&goodbot(&["ask", "--with", &out, "--environment", &new, "--json", course.asked.0], b""));
    assert_eq!(asked[0]["task"].as_str(), Some("cabinAtFloor(lift0,floor3)"), "{}", asked[0]);
    // Without the new name there is nothing to keep, and it is told.
    let run = migrate(&[]);
    assert_eq!(run.code, 0, "{}", run.messages);
    assert!(run.messages.contains("liftAtFloor is not in") && run.messages.contains("3 sessions left out"), "{}", run.messages);
    assert_eq!(Contents::read(&std::fs::read(&out).expect("a model")).expect("a model").sessions.len(), 0);
    let run = goodbot(&["migrate", model, "--from", &new, "--to", &old, "--out", &out, "--force"], b"");
    assert!(run.code == 2 && run.messages.contains("another vocabulary"), "{}", run.messages);
    assert_eq!(migrate(&["--rename", "liftAtFloor"]).code, 2);
}
