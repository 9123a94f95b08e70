//! `goodbot teach` without a terminal: requests as lines, answers as lines of JSON.

use crate::program;

use program::{Run, THREE_STOREYS, goodbot};
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::process::{Command, Stdio};
use tempfile::TempDir;

/// The answers, without the line that ends each.
fn answers(run: &Run) -> Vec<Value> {
    let read = |line| serde_json::from_str(line).unwrap_or_else(|error| panic!("{error}: {line}"));
    run.output.lines().map(read).filter(|line: &Value| line["type"] != "done").collect()
}

fn teach(arguments: &[&str], requests: &str) -> (Run, Vec<Value>) {
    let run = goodbot(&[&["teach"], arguments].concat(), requests.as_bytes());
    let answers = answers(&run);
    (run, answers)
}

fn types(answers: &[Value]) -> Vec<&str> {
    answers.iter().map(|answer| answer["type"].as_str().unwrap()).collect()
}

fn probability(answer: &Value, task: &str) -> f64 {
    answer["tasks"].as_array().unwrap().iter().find(|each| each["task"] == task).unwrap()["probability"].as_f64().unwrap()
}

#[test]
fn a_session_is_heard_walked_judged_and_learned_from() {
    let (run, answers) = teach(&[], "command go to the red room\nstep\ngood\nstep\nsilence\nfinish\nwords\nquit\nstep\n");
    assert_eq!((run.code, run.messages.as_str()), (0, ""));
    assert_eq!(types(&answers), ["ready", "heard", "acted", "judged", "acted", "judged", "finished", "words", "bye"]);
    assert_eq!(answers[0]["protocol"], 2);
    assert_eq!(answers[3]["feedback"], "reward");
    assert_eq!(answers[6], json!({"type": "finished", "learned": true, "steps": 2, "sessions": 1, "gave_way": 0}));
    assert!(answers[7]["ideas"].as_array().unwrap().iter().any(|idea| idea["words"] == "color red"));
}

/// The likeliest task of a command, and its probability.
fn understood(answers: &[Value]) -> (String, f64) {
    let heard = answers.iter().find(|answer| answer["type"] == "heard").unwrap_or_else(|| panic!("{answers:?}"));
    let best = &heard["tasks"][0];
    (best["task"].as_str().unwrap().to_owned(), best["probability"].as_f64().unwrap())
}

#[test]
fn a_robot_with_a_starter_understands_everyday_sentences_before_its_first_lesson() {
    let request = "command please bring the chair to the green room\n";
    let (_, alone) = teach(&[], request);
    let (_, half_taught) = teach(&["--starter", "en"], request);
    assert_eq!(half_taught[0]["sessions"], 0, "the sentences are no sessions of its own");
    let (task, probability) = understood(&half_taught);
    assert!(task.starts_with("blockInRoom(") && probability > 0.5, "{task} {probability}");
    assert!(understood(&alone).1 < 0.2);
}

#[test]
fn a_starter_is_not_saved_with_the_robot_and_comes_again_where_it_is_asked_for() {
    let folder = TempDir::new().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (alone, half_taught, home) = (file("alone.goodbot"), file("half.goodbot"), file("home.json"));
    let lesson = "command go to the red room\nstep\ngood\nfinish\n";
    let sessions = |options: &[&str]| {
        let (run, answers) = teach(options, lesson);
        assert_eq!(run.code, 0, "{}", run.messages);
        std::fs::write(&home, answers[0]["home"].to_string()).unwrap();
        answers.iter().find(|answer| answer["type"] == "finished").unwrap()["sessions"].clone()
    };
    assert_eq!((sessions(&["--model", &alone]), sessions(&["--model", &half_taught, "--starter", "en"])), (json!(1), json!(1)));
    let inspected = |model: &str| goodbot(&["inspect", model, "--sessions"], b"").output;
    assert_eq!(inspected(&half_taught).lines().count(), inspected(&alone).lines().count());

    let ask = |options: &[&str]| {
        let command = ["ask", "--with", &half_taught, "--environment", &home, "--json"];
        let run = goodbot(&[&command, options, &["bring the chair to the green room"]].concat(), b"");
        assert_eq!(run.code, 0, "{}", run.messages);
        let answer: Value = serde_json::from_str(run.output.lines().next().unwrap()).unwrap();
        answer["tasks"].as_object().unwrap().values().map(|share| share.as_f64().unwrap()).fold(0.0, f64::max)
    };
    let (without, with) = (ask(&[]), ask(&["--starter", "en"]));
    assert!(with > 0.5 && with > without + 0.2, "{without} {with}");
}

#[test]
fn a_starter_is_refused_in_the_tour_and_for_the_papers_robot() {
    let run = goodbot(&["teach", "--tour", "--starter", "en"], b"");
    assert!(run.code == 2 && run.messages.contains("--starter"), "{}", run.messages);
    let folder = TempDir::new().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (model, log, home) = (file("a.goodbot"), file("a.jsonl"), file("home.json"));
    let (_, answers) = teach(&["--model", &model], "command go to the red room\nstep\ngood\nfinish\n");
    std::fs::write(&home, answers[0]["home"].to_string()).unwrap();
    assert_eq!(goodbot(&["learn", &log, "--learner", "paper", "--out", &model, "--force"], b"").code, 0);
    let asked = goodbot(&["ask", "--with", &model, "--environment", &home, "--starter", "en", "go to the red room"], b"");
    assert!(asked.code == 2 && asked.messages.contains("--starter is not for the paper's settings"), "{}", asked.messages);
}

#[test]
fn words_are_shown_in_full() {
    let (_, answers) = teach(&[], "command take the yellow chair\nstep\ngood\nfinish\nwords\n");
    let called = answers.iter().find(|answer| answer["type"] == "words").unwrap()["ideas"][0]["called"].as_object().unwrap().clone();
    let mut words: Vec<&str> = called.keys().map(String::as_str).collect();
    words.sort_unstable();
    assert_eq!(words, ["chair", "take", "the", "yellow"]);
}

#[test]
fn what_to_teach_next_is_one_new_word_that_is_wanted_where_it_can_be_taught() {
    let lesson = "command go to the red room\nstep\ngood\nfinish\n";
    let folder = TempDir::new().unwrap();
    let wanted = folder.path().join("wanted.txt");
    std::fs::write(&wanted, "go to the red room\n\n  take the blue chair to the yellow room\n").unwrap();
    let (_, told) = teach(&["--wanted", wanted.to_str().unwrap()], &format!("{lesson}next\n"));
    let next = told.iter().find(|answer| answer["type"] == "next").unwrap();
    assert_eq!(next["command"], "go to the blue room", "one new word at a time");
    assert_eq!((&next["word"], &next["needed"], &next["heard"]), (&json!("blue"), &json!(1), &json!(0)));
    assert_eq!(next["reason"], "\"blue\" is in 1 of the commands that it is to understand, and it has never heard that word");
    let (run, answers) = teach(&[], &format!("home {}\ncommand {}\n", next["home"], next["command"].as_str().unwrap()));
    assert_eq!(run.code, 0, "it can be taught there: {}", run.messages);
    assert!(answers[2]["tasks"].as_array().unwrap().iter().any(|task| task["words"] == next["command"]));

    // Without a file, the commands so far are wanted; a wanted command of one's own is proposed for the present home.
    let (_, told) = teach(&[], "next\ncommand zorp blik\nstep\ngood\nfinish\nnext\n");
    let next: Vec<&Value> = told.iter().filter(|answer| answer["type"] == "next").collect();
    assert_eq!(next[0]["command"], Value::Null);
    assert_eq!((&next[1]["command"], &next[1]["home"], &next[1]["heard"]), (&json!("zorp blik"), &Value::Null, &json!(1)));
    let often = format!("{}next\n", "command zorp blik\nstep\ngood\nfinish\n".repeat(6));
    let (_, told) = teach(&[], &often);
    assert_eq!(told[told.len() - 2]["reason"], "it has heard every word of these commands often");
}

#[test]
fn a_file_that_wants_nothing_is_refused() {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("wanted.txt");
    let refused = |path: &std::path::Path| goodbot(&["teach", "--wanted", path.to_str().unwrap()], b"");
    assert!(refused(&file).messages.contains("wanted.txt: cannot be read"));
    std::fs::write(&file, "\n \n").unwrap();
    let run = refused(&file);
    assert_eq!(run.code, 2);
    assert!(run.messages.contains("wanted.txt: has no command; write one on each line"), "{}", run.messages);
}

#[test]
fn the_same_seed_and_the_same_lines_give_the_same_answers() {
    let lines = "command go to the red room\nstep\ngood\nstep\nbad\nstep\nfinish\nhome random\ncommand go\nstep\nstep\n";
    let of = |seed| teach(&["--seed", seed, "--random"], lines).0.output;
    assert_eq!(of("3"), of("3"));
    assert_ne!(of("3"), of("4"));
}

#[test]
fn the_last_word_to_a_step_is_the_one_that_counts() {
    let (_, twice) = teach(&[], "command go to the red room\nstep\nstep\nstep\ngood\nbad\nstate\n");
    let (_, once) = teach(&[], "command go to the red room\nstep\nstep\nstep\nbad\nstate\n");
    assert_eq!(twice[twice.len() - 2], once[once.len() - 2]);
    let good = &twice[5];
    let (action, most) = (&good["action"], good["tasks"][0]["task"].as_str().unwrap());
    assert_eq!((good["feedback"].as_str(), &twice[6]["action"]), (Some("reward"), action));
    assert!(probability(&twice[6], most) <= probability(good, most));
}

#[test]
fn a_step_is_taken_back_with_what_was_said_to_it() {
    let (_, answers) = teach(&[], "command go to the red room\nstep\ngood\nstate\nstep\nbad\nback\nstate\nback\nback\n");
    assert_eq!(types(&answers)[6..], ["judged", "back", "state", "back", "error", "bye"]);
    assert_eq!(answers[4], answers[8]);
}

#[test]
fn what_is_no_request_is_answered_with_what_to_do_and_counted() {
    let (run, answers) = teach(&[], "go north\nstep\ngood\ngood dog\nfinish\nforget\nundo\nauto\ncommand\nhome {}\nhome x\n\n");
    assert_eq!(run.code, 2);
    assert!(run.messages.contains("11 requests refused"), "{}", run.messages);
    for answer in &answers[1..answers.len() - 1] {
        assert_eq!(answer["type"], "error");
        assert!(!answer["message"].as_str().unwrap().is_empty() && answer["do"].as_str().unwrap().contains("send"), "{answer}");
    }
}

#[test]
fn lines_that_are_no_text_or_too_long_are_refused_and_the_next_is_taken() {
    let mut input = vec![b'x'; (1 << 20) + 1];
    input.extend_from_slice(b"\n\xff\xfe\nhelp\r\n");
    let run = goodbot(&["teach"], &input);
    assert_eq!((run.code, types(&answers(&run))), (2, vec!["ready", "error", "error", "help", "bye"]));
}

#[test]
fn a_robot_is_kept_where_it_is_told_and_the_log_is_one_that_other_commands_read() {
    let folder = TempDir::new().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (model, log, home) = (file("words.goodbot"), file("words.jsonl"), file("home.json"));
    let lesson = "command go to the red room\nstep\nstep\nstep\nbad\nstep\ngood\nfinish\ncommand go to the blue room\nstep\ngood\nforget\n";
    let (run, answers) = teach(&["--model", &model], lesson);
    assert_eq!((run.code, &answers.last().unwrap()["model"]), (0, &json!(model)));
    let kept = std::fs::read(&model).unwrap();

    let (_, again) = teach(&["--model", &model], "state\n");
    assert_eq!(again[0]["sessions"], 1);
    assert_eq!(std::fs::read(&model).unwrap(), kept);

    std::fs::write(&home, answers[0]["home"].to_string()).unwrap();
    for command in [
        vec!["check", &home, &log],
        vec!["replay", &log],
        vec!["inspect", &model],
        vec!["ask", "--with", &model, "--environment", &home, "go to the red room"],
    ] {
        let run = goodbot(&command, b"");
        assert_eq!(run.code, 0, "{command:?}: {}", run.messages);
    }
    let replayed = goodbot(&["replay", &log], b"").output;
    assert!(replayed.contains("2, 1 learned from"), "{replayed}");
}

#[test]
fn the_log_of_a_taught_robot_teaches_another_the_same_whoever_was_expected() {
    let folder = TempDir::new().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let lesson = format!("command go to the red room\n{}finish\n", "step\ngood\n".repeat(8));
    for believes in ["population", "paper"] {
        let (taught, log, learned) = (file(believes), file("log"), file("learned"));
        let options = ["teach", "--lines", "--seed", "3", "--believes", believes, "--model", &taught, "--log", &log];
        assert_eq!(goodbot(&options, lesson.as_bytes()).code, 0);
        assert_eq!(goodbot(&["learn", &log, "--out", &learned], b"").code, 0);
        let compared = goodbot(&["diff", &taught, &learned], b"").output;
        assert!(compared.contains("They know the same."), "{believes}: {compared}");
        for file in [log, learned] {
            std::fs::remove_file(file).unwrap();
        }
    }
}

#[test]
fn what_a_session_taught_is_taken_back_from_both_files() {
    let folder = TempDir::new().unwrap();
    let model = folder.path().join("words.goodbot").to_str().unwrap().to_owned();
    let (_, answers) = teach(&["--model", &model], "command go to the red room\nstep\ngood\nfinish\nundo\n");
    assert_eq!(answers[answers.len() - 2], json!({"type": "undone", "sessions": 0}));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn files_of_others_are_never_written_to() {
    let folder = TempDir::new().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    std::fs::write(file("letter.txt"), "Dear robot").unwrap();
    let lesson = b"command go to the red room\nstep\ngood\nfinish\n";
    for arguments in [
        vec!["teach", "--model", &file("letter.txt")],
        vec!["teach", "--model", &file("new.goodbot"), "--log", &file("letter.txt")],
        vec!["teach", "--model", &file("letter.txt"), "--log", &file("letter.txt")],
        vec!["teach", &file("letter.txt")],
        vec!["teach", "--robot", "a/b"],
        vec!["teach", "-"],
    ] {
        let run = goodbot(&arguments, lesson);
        assert_eq!((run.code, run.output.as_str()), (2, ""), "{arguments:?}");
        assert!(run.messages.starts_with("error: "), "{}", run.messages);
    }
    assert_eq!(std::fs::read_to_string(file("letter.txt")).unwrap(), "Dear robot");
}

#[test]
fn options_without_effect_are_refused() {
    for arguments in [["teach", "--lines", "--speed", "fast"], ["inspect", "model", "--force", "--json"]] {
        assert_eq!(goodbot(&arguments, b"quit\n").code, 2, "{arguments:?}");
    }
}

#[test]
fn a_home_may_be_drawn() {
    let folder = TempDir::new().unwrap();
    let home = folder.path().join("home.txt");
    std::fs::write(&home, "#########\n#ggg#rrr#\n#g@g+rCr#\n#########\nC: blue chair\n").unwrap();
    let (run, answers) = teach(&[home.to_str().unwrap()], "command push the chair over there\n");
    assert_eq!(run.code, 0, "{}", run.messages);
    assert_eq!(answers[0]["map"][2], "#g@g+rCr#");
    assert!(answers[1]["tasks"].as_array().unwrap().iter().any(|task| task["words"] == "take the blue chair to the green room"));
}

/// The simulated trainer of `auto` judges each lesson until the robot has rested at the goal three times.
#[test]
fn the_whole_tour_is_taught_in_lines() {
    let mut lines = String::new();
    for _ in 0..7 {
        lines += "command\n";
        lines += &"step\nauto\n".repeat(60);
        lines += "finish\n";
    }
    lines += &"command\n".repeat(5);
    let (run, answers) = teach(&["--tour"], &lines);
    assert_eq!(run.code, 0, "{}", run.messages);
    let tested: Vec<&Value> = answers.iter().filter(|answer| answer["type"] == "tested").collect();
    assert_eq!(tested.len(), 5);
    let last = answers.iter().rfind(|answer| answer["type"] == "lesson").unwrap();
    let right = tested.iter().filter(|test| test["right"] == true).count();
    assert_eq!(last["lesson"], json!({"over": true, "score": format!("{right} of 5 tests understood")}));
    assert!(right >= 4, "{tested:?}");
}

#[test]
fn every_answer_ends_with_a_line_of_one_type() {
    let requests = "command go to the red room\nstep\nfly\nask\nanswer 9\nundo\nfinish\nnext\nhelp\n";
    let run = goodbot(&["teach"], requests.as_bytes());
    let done = run.output.lines().filter(|line| *line == r#"{"type":"done"}"#).count();
    assert_eq!(done, requests.lines().count());
    // The greeting is no answer, and after the last answer comes only the farewell.
    let last: Vec<&str> = run.output.lines().rev().take(2).collect();
    assert!(last[0].starts_with(r#"{"type":"bye""#) && last[1] == r#"{"type":"done"}"#, "{last:?}");
}

/// The bridge of docs/teach.md: it says good to steps that are right for its task, and bad to wrong ones.
#[test]
fn a_program_that_means_one_task_teaches_it_in_any_seed() {
    for seed in ["1", "2", "3"] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_goodbot"))
            .args(["teach", "--lines", "--seed", seed])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let (mut input, mut output) = (child.stdin.take().unwrap(), BufReader::new(child.stdout.take().unwrap()).lines());
        let mut ask = |request: &str| {
            writeln!(input, "{request}").unwrap();
            let answers: Vec<Value> = output
                .by_ref()
                .map(|line| serde_json::from_str(&line.unwrap()).unwrap())
                .take_while(|line: &Value| line["type"] != "done")
                .filter(|line| line["type"] != "ready")
                .collect();
            answers[0].clone()
        };
        let meant =
            |answer: &Value| answer["tasks"].as_array().unwrap().iter().find(|task| task["words"] == "go to the red room").unwrap().clone();
        ask("command go to the red room");
        let (mut good, mut arrived) = (0, false);
        for _ in 0..30 {
            let step = ask("step");
            let right = meant(&step)["right"].as_bool().unwrap();
            good += usize::from(right);
            let judged = ask(if right { "good" } else { "bad" });
            arrived = right && step["plan"] == "goal" && judged["tasks"][0] == meant(&judged);
            if arrived {
                break;
            }
        }
        assert!(arrived && good > 2, "seed {seed}: {good} good");
        drop(input);
        child.wait().unwrap();
    }
}

/// If nobody reads the answers any more, that is no fault.
#[test]
fn it_ends_quietly_when_nobody_reads() {
    let (code, messages) = program::goodbot_unheard(&["teach"], b"help\nstate\n");
    assert_eq!((code, messages.as_str()), (0, ""));
}

#[test]
fn what_was_learned_from_a_log_and_what_was_taught_have_the_same_settings() {
    let folder = TempDir::new().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (taught, learned, both) = (path("taught.goodbot"), path("learned.goodbot"), path("both.goodbot"));
    assert_eq!(goodbot(&["teach", "--model", &taught], b"command go to the red room\nstep\ngood\nfinish\n").code, 0);
    let log = goodbot(&["example", "log"], b"").output;
    assert_eq!(goodbot(&["learn", "-", "--out", &learned], log.as_bytes()).code, 0);
    let merged = goodbot(&["merge", &learned, &taught, "--out", &both], b"");
    assert!(merged.code == 0 && !merged.messages.contains("other settings"), "{}", merged.messages);
}

#[test]
fn with_routes_a_command_may_mean_a_way() {
    let folder = TempDir::new().unwrap();
    let home = folder.path().join("home.json");
    std::fs::write(&home, THREE_STOREYS).unwrap();
    let home = home.to_str().unwrap();
    let heard = |arguments: &[&str]| {
        let (run, answers) = teach(arguments, "command go to the green room but not through the yellow one\nstep\ngood\n");
        assert_eq!((run.code, types(&answers)), (0, vec!["ready", "heard", "acted", "judged", "bye"]), "{}", run.messages);
        answers[1]["tasks"].as_array().unwrap().clone()
    };
    let tasks = heard(&["--routes", home]);
    let way = tasks.iter().find(|task| task["words"] == "go to the green room, but not through the yellow room").unwrap();
    assert_eq!(way["task"], "agentInRoom(agent0,room0) avoiding agentInRoom(agent0,room3)");
    assert!(tasks.iter().any(|task| task["words"] == "go to the green room, through the blue room or the red room"));
    assert!(heard(&[home]).iter().all(|task| !task["words"].as_str().unwrap().contains("through")));
}

#[test]
fn a_stray_word_in_a_lesson_keeps_the_lesson_and_the_robot_asks() {
    // Before its first lesson is over, a robot knows no word for what to do.
    for stray in ["goood", "hmm", "keep going", "that's right", "go to the blue room"] {
        let lesson = format!("command go to the red room\nstep\ngood\nsay {stray}\nstep\ngood\nfinish\n");
        let (run, answers) = teach(&[], &lesson);
        assert_eq!(run.code, 0, "{stray}: {}", run.output);
        assert_eq!(types(&answers), ["ready", "heard", "acted", "judged", "said", "acted", "judged", "finished", "bye"], "{stray}");
        let asks = answers[4]["asks"].as_str().expect("a question");
        assert!(asks.contains("\"go to the red room\" unlearned") && asks.contains(stray), "{asks}");
        assert_eq!(answers[7], json!({"type": "finished", "learned": true, "steps": 2, "sessions": 1, "gave_way": 0}), "{stray}");
    }
}

#[test]
fn the_same_words_once_more_begin_another_command_and_without_a_step_at_once() {
    let (_, answers) = teach(&[], "say go to the red room\nsay go to the blue room\nstep\nsay hmm\nsay hmm\nstate\n");
    assert_eq!(types(&answers), ["ready", "heard", "heard", "acted", "heard", "heard", "state", "bye"], "an unjudged step is no loss");
    let twice = "say go to the red room\nstep\ngood\nsay come to the blue room\nsay come to the blue room\n";
    let (_, answers) = teach(&[], twice);
    assert_eq!(types(&answers), ["ready", "heard", "acted", "judged", "said", "heard", "bye"]);
    // Other words or a judgement in between, or a step, and it asks again.
    let (_, answers) = teach(&[], "say go to the red room\nstep\ngood\nsay hmm\nsay dunno\nsay hmm\nbad\nsay hmm\nstep\nsay hmm\n");
    let asked_each_time = ["ready", "heard", "acted", "judged", "said", "said", "said", "judged", "said", "acted", "said", "bye"];
    assert_eq!(types(&answers), asked_each_time);
}

#[test]
fn a_session_without_a_step_teaches_nothing_and_says_so() {
    let folder = TempDir::new().unwrap();
    let model = folder.path().join("m.goodbot");
    let (run, answers) = teach(&["--model", model.to_str().unwrap()], "command go to the red room\nfinish\ncommand go\nstep\nfinish\n");
    assert_eq!(run.code, 0, "{}", run.output);
    let nothing = json!({"type": "finished", "learned": false, "steps": 0, "sessions": 0, "gave_way": 0});
    assert_eq!((&answers[2], &answers[5]), (&nothing, &nothing), "a step without a word is left out");
    assert!(!model.exists());
}
