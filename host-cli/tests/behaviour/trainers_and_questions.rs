//! Expected trainers, and answers to questions: `fit-trainers`, `replay --believes`, logs with answers.

use crate::program;

use goodbot_formats::posterior::PosteriorLine;
use program::{AGENT, END, goodbot, log, session, step};
use serde_json::Value;

const BLOCK: &str = r#"{"class":"block","name":"block0","x":4,"y":2,"color":"yellow","shape":"bag"}"#;
const TO_GREEN: &str = "agentInRoom(agent0,room1)";

fn answer(yes: bool) -> String {
    format!(r#"{{"type":"answer","tasks":["{TO_GREEN}"],"yes":{yes},"eta":0.1}}"#)
}

fn to_green(line: &str) -> f64 {
    let belief = PosteriorLine::parse(line, 1).expect("a belief");
    belief.tasks.iter().find(|(name, _)| name.to_string() == TO_GREEN).expect("the task").1
}

#[test]
fn an_answer_in_a_log_is_believed_where_it_stands() {
    let home = session(&format!("{AGENT},{BLOCK}"), "feedback", "go", "");
    let run = goodbot(&["replay", "--json", "-"], &log([&home, &answer(true), &step("noop", "neutral"), &answer(false), END]));
    assert_eq!(run.code, 0, "{}", run.messages);
    let lines: Vec<&str> = run.output.lines().collect();
    assert_eq!(to_green(lines[0]), 0.5);
    // Evidence for it and against it, with the same odds.
    assert!((to_green(lines[1]) - 0.5).abs() < 1e-6, "{}", lines[1]);
    let once = goodbot(&["replay", "--json", "-"], &log([&home, &answer(true), &step("noop", "neutral"), END]));
    assert!((to_green(once.output.lines().nth(1).unwrap()) - 0.9).abs() < 1e-6);
}

#[test]
fn an_answer_that_cannot_be_is_refused_with_its_line_and_what_to_do() {
    let home = session(&format!("{AGENT},{BLOCK}"), "feedback", "go", "");
    let shown = session(&format!("{AGENT},{BLOCK}"), "demonstration", "go", "");
    let good = answer(true);
    let of = |change: (&str, &str)| good.replace(change.0, change.1);
    for (lines, message) in [
        (vec![home.clone(), of(("room1", "room7")), END.to_owned()], ":2: field \"tasks\": \"agentInRoom(agent0,room7)\" is no task here"),
        (vec![home.clone(), of(("0.1", "0.5")), END.to_owned()], ":2: field \"eta\": must be less than 0.5"),
        (vec![home.clone(), END.to_owned(), good.clone()], ":3: an answer is outside any session"),
        (vec![shown, good.clone(), END.to_owned()], ":2: an answer belongs in a session of feedback alone"),
        (vec![home, of(("0.1}", "0.1,\"others\":0}")), END.to_owned()], ":2: field \"others\": 0 is no number of other answers"),
    ] {
        let lines: Vec<&str> = lines.iter().map(String::as_str).collect();
        let run = goodbot(&["check", "-"], (lines.join("\n") + "\n").as_bytes());
        assert_eq!(run.code, 2, "{}", run.output);
        assert!(run.output.contains(message) || run.messages.contains(message), "{message}: {} {}", run.output, run.messages);
    }
}

#[test]
fn expected_strategies_take_the_place_of_recorded_ones_and_the_last_line_sums_up() {
    let strategies = r#","intended":["agentInRoom(agent0,room1)"],"strategies":[{"name":"kind","mu_plus":0.1,"mu_minus":0.9,"epsilon":0.1,"prior":1,"lags":[0.5,0.5,0]}]"#;
    let lines = log([&session(&format!("{AGENT},{BLOCK}"), "feedback", "go", strategies), &step("north", "reward"), END]);
    for (believes, strategies) in [("logged", 1), ("paper", 1), ("0.9,0.9,0.2", 1), ("population", 10)] {
        let run = goodbot(&["replay", "--json", "--believes", believes, "-"], &lines);
        assert_eq!(run.code, 0, "{}", run.messages);
        let summary: Value = serde_json::from_str(run.output.lines().last().unwrap()).unwrap();
        assert_eq!((&summary["type"], &summary["episodes_with_feedback"]), (&"summary".into(), &1.into()));
        assert!(summary["mean_log_loss"].as_f64().unwrap() > 0.0);
        let belief = PosteriorLine::parse(run.output.lines().next().unwrap(), 1).unwrap();
        assert_eq!(belief.strategies.len(), strategies, "{believes}");
    }
    let refused = goodbot(&["replay", "--believes", "0.7,0.7", "-"], &lines);
    assert_eq!(refused.code, 2);
    assert!(refused.messages.contains("2 numbers where 3, 6 or 10 are needed"), "{}", refused.messages);
}

#[test]
fn a_fit_needs_three_trainers_and_gives_shares_that_sum_to_one() {
    let of = |id: &str| {
        let home = session(&format!("{AGENT},{BLOCK}"), "feedback", "go", &format!(r#","intended":["{TO_GREEN}"]"#));
        [home.replace(r#""id":"s""#, &format!(r#""id":"{id}.1-0""#)), step("north", "reward"), step("south", "punish"), END.to_owned()]
    };
    let log = |ids: &[&str]| ids.iter().flat_map(|id| of(id)).collect::<Vec<_>>().join("\n") + "\n";
    let few = goodbot(&["fit-trainers", "-"], log(&["a", "b"]).as_bytes());
    assert_eq!(few.code, 2);
    assert!(few.messages.contains("2 trainers with feedback whose intended task is known: give the sessions of 3"), "{}", few.messages);
    let run = goodbot(&["fit-trainers", "--json", "-"], log(&["a", "b", "c"]).as_bytes());
    assert_eq!(run.code, 0, "{}", run.messages);
    let lines: Vec<Value> = run.output.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let shares: f64 = lines.iter().filter_map(|line| line["prior"].as_f64()).sum();
    assert!((shares - 1.0).abs() < 0.01, "{shares}");
    let fit = lines.last().unwrap();
    assert_eq!(fit["trainers"], 3);
    // Trainers who are alike leave no doubt, whichever are drawn; but what so few sessions mean is luck.
    for row in fit["leaving_each_trainer_out"].as_array().unwrap() {
        for figure in ["mean_log_loss", "calibration_error"] {
            let [least, most, found] = [&row["intervals"][figure][0], &row["intervals"][figure][1], &row["held_out"][figure]];
            let [least, most, found] = [least, most, found].map(|number| number.as_f64().unwrap());
            assert!((least - found).abs() < 1e-6 && (most - found).abs() < 1e-6, "{row}");
        }
        let chance = &row["calibration_error_of_chance"]["mean"];
        assert!(chance.as_f64().is_some_and(|mean| 0.0 < mean && mean < 0.5), "{row}");
    }
}

#[test]
fn learn_expects_of_trainers_what_it_is_told_and_else_the_papers_one() {
    let lines = log([&session(&format!("{AGENT},{BLOCK}"), "feedback", "go to the green room", ""), &step("north", "reward"), END]);
    let model = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("believes.goodbot");
    let learned = |believes: &[&str]| {
        let run = goodbot(&[&["learn", "-", "--out", model.to_str().unwrap()], believes].concat(), &lines);
        assert_eq!(run.code, 0, "{}", run.messages);
        std::fs::read(&model).unwrap()
    };
    let unsaid = learned(&[]);
    assert_eq!(learned(&["--believes", "paper"]), unsaid);
    assert_ne!(learned(&["--believes", "population"]), unsaid);
}

#[test]
fn teach_expects_the_trainer_that_it_is_told_to_expect() {
    let taught =
        |believes: &str| goodbot(&["teach", "--lines", "--believes", believes], b"command go to the red room\nstep\ngood\nfinish\n");
    for believes in ["paper", "population", "0.1,0.1,0.02"] {
        let run = taught(believes);
        assert_eq!(run.code, 0, "{believes}: {}", run.messages);
    }
    let refused = taught("logged");
    assert_eq!(refused.code, 2);
    assert!(refused.messages.contains("there is no log to take strategies from"), "{}", refused.messages);
}
