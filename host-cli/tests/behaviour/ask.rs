//! `goodbot ask`: the answers, their certainty, and the reasons.

use crate::program;

use program::{Run, THREE_STOREYS, goodbot};
use serde_json::Value;
use std::path::{Path, PathBuf};

fn example(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/examples").join(name);
    path.to_str().expect("a name").to_owned()
}

struct Asked {
    folder: tempfile::TempDir,
}

impl Asked {
    fn new() -> Self {
        let it = Self { folder: tempfile::tempdir().expect("a folder") };
        assert_eq!(goodbot(&["learn", &example("sessions.jsonl"), "--out", it.model().to_str().unwrap()], b"").code, 0);
        it
    }

    fn model(&self) -> PathBuf {
        self.folder.path().join("words.goodbot")
    }

    fn ask(&self, arguments: &[&str], input: &str) -> Run {
        goodbot(&[&["ask", "--with", self.model().to_str().unwrap()], arguments].concat(), input.as_bytes())
    }

    fn home(&self, command: &str) -> (Value, String) {
        let words: Vec<&str> = command.split(' ').collect();
        let home = example("home.json");
        let json = self.ask(&[&["--environment", &home, "--json"], &words[..]].concat(), "");
        assert_eq!(json.code, 0, "{}", json.messages);
        let text = self.ask(&[&["--environment", &home], &words[..]].concat(), "").output;
        (serde_json::from_str(&json.output).expect("a line of JSON"), text)
    }
}

#[test]
fn what_is_done_already_is_said_with_its_probability() {
    // The robot is in the red room.
    let (answer, text) = Asked::new().home("go to the red room");
    let first = &answer["meanings"][0];
    assert_eq!((&first["task"], &first["done"]), (&"agentInRoom(agent0,room0)".into(), &true.into()));
    assert!(first["probability"].as_f64().unwrap() > 0.5, "{answer}");
    assert_eq!(answer["verdict"], "done");
    assert!(text.contains("answer: already done here: go to the red room"), "{text}");
    let sum: f64 = answer["tasks"].as_object().unwrap().values().map(|it| it.as_f64().unwrap()).sum();
    assert!((sum - 1.0).abs() < 1e-4);
}

#[test]
fn a_word_never_heard_makes_the_answer_less_sure_and_is_named() {
    let asked = Asked::new();
    let sure = |command: &str| asked.home(command).0["meanings"][0]["probability"].as_f64().unwrap();
    assert!(sure("take the yellow bag to the blue zzz") < sure("take the yellow bag to the blue"));
    let (_, text) = asked.home("fetch the yellow bag");
    assert!(text.contains("never heard: \"fetch\""), "{text}");
}

#[test]
fn a_word_that_is_taken_for_another_is_told_as_new() {
    let asked = Asked::new();
    let (answer, text) = asked.home("take the yellowish bag to the blue room");
    assert!(text.contains("\n\"yellowish\" is new, and taken for \"yellow\"\n") && !text.contains("never heard"), "{text}");
    assert_eq!((&answer["words"][2]["taken_for"], answer["words"][3].get("taken_for")), (&"yellow".into(), None));
    let (_, text) = asked.home("take the yellow bag to the blue room");
    assert!(!text.contains("is new"), "{text}");
}

#[test]
fn a_synonym_that_was_learned_is_heard_for_a_word_that_was_not() {
    let asked = Asked::new();
    let table = asked.folder.path().join("words.txt");
    std::fs::write(&table, goodbot(&["example", "synonyms"], b"").output).unwrap();
    let (home, table) = (example("home.json"), table.to_str().unwrap());
    let with_table = ["--environment", &home, "--synonyms", table, "fetch", "the", "yellow", "bag", "to", "the", "azure", "room"];
    let text = asked.ask(&with_table, "").output;
    assert!(text.contains("heard as \"take the yellow bag to the blue room\"") && !text.contains("never heard"), "{text}");
    let answer: Value = serde_json::from_str(&asked.ask(&[&with_table[..], &["--json"]].concat(), "").output).unwrap();
    let (plain, _) = asked.home("take the yellow bag to the blue room");
    assert_eq!((&answer["meanings"], &answer["heard"]), (&plain["meanings"], &"take the yellow bag to the blue room".into()));
    assert!(plain.get("heard").is_none());
}

#[test]
fn a_table_of_synonyms_at_fault_is_refused_with_its_line() {
    let asked = Asked::new();
    let home = example("home.json");
    let refused = |text: &[u8]| {
        let table = asked.folder.path().join("words.txt");
        std::fs::write(&table, text).unwrap();
        let run = asked.ask(&["--environment", &home, "--synonyms", table.to_str().unwrap(), "go"], "");
        assert_eq!(run.code, 2, "{}", run.messages);
        run.messages
    };
    assert!(refused(b"red crimson\nruby red\n").contains("\"red\" is in line 1 and in line 2: leave it in one of them"));
    assert!(refused(b"red: crimson\n").contains("line 1: \"red:\" is not heard as one word"));
    assert!(refused(b"red \xff\n").contains("is not UTF-8"));
    assert!(asked.ask(&["--environment", &home, "--synonyms", "nowhere.txt", "go"], "").messages.contains("nowhere.txt: cannot be read"));
}

#[test]
fn where_it_is_not_sure_the_answer_names_the_best_two() {
    let asked = Asked::new();
    let (answer, text) = asked.home("go");
    assert_eq!(answer["verdict"], "unsure");
    let line = text.lines().find(|line| line.starts_with("answer: unsure: ")).expect("an answer");
    assert!(line.contains(", or "), "{line}");
}

#[test]
fn words_after_ask_need_no_quotes() {
    let asked = Asked::new();
    let home = example("home.json");
    let with = asked.ask(&["-e", &home, "--json", "take the yellow bag to the blue room"], "").output;
    let without = asked.ask(&["-e", &home, "--json", "take", "the", "yellow", "bag", "to", "the", "blue", "room"], "").output;
    assert_eq!(with, without);
}

#[test]
fn several_commands_come_from_standard_input_each_on_its_line() {
    let run = Asked::new().ask(&["--environment", &example("home.json"), "--json", "-"], "go to the blue room\n\ntake the bag away\n");
    let commands: Vec<Value> = run.output.lines().map(|line| serde_json::from_str::<Value>(line).unwrap()["command"].clone()).collect();
    assert_eq!(commands, ["go to the blue room", "take the bag away"]);
}

#[test]
fn the_home_is_drawn_and_colours_stand_beside_letters() {
    let asked = Asked::new();
    let home = example("home.json");
    let plain = asked.ask(&["-e", &home, "go"], "").output;
    assert!(plain.contains("#r@rr#bbbb#") && !plain.contains('\u{1b}'), "{plain}");
    let coloured = asked.ask(&["--color", "always", "-e", &home, "go"], "").output;
    assert!(coloured.contains("\u{1b}[34mb\u{1b}[0m"), "{coloured}");
    assert!(asked.ask(&["-e", &home, "--json", "--color", "always", "go"], "").output.starts_with('{'));
}

#[test]
fn it_says_why_word_by_word() {
    let asked = Asked::new();
    let home = example("home.json");
    let why = asked.ask(&["-e", &home, "--why", "take the yellow bag to the blue room"], "").output;
    let blue = why.lines().find(|line| line.trim_start().starts_with("blue ")).expect("a line for blue");
    assert!(blue.contains("goal of blockInRoom colorBlue"), "{why}");
}

#[test]
fn the_columns_of_why_stand_below_each_other() {
    let asked = Asked::new();
    let why = asked.ask(&["-e", &example("home.json"), "--why", "take the yellow bag to the blue room"], "").output;
    let table: Vec<&str> = why.lines().skip_while(|line| !line.starts_with("word ")).collect();
    let ends: Vec<usize> = table.iter().skip(1).map(|line| line.len()).collect();
    assert!(table.len() == 9 && ends.iter().all(|end| *end == ends[0]), "{why}");
}

#[test]
fn a_plan_says_what_it_is_for_where_that_is_not_the_answer() {
    let asked = Asked::new();
    let home = example("home.json");
    let here = asked.ask(&["-e", &home, "go to the red room if it rains"], "").output;
    assert!(here.contains("answer: unsure: go to the red room"), "{here}");
    assert!(here.contains("plan to go to the blue room, which is still to do: north"), "{here}");
    assert!(asked.ask(&["-e", &home, "go to the blue room"], "").output.contains("\nplan: north"));
}

#[test]
fn a_home_may_be_drawn_as_text() {
    let asked = Asked::new();
    let drawing = goodbot(&["example", "map"], b"").output;
    let run = asked.ask(&["-e", "-", "go", "to", "the", "green", "room"], &drawing);
    assert_eq!(run.code, 0, "{}", run.messages);
    for line in drawing.lines().take(9) {
        assert!(run.output.contains(line), "{line} in {}", run.output);
    }
}

#[test]
fn a_file_of_the_wrong_kind_is_named_by_its_kind() {
    let asked = Asked::new();
    let (home, log, model) = (example("home.json"), example("sessions.jsonl"), asked.model());
    let model = model.to_str().unwrap();
    for (arguments, message) in [
        (&["evaluate", home.as_str()][..], "this is a home, not a session log"),
        (&["replay", home.as_str()], "this is a home, not a session log"),
        (&["evaluate", model], "this is a model, not a session log"),
        (&["ask", "--with", model, "-e", log.as_str(), "go"], "this is a session log, not a home"),
        (&["ask", "--with", home.as_str(), "-e", home.as_str(), "go"], "this is a home, not a model"),
        (&["inspect", log.as_str()], "this is a session log, not a model"),
        (&["merge", log.as_str(), model, "--out", "-"], "this is a session log, not a model"),
    ] {
        let run = goodbot(arguments, b"");
        assert_eq!(run.code, 2, "{arguments:?}");
        assert!(run.messages.contains(message), "{arguments:?}: {}", run.messages);
    }
}

#[test]
fn errors_are_in_plain_words_and_near_misses_are_suggested() {
    for (arguments, message) in [
        (&["train"][..], "did you mean goodbot learn, or goodbot teach?"),
        (&["teech"], "there is no command \"teech\"; did you mean goodbot teach?"),
        (&["home.json"], "there is no command \"home.json\"; goodbot --help names all"),
        (&["learn", "log.jsonl", "--model", "paper"], "choose the learner with --learner"),
        (&["inspect", "--model", "words.goodbot"], "take the model's file without an option"),
        (&["--quiet", "learn", "log.jsonl"], "options go after the command: goodbot learn --quiet"),
        (&["--seed", "3", "teach"], "goodbot teach --seed <S>"),
        (&["example"], "closed-words"),
        (&["evaluate", "log.jsonl", "--task", "agentinroom(?a,?r)"], "known are agentInRoom, blockInRoom"),
        (&["completions"], "zsh"),
        (&["test"], "did you mean goodbot evaluate?"),
        (&["evalute"], "evaluate"),
        (&["paper", "--rusn", "3"], "--runs"),
        (&["paper", "--runs", "x"], "give a whole number from 1 to 100000"),
        (&["paper", "--runs", "0"], "give a whole number from 1 to 100000"),
        (&["paper", "--seed", "-1"], "give a whole number from 0 to"),
    ] {
        let run = goodbot(arguments, b"");
        assert_eq!(run.code, 2, "{arguments:?}");
        assert!(run.messages.contains(message), "{arguments:?}: {}", run.messages);
        assert!(!run.messages.contains("invalid digit"), "{}", run.messages);
    }
    let asked = Asked::new();
    let long = asked.ask(&["-e", &example("home.json"), &"go ".repeat(65)], "");
    assert!(long.code == 0 && long.output.contains("the words after the first 64 were not read: say it in parts"), "{}", long.output);
}

#[test]
fn examples_are_sound() {
    for what in ["home", "map", "log"] {
        let text = goodbot(&["example", what], b"").output;
        assert_eq!(goodbot(&["check", "-"], text.as_bytes()).code, 0, "{what}");
    }
}

#[test]
fn quiet_leaves_remarks_out_and_failures_in() {
    let log = goodbot(&["example", "log"], b"").output;
    let twice = log.clone() + &log;
    assert!(goodbot(&["evaluate", "-"], twice.as_bytes()).messages.contains("copies"));
    assert_eq!(goodbot(&["evaluate", "-", "--quiet"], twice.as_bytes()).messages, "");
    assert!(!goodbot(&["--quiet", "inspect", "nothing"], b"").messages.is_empty());
}

#[test]
fn a_way_that_was_taught_is_answered_in_words_and_planned_for() {
    let folder = tempfile::tempdir().unwrap();
    let (home, model) = (folder.path().join("home.json"), folder.path().join("ways.goodbot"));
    std::fs::write(&home, THREE_STOREYS).unwrap();
    let session = |(number, command, way): (usize, String, String)| {
        format!(
            r#"{{"type":"session","version":1,"id":"w{number}","kind":"labelled","environment":{THREE_STOREYS},"command":"{command}","intended":["agentInRoom(agent0,room0)"]{way}}}
{{"type":"end","learn":true}}
"#
        )
    };
    let colors = ["blue", "red", "yellow"].into_iter().enumerate();
    let taught = colors.flat_map(|(room, color)| {
        let room = format!("agentInRoom(agent0,room{})", room + 1);
        [
            (format!("go to the green room via the {color} room"), format!(r#","through":[["{room}"]]"#)),
            (format!("go to the green room but avoid the {color} room"), format!(r#","avoiding":["{room}"]"#)),
        ]
    });
    let twice: Vec<(String, String)> = taught.clone().chain(taught).collect();
    let log: String = twice.into_iter().enumerate().map(|(number, (command, way))| session((number, command, way))).collect();
    let (home, model) = (home.to_str().unwrap(), model.to_str().unwrap());
    let learned = goodbot(&["learn", "-", "--routes", "--out", model], log.as_bytes());
    assert_eq!(learned.code, 0, "{}", learned.messages);
    let asked = goodbot(&["ask", "--with", model, "--routes", "-e", home, "go to the green room but avoid the red room"], b"");
    assert!(asked.output.contains("go to the green room, but not through the red room"), "{}{}", asked.output, asked.messages);
}

#[test]
fn a_command_that_is_refused_keeps_no_other_from_being_asked() {
    let asked = Asked::new();
    let long = "x".repeat(60);
    let commands = format!("go to the red room\n{long}\ngo to the blue room\n");
    let run = asked.ask(&["--environment", &example("home.json"), "--json", "-"], &commands);
    let types: Vec<Value> = run.output.lines().map(|line| serde_json::from_str::<Value>(line).expect("JSON")["type"].clone()).collect();
    assert_eq!((run.code, types), (2, vec!["answer".into(), "error".into(), "answer".into()]));
    assert!(run.messages.contains(&format!("{long:?}: ")) && run.messages.contains("1 of 3 commands were refused"), "{}", run.messages);
}
