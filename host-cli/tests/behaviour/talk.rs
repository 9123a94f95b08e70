//! Utterances beside commands, and the answers of `goodbot ask`. The lessons and the sentences have different words and homes.

mod suite;

use crate::program::goodbot;
use serde_json::{Value, json};
use std::io::Write as _;

const COLORS: [&str; 6] = ["red", "blue", "green", "yellow", "purple", "orange"];
const SHAPES: [&str; 3] = ["bag", "chair", "basket"];

/// A home: a row of rooms, the blocks by color, shape and room, and the room of the robot.
pub struct Home {
    pub rooms: Vec<&'static str>,
    pub blocks: Vec<(&'static str, &'static str, usize)>,
    pub robot: usize,
}

impl Home {
    /// One of many homes: 3 to 5 rooms with 2 to 4 blocks, no two of which are alike.
    pub fn number(seed: usize) -> Self {
        // Steps without a common factor with the lengths visit all values.
        let pick = |of: usize, step: usize| (seed * step + seed / of + step) % of;
        let rooms: Vec<_> = (0..3 + pick(3, 7)).map(|room| COLORS[(pick(6, 5) + room * [1, 5][seed % 2]) % 6]).collect();
        let mut blocks: Vec<(&str, &str, usize)> = Vec::new();
        for block in 0..2 + pick(3, 11) {
            let found =
                (COLORS[(pick(6, 13) + block * 2) % 6], SHAPES[(pick(3, 17) + block) % 3], (pick(rooms.len(), 19) + block) % rooms.len());
            if !blocks.iter().any(|(color, shape, _)| (*color, *shape) == (found.0, found.1)) {
                blocks.push(found);
            }
        }
        let robot = pick(rooms.len(), 23);
        Self { rooms, blocks, robot }
    }

    pub fn json(&self) -> Value {
        let mut objects = Vec::new();
        for (at, color) in self.rooms.iter().enumerate() {
            objects.push(json!({"class": "room", "name": format!("room{at}"), "left": at * 4, "bottom": 0, "right": at * 4 + 4, "top": 6, "color": color}));
            if at > 0 {
                objects.push(json!({"class": "door", "name": format!("door{at}"), "left": at * 4, "bottom": 3, "right": at * 4, "top": 3}));
            }
        }
        for (at, (color, shape, room)) in self.blocks.iter().enumerate() {
            let (x, y) = (room * 4 + 1 + at % 3, [1, 5][at / 3]);
            objects.push(json!({"class": "block", "name": format!("block{at}"), "x": x, "y": y, "color": color, "shape": shape}));
        }
        objects.push(json!({"class": "agent", "name": "agent0", "x": self.robot * 4 + 2, "y": 3}));
        json!({"version": 1, "objects": objects})
    }
}

pub fn go(room: usize) -> String {
    format!("agentInRoom(agent0,room{room})")
}

pub fn take(block: usize, room: usize) -> String {
    format!("blockInRoom(block{block},room{room})")
}

/// A prohibition.
fn not(task: &str) -> String {
    format!("!{task}")
}

/// Tasks in order.
fn then(tasks: &[String]) -> String {
    tasks.join(" then ")
}

/// The words of commands in lessons.
pub struct Wording {
    pub going: [&'static str; 4],
    pub taking: [&'static str; 3],
    /// The words for colors and shapes, if they differ from the values.
    names: &'static [(&'static str, &'static str)],
}

pub const ENGLISH: Wording = Wording {
    going: ["go to the {} room", "move to the {} room", "walk into the {} room", "go into the {} room"],
    taking: ["take the {c} {s} to the {} room", "bring the {c} {s} to the {} room", "put the {c} {s} into the {} room"],
    names: &[],
};

const GERMAN: Wording = Wording {
    going: ["geh ins {} Zimmer", "lauf ins {} Zimmer", "fahr in das {} Zimmer", "geh in das {} Zimmer"],
    taking: ["bring die {c} {s} ins {} Zimmer", "trag die {c} {s} ins {} Zimmer", "stell die {c} {s} in das {} Zimmer"],
    names: &[
        ("red", "rote"),
        ("blue", "blaue"),
        ("green", "grüne"),
        ("yellow", "gelbe"),
        ("purple", "lila"),
        ("orange", "orange"),
        ("bag", "Tasche"),
        ("chair", "Bank"),
        ("basket", "Kiste"),
    ],
};

const FRENCH: Wording = Wording {
    going: ["va dans la salle {}", "va à la salle {}", "entre dans la salle {}", "rends-toi dans la salle {}"],
    taking: ["apporte la {s} {c} dans la salle {}", "porte la {s} {c} dans la salle {}", "pousse la {s} {c} dans la salle {}"],
    names: &[
        ("red", "rouge"),
        ("blue", "bleue"),
        ("green", "verte"),
        ("yellow", "jaune"),
        ("purple", "violette"),
        ("bag", "malle"),
        ("chair", "chaise"),
        ("basket", "caisse"),
    ],
};

const SPANISH: Wording = Wording {
    going: ["ve a la sala {}", "entra en la sala {}", "anda a la sala {}", "muévete a la sala {}"],
    taking: ["lleva la {s} {c} a la sala {}", "trae la {s} {c} a la sala {}", "empuja la {s} {c} a la sala {}"],
    names: &[
        ("red", "roja"),
        ("blue", "azul"),
        ("green", "verde"),
        ("yellow", "amarilla"),
        ("purple", "morada"),
        ("orange", "naranja"),
        ("bag", "bolsa"),
        ("chair", "silla"),
        ("basket", "cesta"),
    ],
};

impl Wording {
    fn name(&self, value: &'static str) -> &'static str {
        self.names.iter().find(|(known, _)| *known == value).map_or(value, |(_, name)| name)
    }
}

/// A model that learned commands: the words and the tasks, each in a home.
fn told(lessons: impl Iterator<Item = (Home, String, String)>) -> (tempfile::TempDir, String) {
    let mut log = String::new();
    for (lesson, (home, command, task)) in lessons.enumerate() {
        let session = json!({"type": "session", "version": 1, "id": lesson.to_string(), "kind": "labelled", "environment": home.json(), "command": command, "intended": [task]});
        log += &format!("{session}\n{}\n", json!({"type": "end", "learn": true}));
    }
    let folder = tempfile::tempdir().expect("a folder");
    let model = folder.path().join("words.goodbot").to_str().expect("a name").to_owned();
    let run = goodbot(&["learn", "-", "--quiet", "--out", &model], log.as_bytes());
    assert_eq!(run.code, 0, "{}", run.messages);
    (folder, model)
}

/// A model that learned commands as labels, in `lessons` homes.
pub fn taught(lessons: usize, wording: &Wording) -> (tempfile::TempDir, String) {
    told((0..lessons).map(|lesson| {
        let home = Home::number(lesson);
        let room = (home.robot + 1 + lesson % (home.rooms.len() - 1)) % home.rooms.len();
        let block = lesson % home.blocks.len();
        let (color, shape, place) = home.blocks[block];
        if lesson % 2 == 0 || place == room {
            let room = if room == home.robot { (room + 1) % home.rooms.len() } else { room };
            let words = wording.going[lesson / 2 % 4].replace("{}", wording.name(home.rooms[room]));
            (home, words, go(room))
        } else {
            let words = wording.taking[lesson / 2 % 3].replace("{}", wording.name(home.rooms[room]));
            let words = words.replace("{c}", wording.name(color)).replace("{s}", wording.name(shape));
            (home, words, take(block, room))
        }
    }))
}

/// The answers to sentences in a home.
fn asked(model: &str, home: &Home, sentences: &[String]) -> Vec<Value> {
    asked_with(&[], model, home, sentences)
}

/// The answers to sentences in a home, with some options.
fn asked_with(options: &[&str], model: &str, home: &Home, sentences: &[String]) -> Vec<Value> {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("home.json");
    std::fs::write(&file, home.json().to_string()).expect("a file");
    let ask = ["ask", "--with", model, "--environment", file.to_str().expect("a name"), "--json", "-"];
    let run = goodbot(&[&ask[..], options].concat(), sentences.join("\n").as_bytes());
    assert_eq!(run.code, 0, "{}", run.messages);
    run.output.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
}

/// Keeps sentences with their meanings as a set to train with, in the folder that `GOODBOT_SETS` names. Its `sets.tsv` is a list for
/// `goodbot acts`: `GOODBOT_SETS=$PWD/sets cargo test -p goodbot-cli --test behaviour talk -- --include-ignored --test-threads 1`.
fn keep(language: &str, model: &str, home: &Home, rows: &[(&str, &str, String)]) {
    let Some(folder) = std::env::var_os("GOODBOT_SETS").map(std::path::PathBuf::from) else { return };
    std::fs::create_dir_all(&folder).expect("a folder");
    let name = format!("{language}.{:03}", std::fs::read_dir(&folder).expect("a folder").count());
    std::fs::copy(model, folder.join(format!("{name}.goodbot"))).expect("a model");
    std::fs::write(folder.join(format!("{name}.json")), home.json().to_string()).expect("a file");
    let rows: String = rows.iter().map(|(kind, words, meaning)| format!("{kind}\t{words}\t{meaning}\n")).collect();
    std::fs::write(folder.join(format!("{name}.tsv")), rows).expect("a file");
    let mut list = std::fs::OpenOptions::new().append(true).create(true).open(folder.join("sets.tsv")).expect("a file");
    writeln!(list, "+suite\t{language}\t{name}.goodbot\t{name}.json\t{name}.tsv").expect("a file");
}

/// A sentence, and its task if the robot can do one.
type Said = (String, Option<String>);

/// Sentences to be followed, or about tasks that are done already.
fn to_follow(home: &Home) -> Vec<Said> {
    let mut said = Vec::new();
    for (room, color) in home.rooms.iter().enumerate() {
        for words in [
            "go to the {} room",
            "would you be so kind as to go to the {} room",
            "walk itno the {} rom",
            "please go to the {} room now thank you",
        ] {
            said.push((words.replace("{}", color), Some(go(room))));
        }
        for (block, (of_block, shape, _)) in home.blocks.iter().enumerate() {
            for words in
                ["take the {c} {s} to the {} room", "could you bring the {c} {s} to the {} room", "put hte {c} {s} into the {} romo"]
            {
                said.push((words.replace("{c}", of_block).replace("{s}", shape).replace("{}", color), Some(take(block, room))));
            }
        }
    }
    said
}

/// Prohibitions, several commands, and commands about all things.
fn to_follow_in_parts(home: &Home) -> Vec<Said> {
    let mut said = Vec::new();
    for (room, color) in home.rooms.iter().enumerate() {
        for words in ["don't go to the {} room", "never go into the {} room", "leave the {} room", "stay out of the {} room"] {
            said.push((words.replace("{}", color), Some(not(&go(room)))));
        }
        let first = (room + 1) % home.rooms.len();
        for words in ["go to the {a} room and then walk into the {} room", "please move to the {a} room, then go to the {} room"] {
            let words = words.replace("{a}", home.rooms[first]).replace("{}", color);
            said.push((words, Some(then(&[go(first), go(room)]))));
        }
        let elsewhere = (0..home.blocks.len()).filter(|&block| home.blocks[block].2 != room);
        let mut tasks: Vec<String> = elsewhere.map(|block| take(block, room)).collect();
        if tasks.is_empty() {
            tasks = (0..home.blocks.len()).map(|block| take(block, room)).collect();
        }
        said.push((format!("bring everything to the {color} room"), Some(then(&tasks))));
    }
    for (block, (color, shape, place)) in home.blocks.iter().enumerate() {
        let words = format!("take the {color} {shape} out of the {} room", home.rooms[*place]);
        said.push((words, Some(not(&take(block, *place)))));
    }
    said
}

/// Sentences that name no task.
fn not_to_follow(home: &Home) -> Vec<Said> {
    let mut said: Vec<String> =
        ["stop", "hello", "good robot", "no the other one", "do it again", "where is the bag", "take it there"].map(str::to_owned).into();
    for color in COLORS.iter().filter(|color| !home.rooms.contains(color)) {
        said.push(format!("go to the {color} room"));
        said.push(format!("don't go to the {color} room"));
    }
    said.into_iter().map(|words| (words, None)).collect()
}

/// The sentences of a home, of all kinds.
pub fn sentences(home: &Home) -> Vec<String> {
    [to_follow(home), to_follow_in_parts(home), not_to_follow(home)].concat().into_iter().map(|(words, _)| words).collect()
}

#[test]
fn after_enough_lessons_what_is_meant_is_followed_and_the_rest_is_not_taken_for_a_task() {
    let (_folder, model) = taught(120, &ENGLISH);
    let (mut follow, mut helpful, mut all, mut harmful, mut faults) = (0, 0, 0, 0, String::new());
    for seed in [1_003, 1_010, 1_022, 1_037] {
        let home = Home::number(seed);
        let said = [to_follow(&home), to_follow_in_parts(&home), not_to_follow(&home)].concat();
        let sentences: Vec<String> = said.iter().map(|(words, _)| words.clone()).collect();
        for ((words, meant), answer) in said.iter().zip(asked(&model, &home, &sentences)) {
            let is_sure = answer["verdict"] == "sure" || answer["verdict"] == "done";
            let is_right = is_sure && answer["task"].as_str() == meant.as_deref();
            all += 1;
            follow += usize::from(meant.is_some());
            helpful += usize::from(is_right);
            harmful += usize::from(is_sure && !is_right);
            if is_sure != is_right || (meant.is_some() && !is_right) {
                faults += &format!("{words}: {} {}\n", answer["verdict"], answer["task"]);
            }
        }
    }
    // At least 92 % of the commands must be followed, and at most 2 % of all answers may do harm.
    assert!(helpful * 100 >= follow * 92 && harmful * 50 <= all, "helpful {helpful} of {follow}, harmful {harmful} of {all}\n{faults}");
}

#[test]
fn the_answer_says_what_an_utterance_is_taken_for() {
    let (_folder, model) = taught(120, &ENGLISH);
    let home = Home { rooms: vec!["red", "blue", "green"], blocks: vec![("yellow", "bag", 2), ("red", "chair", 0)], robot: 0 };
    let cases = [
        ("go to the blue room", "sure", "a command"),
        ("go to the red room", "done", "a command"),
        ("take the yellow bag to the green room", "done", "a command"),
        ("don't go to the blue room", "done", "a prohibition"),
        ("leave the red room", "sure", "a prohibition"),
        ("go to the blue room and then go to the green room", "sure", "several commands"),
        ("bring all chairs to the blue room", "sure", "all things of a kind"),
        ("bring all bags to the green room", "done", "all things of a kind"),
        ("go to the purple room", "none", "a thing that is not here"),
        ("flub wib zonk", "none", "nothing that I can do"),
        ("please", "none", "nothing that I can do"),
        ("stop", "none", "stop"),
        ("hello", "none", "greeting"),
        ("good robot", "none", "praise"),
        ("wrong", "none", "blame"),
        ("yes please", "none", "yes"),
        ("no", "none", "no"),
        ("undo it", "none", "again"),
    ];
    let sentences: Vec<String> = cases.iter().map(|(words, ..)| (*words).to_owned()).collect();
    for ((words, verdict, taken_for), answer) in cases.iter().zip(asked(&model, &home, &sentences)) {
        assert_eq!((answer["verdict"].as_str(), answer["taken_for"].as_str()), (Some(*verdict), Some(*taken_for)), "{words}: {answer}");
        // The blocks are along walls, and the robot cannot pull.
        let is_to_do = *verdict == "sure" && !words.contains("chairs");
        assert_eq!(answer["plan"].is_array(), is_to_do, "{words}: a plan only for what was told and is to do: {answer}");
    }
}

#[test]
fn a_robot_that_is_taught_waits_where_there_is_nothing_to_do_and_tries_when_it_is_told_again() {
    let (_folder, model) = taught(60, &ENGLISH);
    let home = Home { rooms: vec!["red", "blue", "green"], blocks: vec![("yellow", "chair", 1)], robot: 0 }.json();
    let requests = format!(
        "home {home}\ncommand go to the red room\nstep\ncommand hello\ncommand go to the red room\ncommand go to the red room\nforget\n\
         command don't go to the red room\nforget\ncommand don't go to the blue room\ncommand go to the blue room\n"
    );
    let run = goodbot(&["teach", "--model", &model, "--log", &format!("{model}.jsonl")], requests.as_bytes());
    let answers: Vec<Value> = run.output.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let heard: Vec<_> = answers.iter().filter(|line| line["type"] == "heard").map(|line| line["verdict"].as_str().unwrap()).collect();
    assert_eq!(heard, ["done", "none", "done", "try", "try", "done", "try"], "{}{}", run.output, run.messages);
    assert!(answers.iter().any(|line| line["done"] == "go to the red room"));
    assert!(answers.iter().any(|line| line["message"] == "no session is under way"), "it waits");
}

#[test]
fn a_robot_that_was_taught_two_commands_from_one_place_is_sure_of_them() {
    // Every lesson starts in the blue room, so "go", "the" and the blue room are in all of them.
    let home = || Home { rooms: vec!["green", "blue", "red"], blocks: Vec::new(), robot: 1 };
    let lessons = (0..24).map(|lesson| {
        let (color, room) = [("red", 2), ("green", 0)][lesson % 2];
        (home(), format!("go to the {color} room"), go(room))
    });
    let (_folder, model) = told(lessons);
    let cases = [
        ("go to the red room", "sure", &*go(2)),
        ("go to the green room", "sure", &*go(0)),
        ("go to the red room please", "sure", &*go(2)),
        ("hello", "none", ""),
    ];
    check(&model, &home(), &cases);
}

/// Checks verdicts and tasks of sentences in a home. What people mean is learned, so a table tells a tendency: the robot does what is meant in
/// three of five sentences that ask for something, and at most one answer, or one of eight, is sure of something else.
fn check(model: &str, home: &Home, cases: &[(&str, &str, &str)]) {
    let sentences: Vec<String> = cases.iter().map(|(words, ..)| (*words).to_owned()).collect();
    let meaning = |verdict: &str, task: &str| if ["sure", "done"].contains(&verdict) { task } else { "none" }.to_owned();
    keep("any", model, home, &cases.iter().map(|&(words, verdict, task)| (verdict, words, meaning(verdict, task))).collect::<Vec<_>>());
    judge(cases, &asked(model, home, &sentences));
}

/// Checks answers as [`check`] does.
fn judge(cases: &[(&str, &str, &str)], answers: &[Value]) {
    assert_eq!(cases.len(), answers.len());
    let acts = |verdict: &str| ["sure", "done"].contains(&verdict);
    let (mut asked, mut right, mut wrong, mut told) = (0, 0, 0, String::new());
    for ((words, verdict, task), answer) in cases.iter().zip(answers) {
        let (said, meant) = (answer["verdict"].as_str().expect("a verdict"), answer["task"].as_str().unwrap_or_default());
        let is_right = said == *verdict && meant == *task;
        asked += usize::from(acts(verdict));
        right += usize::from(acts(verdict) && is_right);
        wrong += usize::from(acts(said) && !is_right);
        if (acts(verdict) || acts(said)) && !is_right {
            told.push_str(&format!("{words}: {said} {meant} instead of {verdict} {task}\n"));
        }
    }
    assert!(right * 5 >= asked * 3 && wrong <= (cases.len() / 8).max(1), "{right} of {asked}, {wrong} wrong of {}:\n{told}", cases.len());
}

/// Three rooms with the robot in the first, a yellow bag in the last, and two chairs.
pub fn three_rooms() -> Home {
    let blocks = vec![("yellow", "bag", 2), ("red", "chair", 0), ("green", "chair", 1)];
    Home { rooms: vec!["red", "blue", "green"], blocks, robot: 0 }
}

#[test]
fn a_first_look_scores_sentences_by_what_the_robot_does_of_all_their_commands() {
    let (folder, model) = taught(120, &ENGLISH);
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
    write("home.json", &three_rooms().json().to_string());
    let rows = [
        ("plain", "go to the blue room", go(1)),
        // The robot takes the bag to another room than this meaning says.
        ("plain", "take the yellow bag to the red room", take(0, 1)),
        ("sequence", "go to the green room and then to the blue room", then(&[go(2), go(1)])),
        ("thanks", "thanks for going to the green room", "none".to_owned()),
    ];
    write("said.tsv", &rows.map(|(kind, words, meaning)| format!("{kind}\t{words}\t{meaning}\n")).concat());
    write("sets.tsv", &format!("somebody\ten\t{model}\thome.json\tsaid.tsv\n"));
    let sets = folder.path().join("sets.tsv");
    let run = goodbot(&["acts", sets.to_str().expect("a name"), "--first-look", "--json"], b"");
    assert_eq!(run.code, 0, "{}", run.messages);
    let lines: Vec<Value> = run.output.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let of = |kind: &str| lines.iter().find(|line| line["kind"] == kind).unwrap_or_else(|| panic!("{lines:?}"));
    assert_eq!((of("")["sentences"].as_u64(), of("")["meant"].as_u64()), (Some(4), Some(3)));
    assert_eq!((of("plain")["helpful"].as_f64(), of("plain")["harmful"].as_f64()), (Some(0.5), Some(0.5)));
    assert_eq!((of("sequence")["helpful"].as_f64(), of("thanks")["harmful"].as_f64()), (Some(1.0), Some(0.0)));
}

#[test]
fn what_decides_whether_to_act_can_be_trained_anew_and_damaged_weights_are_refused() {
    let (folder, model) = taught(120, &ENGLISH);
    let write = |name: &str, text: &[u8]| {
        let file = folder.path().join(name);
        std::fs::write(&file, text).expect("a file");
        file.to_str().expect("a name").to_owned()
    };
    write("home.json", three_rooms().json().to_string().as_bytes());
    // These people never mean what they say.
    let rows = [
        "go to the red room",
        "go to the blue room",
        "go to the green room",
        "move to the red room",
        "take the yellow bag to the red room",
    ];
    write("said.tsv", rows.map(|words| format!("plain\t{words}\tnone\n")).concat().as_bytes());
    let sets = write("sets.tsv", format!("somebody\ten\t{model}\thome.json\tsaid.tsv\n").as_bytes());
    let trained = folder.path().join("new.acts").to_str().expect("a name").to_owned();
    let run = goodbot(&["acts", &sets, "--weights", &trained], b"");
    assert_eq!(run.code, 0, "{}", run.messages);
    for (file, reason) in [(&sets, "is read here, and would be replaced"), (&model, "is no file of weights")] {
        let refused = goodbot(&["acts", &sets, "--weights", file], b"");
        assert!(refused.code != 0 && refused.messages.contains(reason), "{}", refused.messages);
    }
    let verdict = |weights: &str| {
        let answers = asked_with(&["--acts", weights], &model, &three_rooms(), &["go to the blue room".to_owned()]);
        answers[0]["verdict"].as_str().expect("a verdict").to_owned()
    };
    let built_in = include_bytes!("../../../core/src/talk/acceptance/weights.acts");
    assert_eq!((verdict(&write("same.acts", built_in)), verdict(&trained)), ("sure".to_owned(), "unsure".to_owned()));
    let mut damaged = built_in.to_vec();
    damaged[1_000] ^= 1;
    for (weights, reason) in [(&damaged[..], "their checksum is wrong"), (&built_in[..5_000], "too few or too many"), (b"{}", "no weights")]
    {
        let home = folder.path().join("home.json");
        let ask = ["ask", "--with", &model, "--environment", home.to_str().expect("a name"), "--acts"];
        let refused = goodbot(&[&ask[..], &[&write("bad.acts", weights), "go"]].concat(), b"");
        assert!(refused.code != 0 && refused.messages.contains(reason), "{}", refused.messages);
    }
}

#[test]
fn what_shall_not_be_is_a_task_of_its_own_and_planned_for() {
    let (_folder, model) = taught(120, &ENGLISH);
    let home = three_rooms();
    let cases = [
        ("leave the red room", "sure", "!agentInRoom(agent0,room0)"),
        ("stay out of the blue room", "done", "!agentInRoom(agent0,room1)"),
        ("never go into the green room", "done", "!agentInRoom(agent0,room2)"),
        ("go anywhere but the red room", "sure", "!agentInRoom(agent0,room0)"),
        ("dont go to teh red room", "sure", "!agentInRoom(agent0,room0)"),
        ("please take the yellow bag out of the green room", "sure", "!blockInRoom(block0,room2)"),
        ("take the chair out of the blue room", "sure", "!blockInRoom(block2,room1)"),
        ("don't put the yellow bag into the red room", "done", "!blockInRoom(block0,room0)"),
        // It is more probable that the robot shall stay out, but then nothing would be said of the bag.
        ("don't let the yellow bag go into the red room", "done", "!blockInRoom(block0,room0)"),
    ];
    check(&model, &home, &cases);
    let [answer] = &asked(&model, &home, &["leave the red room".to_owned()])[..] else { panic!("one answer") };
    assert_eq!((&answer["plan"], &answer["exact"]), (&json!(["east", "east"]), &json!(true)), "{answer}");
}

#[test]
fn what_is_left_in_its_place_is_done_already() {
    let (_folder, model) = taught(120, &ENGLISH);
    let cases = [
        ("leave the green chair in the blue room", "done", &*take(2, 1)),
        ("leave the yellow bag where it is", "done", &*take(0, 2)),
        ("keep the yellow bag here", "done", &*take(0, 2)),
        ("stay where you are", "done", &*go(0)),
        ("get out of here", "sure", &*not(&go(0))),
        ("stay out of the blue room", "done", &*not(&go(1))),
        ("don't leave the red room", "done", &*go(0)),
        ("don't take the yellow bag out of the green room", "done", &*take(0, 2)),
        ("the yellow bag should stay in the green room", "done", &*take(0, 2)),
    ];
    check(&model, &three_rooms(), &cases);
}

#[test]
fn a_thing_may_be_named_before_what_must_be_with_it() {
    let (_folder, model) = taught(120, &ENGLISH);
    let cases = [
        ("the bag must not go to the blue room", "done", &*not(&take(0, 1))),
        ("I don't want the bag in the green room", "sure", &*not(&take(0, 2))),
        ("the bag has to go to the red room", "sure", &*take(0, 0)),
    ];
    check(&model, &three_rooms(), &cases);
}

#[test]
fn phrases_that_name_nothing_are_beside_the_command_and_words_outside_a_task_speak_against_it() {
    let (_folder, model) = taught(120, &ENGLISH);
    let blocks = vec![("green", "bag", 0), ("blue", "chair", 1), ("red", "chair", 1), ("yellow", "basket", 2)];
    let home = Home { rooms: vec!["red", "blue", "green", "yellow"], blocks, robot: 1 };
    let both = then(&[not(&take(1, 1)), not(&take(2, 1))]);
    let others = then(&[take(1, 3), take(2, 3), take(3, 3)]);
    let cases = [
        ("hey buddy, go to the red room", "sure", go(0)),
        ("put the basket in the green room", "done", take(3, 2)),
        ("take all the chairs out of the blue room", "sure", both),
        ("bring everything except the bag to the yellow room", "sure", others),
        ("the blue chair, bring it to the green room", "sure", take(1, 2)),
    ];
    check(&model, &home, &cases.each_ref().map(|(words, verdict, task)| (*words, *verdict, task.as_str())));
}

#[test]
fn a_present_place_with_out_of_forbids_nothing_where_another_place_follows() {
    let (_folder, model) = taught(120, &ENGLISH);
    let words = "take the yellow bag out of the green room to the blue room";
    let [answer] = &asked(&model, &three_rooms(), &[words.to_owned()])[..] else { panic!("one answer") };
    assert!(answer["task"] == take(0, 1) && answer["verdict"] != "none", "{answer}");
}

#[test]
fn what_only_sounds_like_a_negation_is_not_followed() {
    let (_folder, model) = taught(120, &ENGLISH);
    let cases = [
        ("don't leave the blue room", "unsure", ""),
        ("not the red one", "unsure", ""),
        ("go to the red room or to the blue room", "unsure", ""),
        ("don't go to the purple room", "none", ""),
        ("never mind", "none", ""),
    ];
    let sentences: Vec<String> = cases.iter().map(|(words, ..)| (*words).to_owned()).collect();
    for ((words, ..), answer) in cases.iter().zip(asked(&model, &three_rooms(), &sentences)) {
        assert!(answer["verdict"] == "unsure" || answer["verdict"] == "none", "{words}: {answer}");
        assert!(answer["plan"].is_null() || answer["taken_for"] == "a command", "{words}: {answer}");
    }
}

#[test]
fn a_command_needs_no_verb_and_other_sentences_with_one_are_no_command() {
    let (_folder, model) = taught(120, &ENGLISH);
    let cases = [
        ("to the blue room", "sure", "agentInRoom(agent0,room1)"),
        ("into the green room with you", "sure", "agentInRoom(agent0,room2)"),
        ("don't forget to go to the blue room", "sure", "agentInRoom(agent0,room1)"),
        ("go to the blue room if you don't mind", "sure", "agentInRoom(agent0,room1)"),
        ("anywhere but the red room", "sure", "!agentInRoom(agent0,room0)"),
        ("remove the yellow bag from the green room", "sure", "!blockInRoom(block0,room2)"),
        ("the yellow bag to the blue room", "sure", "blockInRoom(block0,room1)"),
        ("I'd like the yellow bag in the blue room", "sure", "blockInRoom(block0,room1)"),
        ("the red chair next to the blue room", "unsure", ""),
        ("she brought the yellow bag to the blue room", "unsure", ""),
        ("off with you to the blue room", "sure", "agentInRoom(agent0,room1)"),
        ("it would be nice if you took the yellow bag to the blue room", "sure", "blockInRoom(block0,room1)"),
        ("if it rains, go to the blue room", "unsure", ""),
        ("if I don't come, go to the blue room", "unsure", ""),
        ("should anyone knock, go to the blue room", "unsure", ""),
        ("go to the blue room as soon as the bell rings", "unsure", ""),
        ("go to the blue room tomorrow", "unsure", ""),
        ("go to the blue room, no, forget it", "unsure", ""),
        ("I go to the blue room", "unsure", ""),
        ("go to the green room ... no, stop", "unsure", ""),
    ];
    check(&model, &three_rooms(), &cases);
}

#[test]
fn what_is_said_in_front_of_the_verb_belongs_to_its_command() {
    let (_folder, model) = taught(120, &ENGLISH);
    let cases = [
        ("into the blue room put the yellow bag", "unsure", ""),
        ("to the blue room, please take the yellow bag", "sure", "blockInRoom(block0,room1)"),
        ("right away go to the green room", "sure", "agentInRoom(agent0,room2)"),
        ("stay away from the red room", "sure", "!agentInRoom(agent0,room0)"),
        ("in the blue room there was a yellow bag", "none", ""),
    ];
    check(&model, &three_rooms(), &cases);
    let (_folder, model) = taught(120, &GERMAN);
    check(&model, &three_rooms(), &[("in das blaue Zimmer stell die gelbe Tasche", "sure", "blockInRoom(block0,room1)")]);
}

#[test]
fn who_tells_or_asks_something_commands_nothing() {
    let (_folder, model) = taught(120, &ENGLISH);
    let cases = [
        ("my sister went to the blue room", "unsure", ""),
        ("I could go to the blue room", "unsure", ""),
        ("the postman will go to the blue room", "unsure", ""),
        ("she said she would go to the blue room later", "unsure", ""),
        ("wait until I tell you to go to the blue room", "unsure", ""),
        ("can you go to the blue room?", "sure", "agentInRoom(agent0,room1)"),
        ("I want you to go to the blue room", "sure", "agentInRoom(agent0,room1)"),
        ("I want the red chair in the blue room", "sure", "blockInRoom(block1,room1)"),
        ("I'll take the red chair to the blue room myself", "unsure", ""),
        ("you went to the blue room", "unsure", ""),
        ("I saw you go to the blue room", "unsure", ""),
        ("I never said you should go to the blue room", "unsure", ""),
        ("no need to go to the blue room", "unsure", ""),
        ("sorry, but could you go to the blue room", "sure", "agentInRoom(agent0,room1)"),
        ("first go to the blue room", "sure", "agentInRoom(agent0,room1)"),
        ("you aren't allowed in the blue room", "done", "!agentInRoom(agent0,room1)"),
    ];
    check(&model, &three_rooms(), &cases);
    let (_folder, model) = taught(120, &GERMAN);
    let cases = [
        ("passt die gelbe Tasche in das blaue Zimmer?", "unsure", ""),
        ("Geh ins blaue Zimmer, wenn ich es sage", "unsure", ""),
        ("kannst du die gelbe Tasche ins blaue Zimmer bringen?", "sure", "blockInRoom(block0,room1)"),
    ];
    check(&model, &three_rooms(), &cases);
}

#[test]
fn a_new_word_for_what_to_do_in_a_room_is_no_word_for_going_there() {
    let (_folder, model) = taught(120, &ENGLISH);
    let cases = [
        ("paint the blue room", "unsure", ""),
        ("switch on the light in the blue room", "unsure", ""),
        ("walk to the blue room", "sure", "agentInRoom(agent0,room1)"),
    ];
    check(&model, &three_rooms(), &cases);
}

#[test]
fn a_plural_means_all_things_of_its_kind() {
    let (_folder, model) = taught(120, &ENGLISH);
    let both = "blockInRoom(block0,room1) then blockInRoom(block1,room1)";
    let cases = [
        ("take the bags to the blue room", "sure", both),
        ("take all bags to the blue room", "sure", both),
        ("take one of the bags to the blue room", "unsure", ""),
        ("take any bags to the blue room", "unsure", ""),
        ("take three bags to the blue room", "unsure", ""),
        ("take everything except the yellow bag to the blue room", "sure", "blockInRoom(block1,room1)"),
    ];
    let blocks = vec![("yellow", "bag", 2), ("red", "bag", 0), ("green", "chair", 1)];
    check(&model, &Home { blocks, ..three_rooms() }, &cases);
    // A plural with nearly the spelling of its known singular.
    let cases = [
        ("take the chairs to the blue room", "sure", both),
        ("take two chairs to the blue room", "unsure", ""),
        ("take the red chairs to the blue room", "sure", "blockInRoom(block1,room1)"),
    ];
    let blocks = vec![("yellow", "chair", 2), ("red", "chair", 0), ("green", "bag", 1)];
    check(&model, &Home { blocks, ..three_rooms() }, &cases);
}

#[test]
fn who_corrects_a_command_in_the_same_sentence_is_taken_by_the_correction() {
    let (_folder, model) = taught(120, &ENGLISH);
    let cases = [
        ("go to the red room, no, the blue one", "sure", "agentInRoom(agent0,room1)"),
        ("go to the green room, no, go to the blue room", "sure", "agentInRoom(agent0,room1)"),
        ("take the yellow bag, I mean the red chair, to the blue room", "sure", "blockInRoom(block1,room1)"),
        ("go to the blue room, not the green one", "sure", "agentInRoom(agent0,room1)"),
        ("go to the red room and don't go to the blue room", "done", "agentInRoom(agent0,room0) then !agentInRoom(agent0,room1)"),
    ];
    check(&model, &three_rooms(), &cases);
    let (_folder, model) = taught(120, &GERMAN);
    let cases = [
        ("geh ins rote Zimmer, nein, ins blaue", "sure", "agentInRoom(agent0,room1)"),
        ("geh ins blaue Zimmer, nicht ins grüne", "sure", "agentInRoom(agent0,room1)"),
        ("bring die gelbe Tasche nicht ins rote Zimmer", "done", "!blockInRoom(block0,room0)"),
    ];
    check(&model, &three_rooms(), &cases);
}

#[test]
fn who_takes_a_thing_up_first_gives_one_command() {
    let (_folder, model) = taught(120, &ENGLISH);
    let cases = [
        ("pick up the yellow bag and bring it to the blue room", "sure", "blockInRoom(block0,room1)"),
        ("grab the red chair and carry it to the blue room", "sure", "blockInRoom(block1,room1)"),
    ];
    check(&model, &three_rooms(), &cases);
    let (_folder, model) = taught(120, &GERMAN);
    check(&model, &three_rooms(), &[("nimm die rote Bank und bring sie ins blaue Zimmer", "sure", "blockInRoom(block1,room1)")]);
}

#[test]
fn two_things_may_share_the_place_that_is_named_once() {
    let (_folder, model) = taught(120, &ENGLISH);
    let both = "blockInRoom(block0,room1) then blockInRoom(block1,room1)";
    let cases = [
        ("take the yellow bag and the red chair to the blue room", "sure", both),
        ("the yellow bag and the red chair into the blue room", "sure", both),
        ("take the yellow bag and the piano to the blue room", "unsure", ""),
        ("take the yellow bag and go to the blue room", "unsure", ""),
    ];
    check(&model, &three_rooms(), &cases);
    let (_folder, model) = taught(120, &GERMAN);
    check(&model, &three_rooms(), &[("bring die gelbe Tasche und die rote Bank ins blaue Zimmer", "sure", both)]);
}

#[test]
fn commands_one_after_another_are_each_heard_where_the_one_before_leads_to() {
    let (_folder, model) = taught(120, &ENGLISH);
    let home = three_rooms();
    let cases = [
        ("go to the blue room and then go to the red room", "sure", "agentInRoom(agent0,room1) then agentInRoom(agent0,room0)"),
        ("go to the blue room and then to the green room", "sure", "agentInRoom(agent0,room1) then agentInRoom(agent0,room2)"),
        ("leave the red room and go to the green room", "sure", "!agentInRoom(agent0,room0) then agentInRoom(agent0,room2)"),
        ("go to the red room and don't go to the blue room", "done", "agentInRoom(agent0,room0) then !agentInRoom(agent0,room1)"),
        (
            "take the yellow bag to the blue room and the red chair to the green room",
            "sure",
            "blockInRoom(block0,room1) then blockInRoom(block1,room2)",
        ),
        ("go to the blue room before you go to the red room", "sure", "agentInRoom(agent0,room1) then agentInRoom(agent0,room0)"),
        ("go to the blue room, after that go to the green room", "sure", "agentInRoom(agent0,room1) then agentInRoom(agent0,room2)"),
        (
            "go to the blue room after taking the red chair to the green room",
            "sure",
            "blockInRoom(block1,room2) then agentInRoom(agent0,room1)",
        ),
        (
            "when you have taken the red chair to the green room, go to the blue room",
            "sure",
            "blockInRoom(block1,room2) then agentInRoom(agent0,room1)",
        ),
        ("go to the blue room and turn left", "unsure", ""),
        ("go to the blue room, go to the green room", "sure", "agentInRoom(agent0,room1) then agentInRoom(agent0,room2)"),
        (
            "before you go to the blue room, take the red chair to the green room",
            "sure",
            "blockInRoom(block1,room2) then agentInRoom(agent0,room1)",
        ),
        ("take both the yellow bag and the red chair to the blue room", "sure", "blockInRoom(block0,room1) then blockInRoom(block1,room1)"),
        ("go and take the yellow bag to the blue room", "sure", "blockInRoom(block0,room1)"),
    ];
    check(&model, &home, &cases);
    let [answer] = &asked(&model, &home, &[cases[0].0.to_owned()])[..] else { panic!("one answer") };
    let there_and_back: Vec<&str> = ["east"; 2].into_iter().chain(["west"; 1]).collect();
    assert!(answer["plan"].as_array().is_some_and(|plan| plan.len() > there_and_back.len()), "{answer}");
}

#[test]
fn all_things_of_a_kind_are_a_task_each_without_those_that_are_there() {
    let (_folder, model) = taught(120, &ENGLISH);
    let cases = [
        ("take all chairs to the green room", "sure", "blockInRoom(block1,room2) then blockInRoom(block2,room2)"),
        ("bring both chairs to the red room", "sure", "blockInRoom(block2,room0)"),
        ("everything to the green room", "sure", "blockInRoom(block1,room2) then blockInRoom(block2,room2)"),
        ("bring all bags to the green room", "done", "blockInRoom(block0,room2)"),
        ("put all zonks into the green room", "unsure", ""),
        ("take all chairs", "unsure", ""),
    ];
    check(&model, &three_rooms(), &cases);
}

#[test]
fn all_things_that_are_in_one_place_are_taken_to_another() {
    let home = Home {
        rooms: vec!["red", "blue", "green"],
        blocks: vec![("green", "bag", 0), ("blue", "chair", 1), ("red", "chair", 1)],
        robot: 1,
    };
    let (_folder, model) = taught(120, &ENGLISH);
    let both = "blockInRoom(block1,room0) then blockInRoom(block2,room0)";
    let cases = [
        ("take everything in the blue room to the red room", "sure", both),
        ("take the chairs from the blue room to the red room", "sure", both),
        ("take all things in the red room to the green room", "sure", "blockInRoom(block0,room2)"),
        ("take all of the chairs to the red room", "sure", both),
        ("take everything from the green room to the red room", "unsure", ""),
    ];
    check(&model, &home, &cases);
    let (_folder, model) = taught(120, &GERMAN);
    check(&model, &home, &[("bring alles aus dem blauen Zimmer ins rote Zimmer", "sure", both)]);
}

#[test]
fn a_place_is_told_by_a_thing_in_it() {
    let (_folder, model) = taught(120, &ENGLISH);
    let cases = [
        ("bring the red chair where the yellow bag is", "sure", "blockInRoom(block1,room2)"),
        ("take the red chair to the room with the bag", "sure", "blockInRoom(block1,room2)"),
        ("bring the red chair next to the yellow bag", "sure", "blockInRoom(block1,room2)"),
    ];
    check(&model, &three_rooms(), &cases);
    let [asks] = &asked(&model, &three_rooms(), &["tell me where the yellow bag is".to_owned()])[..] else { panic!("one answer") };
    assert!(asks["verdict"] != "sure" && asks["verdict"] != "done", "{asks}");
}

#[test]
fn a_thing_is_told_by_the_place_where_it_is() {
    let (_folder, model) = taught(120, &ENGLISH);
    let cases = [
        ("take the chair from the red room to the green room", "sure", "blockInRoom(block1,room2)"),
        ("take the chair that is in the blue room to the green room", "sure", "blockInRoom(block2,room2)"),
        ("take the chair in the blue room into the red room", "sure", "blockInRoom(block2,room0)"),
        ("take the bag from the red room to the blue room", "none", ""),
    ];
    check(&model, &three_rooms(), &cases);
    let blocks = vec![("yellow", "bag", 1), ("red", "chair", 1)];
    let home = Home { rooms: vec!["red", "blue", "green"], blocks, robot: 0 };
    check(&model, &home, &[("take the chair from the green room to the red room", "none", "")]);
}

#[test]
fn a_thing_tells_the_place_in_words_that_no_list_has() {
    let (_folder, model) = taught(120, &ENGLISH);
    let blocks = vec![("yellow", "bag", 1), ("red", "chair", 3), ("purple", "chair", 2)];
    let home = Home { rooms: vec!["red", "blue", "green", "purple"], blocks, robot: 0 };
    let cases = [
        ("park the red chair in the same room as the bag", "sure", "blockInRoom(block1,room1)"),
        ("put the purple chair in the same room as the bag", "sure", "blockInRoom(block2,room1)"),
        ("in the same room as the bag put the red chair", "sure", "blockInRoom(block1,room1)"),
        ("go to the same room as the bag", "sure", "agentInRoom(agent0,room1)"),
    ];
    check(&model, &home, &cases);
}

#[test]
fn german_is_taken_apart_as_well() {
    let (_folder, model) = taught(120, &GERMAN);
    let cases = [
        ("geh nicht ins blaue Zimmer", "done", "!agentInRoom(agent0,room1)"),
        ("verlass das rote Zimmer", "sure", "!agentInRoom(agent0,room0)"),
        ("geh nihct ins rote Zimmer", "sure", "!agentInRoom(agent0,room0)"),
        ("bring die gelbe Tasche aus dem grünen Zimmer heraus", "sure", "!blockInRoom(block0,room2)"),
        ("geh ins blaue Zimmer und dann ins grüne Zimmer", "sure", "agentInRoom(agent0,room1) then agentInRoom(agent0,room2)"),
        ("bring alle Bänke ins grüne Zimmer", "sure", "blockInRoom(block1,room2) then blockInRoom(block2,room2)"),
        ("bring alles ins grüne Zimmer", "sure", "blockInRoom(block1,room2) then blockInRoom(block2,room2)"),
        ("die gelbe Tasche ist nicht im roten Zimmer", "unsure", ""),
    ];
    check(&model, &three_rooms(), &cases);
}

#[test]
fn asides_thanks_and_earlier_commands_are_told_apart_from_a_command() {
    let (_folder, model) = taught(120, &ENGLISH);
    let cases = [
        ("sorry to bother you, but could you go to the blue room", "sure", go(1)),
        ("leave the red room, I'm about to paint", "sure", not(&go(0))),
        ("if you could take the yellow bag to the blue room, I'd be grateful", "sure", take(0, 1)),
        ("the yellow bag can't stay in the green room", "sure", not(&take(0, 2))),
        ("after you have been to the blue room, go to the green room", "sure", then(&[go(1), go(2)])),
        ("go to the blue room, but before that take the red chair to the green room", "sure", then(&[take(1, 2), go(1)])),
        ("go to the blue room, but take the red chair to the green room first", "sure", then(&[take(1, 2), go(1)])),
        ("go to the blue room and wait there", "sure", go(1)),
        ("take the yellow bag to the blue room while I am painting", "sure", take(0, 1)),
        ("take the yellow bag to the blue room, don't drop it", "sure", take(0, 1)),
        ("the red chair looks good in the blue room", "unsure", String::new()),
        ("you don't have to go to the blue room", "unsure", String::new()),
        ("shall I go to the blue room?", "unsure", String::new()),
    ];
    check(&model, &three_rooms(), &cases.each_ref().map(|(words, verdict, task)| (*words, *verdict, task.as_str())));
}

#[test]
fn words_with_an_apostrophe_and_joined_pronouns_are_heard_apart() {
    let (_folder, model) = taught(120, &FRENCH);
    let cases = [
        ("n'apporte pas la malle jaune dans la salle bleue", "done", not(&take(0, 1))),
        ("je te prie d'apporter la malle jaune dans la salle bleue", "sure", take(0, 1)),
        ("ne va que dans la salle bleue", "unsure", String::new()),
        ("pourriez-vous, s'il vous plaît, aller dans la salle bleue ?", "sure", go(1)),
    ];
    check(&model, &three_rooms(), &cases.each_ref().map(|(words, verdict, task)| (*words, *verdict, task.as_str())));
    let (_folder, model) = taught(120, &SPANISH);
    check(&model, &three_rooms(), &[("llévame la bolsa amarilla a la sala azul", "sure", &*take(0, 1))]);
    let (_folder, model) = taught(120, &GERMAN);
    check(&model, &three_rooms(), &[("alle Bänke ins grüne Zimmer, bitte", "sure", &*then(&[take(1, 2), take(2, 2)]))]);
}

#[test]
fn long_utterances_get_an_answer_and_end_no_batch() {
    let (_folder, model) = taught(120, &ENGLISH);
    let home = three_rooms();
    let ways: Vec<String> = (0..10).map(|part| format!("go to {}", ["blue", "red"][part % 2])).collect();
    let tasks: Vec<String> = (0..10).map(|part| go([1, 0][part % 2])).collect();
    let [answer] = &asked(&model, &home, &[ways.join(" then ")])[..] else { panic!("one answer") };
    assert_eq!((answer["taken_for"].as_str(), answer["task"].as_str()), (Some("several commands"), Some(&*then(&tasks))), "{answer}");
    // The first 64 words of each part are read, and the next sentence is answered as usual.
    let parts = ["go to the blue room"; 50].join(" and then ");
    let [answer] = &asked(&model, &home, &[parts])[..] else { panic!("one answer") };
    assert_eq!(answer["task"], then(&vec![go(1); 50]), "nothing of a long utterance is lost");
    let long = ["again ".repeat(1_000), "and ".repeat(1_000), format!("please {}", "go ".repeat(99))];
    let sentences: Vec<String> = long.iter().flat_map(|long| [long.clone(), "go to the blue room".to_owned()]).collect();
    for pair in asked(&model, &home, &sentences).chunks(2) {
        assert!(pair[0]["verdict"] == "unsure" || pair[0]["verdict"] == "none", "{}", pair[0]);
        assert_eq!(pair[1]["task"], go(1), "a long sentence ends no batch");
    }
    for short in
        ["again ".repeat(64), "and ".repeat(64), "not ".repeat(64), "all ".repeat(64), "go and ".repeat(32), "leave and ".repeat(32)]
    {
        let [answer] = &asked(&model, &home, &[short])[..] else { panic!("one answer") };
        assert!(answer["verdict"] == "none" || answer["verdict"] == "unsure", "{answer}");
    }
}

#[test]
fn a_thing_of_a_color_that_is_not_here_is_never_taken_for_another_of_its_kind() {
    for (wording, lessons) in [(&ENGLISH, 120), (&ENGLISH, 24), (&GERMAN, 120), (&GERMAN, 24)] {
        let (_folder, model) = taught(lessons, wording);
        let mut said = Vec::new();
        for (color, place) in
            COLORS.iter().filter(|color| **color != "green").flat_map(|color| ["red", "blue", "green"].map(|place| (color, place)))
        {
            let home = Home { rooms: vec!["red", "blue", "green"], blocks: vec![("green", "bag", 0), ("red", "chair", 1)], robot: 1 };
            for template in wording.taking {
                let words = template.replace("{c}", wording.name(color)).replace("{s}", wording.name("bag"));
                said.push(words.replace("{}", wording.name(place)));
            }
            for (words, answer) in said.iter().zip(asked(&model, &home, &said)) {
                assert!(answer["verdict"] != "sure" && answer["verdict"] != "done", "{words}: {answer}");
            }
            said.clear();
        }
    }
}

/// Checks the sentences of a conversation as [`check`] does. Each begins where the one before ends.
fn check_conversation(model: &str, home: &Home, cases: &[(&str, &str, &str)]) {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("home.json");
    let mut home = home.json();
    // A robot that only pushes can move a block that is away from the walls.
    for block in home["objects"].as_array_mut().expect("objects").iter_mut().filter(|object| object["class"] == "block") {
        (block["x"], block["y"]) = (json!(block["x"].as_i64().expect("a number") / 4 * 4 + 2), json!(3));
    }
    std::fs::write(&file, home.to_string()).expect("a file");
    let sentences: Vec<&str> = cases.iter().map(|(words, ..)| *words).collect();
    let file = file.to_str().expect("a name");
    let run = goodbot(&["ask", "--with", model, "--environment", file, "--json", "--conversation", "-"], sentences.join("\n").as_bytes());
    assert_eq!(run.code, 0, "{}", run.messages);
    let answers: Vec<Value> = run.output.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    judge(cases, &answers);
}

#[test]
fn words_of_a_conversation_stand_for_what_was_done_before() {
    let (_folder, model) = taught(120, &ENGLISH);
    let cases = [
        ("go to the blue room", "sure", "agentInRoom(agent0,room1)"),
        ("go back", "sure", "agentInRoom(agent0,room0)"),
        ("go there", "done", "agentInRoom(agent0,room0)"),
    ];
    check_conversation(&model, &Home { rooms: vec!["red", "blue", "green"], blocks: vec![("yellow", "bag", 2)], robot: 0 }, &cases);
    let cases = [
        ("take the yellow bag to the green room", "sure", "blockInRoom(block0,room2)"),
        ("bring it to the red room", "sure", "blockInRoom(block0,room0)"),
        ("put it back", "sure", "blockInRoom(block0,room2)"),
        ("go to the blue room", "sure", "agentInRoom(agent0,room1)"),
        ("bring it there", "sure", "blockInRoom(block0,room1)"),
        ("do it again", "done", "blockInRoom(block0,room1)"),
    ];
    check_conversation(&model, &Home { rooms: vec!["red", "blue", "green"], blocks: vec![("yellow", "bag", 1)], robot: 0 }, &cases);
}

#[test]
fn the_other_one_is_the_other_of_its_kind_and_goes_to_the_same_place() {
    let (_folder, model) = taught(120, &ENGLISH);
    let blocks = vec![("yellow", "bag", 3), ("red", "chair", 1), ("green", "chair", 2)];
    let home = Home { rooms: vec!["red", "blue", "green", "purple"], blocks, robot: 0 };
    let cases = [
        ("take the red chair to the red room", "sure", "blockInRoom(block1,room0)"),
        ("the other one too", "sure", "blockInRoom(block2,room0)"),
    ];
    check_conversation(&model, &home, &cases);
    let cases = [
        ("take the red chair to the red room", "sure", "blockInRoom(block1,room0)"),
        ("now the same with the bag", "sure", "blockInRoom(block0,room0)"),
    ];
    check_conversation(&model, &home, &cases);
}

#[test]
fn a_task_that_is_done_can_still_be_corrected_taken_back_and_forbidden() {
    let (_folder, model) = taught(120, &ENGLISH);
    let blocks = vec![("yellow", "bag", 1), ("red", "chair", 3)];
    let home = Home { rooms: vec!["red", "blue", "green", "purple"], blocks, robot: 0 };
    let cases = [
        ("take the yellow bag to the green room", "sure", "blockInRoom(block0,room2)"),
        ("no I said the purple room", "sure", "blockInRoom(block0,room3)"),
        ("go to the blue room", "sure", "agentInRoom(agent0,room1)"),
        ("sorry I meant the green one", "sure", "agentInRoom(agent0,room2)"),
    ];
    check_conversation(&model, &home, &cases);
    let cases = [
        ("take the yellow bag to the green room", "sure", "blockInRoom(block0,room2)"),
        ("no I said the chair", "sure", "blockInRoom(block1,room2)"),
        ("put that one back where it was", "sure", "blockInRoom(block1,room3)"),
    ];
    check_conversation(&model, &home, &cases);
}

#[test]
fn what_is_to_be_brought_here_goes_to_the_robots_room() {
    let (_folder, model) = taught(120, &ENGLISH);
    check(&model, &three_rooms(), &[("bring the bag here please", "sure", "blockInRoom(block0,room0)")]);
}

#[test]
fn words_that_point_back_are_not_followed_where_nothing_was_done_before() {
    let (_folder, model) = taught(120, &ENGLISH);
    let unsure = ["take it there", "put it back", "go back", "the other one", "do it again", "go there"];
    for (words, answer) in unsure.iter().zip(asked(&model, &three_rooms(), &unsure.map(str::to_owned))) {
        assert!(answer["verdict"] == "unsure" || answer["verdict"] == "none", "{words}: {answer}");
    }
}

#[test]
fn a_new_word_may_turn_a_command_round_where_a_robot_knows_no_closed_words() {
    let (folder, model) = taught(120, &ENGLISH);
    let empty = folder.path().join("empty.txt").to_str().expect("a name").to_owned();
    std::fs::write(&empty, "# No words.\n").expect("a file");
    let cases = [
        ("go to the blue room", "sure"),
        // Neither a slip nor a new verb in a verb's place reverses a command.
        ("go to the blue roomm", "sure"),
        ("stroll to the blue room", "sure"),
        ("never go to the blue room", "unsure"),
        ("please go to the blue room", "unsure"),
    ];
    let sentences: Vec<String> = cases.iter().map(|(words, _)| (*words).to_owned()).collect();
    let answers = asked_with(&["--closed-words", &empty], &model, &three_rooms(), &sentences);
    for ((words, verdict), answer) in cases.iter().zip(answers) {
        assert_eq!(answer["verdict"], *verdict, "{words}: {answer}");
        let taken_for = if *verdict == "sure" { "a command" } else { "perhaps the opposite of a command" };
        assert_eq!(answer["taken_for"], taken_for, "{words}");
    }
}

#[test]
fn a_table_with_few_words_that_negate_may_lack_another() {
    let (folder, model) = taught(120, &ENGLISH);
    let few = folder.path().join("few.txt").to_str().expect("a name").to_owned();
    std::fs::write(&few, "negation: not no\n").expect("a file");
    let sentences = ["don't go to the blue room", "go to the blue room"].map(str::to_owned);
    let verdicts: Vec<Value> =
        asked_with(&["--closed-words", &few], &model, &three_rooms(), &sentences).iter().map(|answer| answer["verdict"].clone()).collect();
    assert_eq!(verdicts, ["unsure", "sure"]);
}

#[test]
fn the_table_of_closed_words_can_be_printed_and_replaced() {
    let (folder, model) = taught(120, &ENGLISH);
    let printed = goodbot(&["example", "closed-words"], b"");
    assert_eq!(printed.code, 0, "{}", printed.messages);
    let file = folder.path().join("words.txt").to_str().expect("a name").to_owned();
    let sentences = ["zounds go to the blue room".to_owned()];
    let verdict = |text: &str| {
        std::fs::write(&file, text).expect("a file");
        let [answer] = &asked_with(&["--closed-words", &file], &model, &three_rooms(), &sentences)[..] else { panic!("one answer") };
        (answer["verdict"].clone(), answer["task"].clone())
    };
    assert_eq!(verdict(&printed.output), (json!("sure"), json!("agentInRoom(agent0,room1)")));
    let with_own = verdict(&format!("{}\nnegation: zounds\n", printed.output));
    assert_eq!(with_own, (json!("done"), json!("!agentInRoom(agent0,room1)")));

    std::fs::write(&file, "negation: not\ncolour: red\n").expect("a file");
    let home = folder.path().join("home.json").to_str().expect("a name").to_owned();
    std::fs::write(&home, three_rooms().json().to_string()).expect("a file");
    let wrong = goodbot(&["ask", "--with", &model, "--environment", &home, "--closed-words", &file, "go"], b"");
    assert!(wrong.code != 0 && wrong.messages.contains("line 2: \"colour\" is no class of words"), "{}", wrong.messages);
}

#[test]
fn a_pronoun_that_is_joined_to_a_verb_stands_for_the_thing_of_before() {
    let home = Home { rooms: vec!["red", "blue", "green"], blocks: vec![("yellow", "bag", 1)], robot: 0 };
    let (_folder, model) = taught(120, &FRENCH);
    let cases = [
        ("apporte la malle jaune dans la salle verte", "sure", "blockInRoom(block0,room2)"),
        ("apporte-la dans la salle rouge", "sure", "blockInRoom(block0,room0)"),
        ("apportez-la dans la salle bleue, s'il vous plaît", "sure", "blockInRoom(block0,room1)"),
    ];
    check_conversation(&model, &home, &cases);
    let (_folder, model) = taught(120, &SPANISH);
    let cases = [
        ("lleva la bolsa amarilla a la sala verde", "sure", "blockInRoom(block0,room2)"),
        ("tráela a la sala roja", "sure", "blockInRoom(block0,room0)"),
        ("ve a la sala verde y luego llévala a la sala azul", "sure", "agentInRoom(agent0,room2) then blockInRoom(block0,room1)"),
    ];
    check_conversation(&model, &home, &cases);
    // These have no verb before the pronoun.
    let said = ["sala".to_owned(), "vela a la sala verde".to_owned()];
    assert!(asked(&model, &home, &said).iter().all(|answer| answer["task"] != "blockInRoom(block0,room2)"));
}

#[test]
fn a_new_verb_with_a_new_preposition_and_a_wish_are_followed() {
    let (_folder, model) = taught(120, &ENGLISH);
    let cases = [
        ("stroll towards the blue room", "sure", "agentInRoom(agent0,room1)"),
        ("i want the yellow bag in the blue room", "sure", "blockInRoom(block0,room1)"),
    ];
    check(&model, &three_rooms(), &cases);
    for answer in asked(&model, &three_rooms(), &["i want a yellow bag", "i want a new blue car"].map(str::to_owned)) {
        assert!(answer["verdict"] == "unsure" || answer["verdict"] == "none", "{answer}");
    }
}
