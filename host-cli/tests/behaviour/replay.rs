//! `goodbot replay`.

use crate::program;

use goodbot_formats::posterior::PosteriorLine;
use program::{AGENT, END, Run, goodbot, log, session, shown, step};

fn beliefs(run: &Run) -> Vec<PosteriorLine> {
    assert_eq!(run.code, 0, "{}", run.messages);
    run.output.lines().zip(1..).map(|(line, number)| PosteriorLine::parse(line, number).expect("a belief")).collect()
}

fn replay(input: &[u8]) -> Vec<PosteriorLine> {
    beliefs(&goodbot(&["replay", "--json", "-"], input))
}

fn probability(belief: &PosteriorLine, task: &str) -> f64 {
    belief.tasks.iter().find(|(name, _)| name.to_string() == task).expect("the task").1
}

const TO_GREEN: &str = "agentInRoom(agent0,room1)";
const BLOCK: &str = r#"{"class":"block","name":"block0","x":4,"y":2,"color":"yellow","shape":"bag"}"#;
const TAKE: &str = "blockInRoom(block0,room1)";

#[test]
fn the_prior_comes_first_and_then_a_belief_for_each_step() {
    let home = format!("{AGENT},{BLOCK}");
    let all = replay(&log([&session(&home, "feedback", "go there", ""), &step("north", "reward"), &step("noop", "neutral"), END]));
    assert_eq!(all.iter().map(|belief| belief.step).collect::<Vec<_>>(), [0, 1, 2]);
    assert_eq!(probability(&all[0], TO_GREEN), 0.5);
    assert!(probability(&all[1], TO_GREEN) > 0.8);
    assert_eq!(all[0].strategies, [("balanced".to_owned(), 1.0)]);
}

#[test]
fn what_is_learned_from_one_session_is_believed_in_the_next() {
    let home = format!("{AGENT},{BLOCK}");
    let walk = session(&home, "feedback", "walk over there", "");
    let bring = session(&home, "feedback", "bring the bag", "");
    let (north, east) = (step("north", "reward"), step("east", "reward"));
    let heard_again = |learn: &str| {
        let end = format!(r#"{{"type":"end","learn":{learn}}}"#);
        let all = replay(&log([&walk, &north, &north, &end, &bring, &east, &east, &end, &walk, &end]));
        probability(all.last().expect("a belief"), TO_GREEN)
    };
    assert!(heard_again("true") > 0.6);
    assert_eq!(heard_again("false"), 0.5);
}

#[test]
fn an_unknown_word_is_heard_as_a_known_synonym() {
    let folder = tempfile::tempdir().expect("a folder");
    let table = folder.path().join("words.txt");
    std::fs::write(&table, "green emerald\n").expect("a file");
    let home = format!("{AGENT},{BLOCK}");
    let walks = |word: &str| {
        let [first, then] = ["green", word].map(|word| session(&home, "feedback", &format!("walk to the {word} one"), ""));
        log([&first, &step("north", "reward"), &step("north", "reward"), END, &then, END])
    };
    let arguments = ["replay", "--json", "-", "--synonyms", table.to_str().expect("a name")];
    let believed = |word: &str, arguments: &[&str]| goodbot(arguments, &walks(word)).output;
    assert_eq!(believed("emerald", &arguments), believed("green", &arguments));
    assert_ne!(believed("emerald", &arguments[..3]), believed("green", &arguments[..3]));
    std::fs::write(&table, "green Emerald\n").expect("a file");
    let run = goodbot(&arguments, &walks("green"));
    assert!(run.code == 2 && run.messages.contains("\"Emerald\" is not heard as one word"), "{}", run.messages);
}

#[test]
fn a_recorded_prior_and_recorded_strategies_are_believed() {
    let more = format!(
        r#","prior":{{"{TO_GREEN}":0.25,"{TAKE}":0.75}},"strategies":[{{"name":"kind","mu_plus":0.1,"mu_minus":0.9,"epsilon":0.1,"prior":0.6}},{{"name":"stern","mu_plus":0.9,"mu_minus":0.1,"epsilon":0.1,"prior":0.4}}]"#
    );
    let all = replay(&log([&session(&format!("{AGENT},{BLOCK}"), "feedback", "go", &more), &step("north", "reward"), END]));
    assert_eq!((probability(&all[0], TO_GREEN), probability(&all[0], TAKE)), (0.25, 0.75));
    assert!((all[0].strategies[0].1 - 0.6).abs() < 1e-6);
    assert!(all[1].strategies[0].1 > 0.9, "who rewards is kind: {:?}", all[1].strategies);
}

#[test]
fn the_same_command_once_more_goes_on_with_the_belief() {
    let home = format!("{AGENT},{BLOCK}");
    let again = session(&home, "feedback", "go", r#","continues":true"#);
    let all = replay(&log([&session(&home, "feedback", "go", ""), &step("north", "reward"), END, &again, END]));
    assert_eq!(all[1].tasks, all[2].tasks);
    let alone = goodbot(&["replay", "-"], &log([&again, END]));
    assert_eq!(alone.code, 2);
    assert!(alone.messages.contains(r#"standard input:1: field "continues": there is no session before"#), "{}", alone.messages);
}

#[test]
fn a_session_not_learned_from_can_be_continued_and_then_learned_from() {
    let home = format!("{AGENT},{BLOCK}");
    let lines = [&session(&home, "feedback", "go", ""), r#"{"type":"end","learn":false}"#];
    let again = session(&home, "feedback", "go", r#","continues":true"#);
    let all = replay(&log([lines[0], &step("north", "reward"), lines[1], &again, &step("north", "reward"), END]));
    assert_eq!(all.len(), 4);
    assert!(probability(&all[3], TO_GREEN) > probability(&all[1], TO_GREEN));
}

#[test]
fn several_files_are_one_history_of_more_than_five_hundred_sessions() {
    let one = String::from_utf8(log([&session(AGENT, "feedback", "go", ""), END])).unwrap();
    let path = std::env::temp_dir().join(format!("goodbot-replay-{}.jsonl", std::process::id()));
    std::fs::write(&path, one.repeat(300)).unwrap();
    let file = path.to_str().unwrap();
    let all = beliefs(&goodbot(&["replay", "--json", file, file], b""));
    std::fs::remove_file(&path).unwrap();
    assert_eq!(all.len(), 600);
}

/// In a long history, words are not trained again after every session, and a message says so.
#[test]
fn from_the_hundredth_session_on_words_are_learned_anew_when_a_fiftieth_more_have_come() {
    let home = format!("{AGENT},{BLOCK}");
    let said = |command: &str| log([&session(&home, "feedback", command, ""), &step("north", "reward"), END]);
    let long = [said("go there").repeat(100), said("walk there"), said("walk there"), said("walk there")].concat();
    let with = |arguments: &[&str]| goodbot(&[&["replay"], arguments, &["-"]].concat(), &long);
    let summary = with(&[]);
    assert!(summary.output.contains("103, 103 learned from\nwords learned anew   101 times"), "{}", summary.output);
    let exact = with(&["--every-session"]);
    assert!(exact.output.contains("103, 103 learned from\nsteps"), "{}", exact.output);
    assert!(with(&["--json"]).messages.contains("see --every-session"));
    assert_eq!(with(&["--json", "--quiet"]).messages, "");
    let sure = |arguments: &[&str]| {
        let all = beliefs(&with(arguments));
        let before = |session: usize| probability(&all[2 * session], TO_GREEN);
        (before(99), before(102))
    };
    let (later, at_once) = (sure(&["--json"]), sure(&["--json", "--every-session"]));
    assert_eq!(later.0, at_once.0);
    assert!(later.1 != at_once.1 && later.1 > 0.5, "{later:?} {at_once:?}");
}

#[test]
fn a_demonstration_is_evidence_for_what_it_leads_to() {
    let home = format!("{AGENT},{BLOCK}");
    let all = replay(&log([&session(&home, "demonstration", "go", ""), &shown("north"), &shown("north"), END]));
    assert!(probability(&all[2], TO_GREEN) > 0.9);
}

#[test]
fn a_task_of_another_kind_can_be_asked_for() {
    let kind = "agentInRoom(?a,?r1) & blockInRoom(?o,?r2)";
    let log = log([&session(&format!("{AGENT},{BLOCK}"), "feedback", "go", ""), END]);
    let beside = beliefs(&goodbot(&["replay", "--json", "--task", kind, "-"], &log));
    assert_eq!(beside[0].tasks.len(), 4, "beside the paper's two kinds");
    let all = beliefs(&goodbot(&["replay", "--json", "--task", kind, "--only-these-tasks", "-"], &log));
    let names: Vec<String> = all[0].tasks.iter().map(|(name, _)| name.to_string()).collect();
    assert_eq!(names, ["agentInRoom(agent0,room0) & blockInRoom(block0,room1)", "agentInRoom(agent0,room1) & blockInRoom(block0,room0)"]);
}

#[test]
fn sessions_at_fault_are_passed_over_if_asked_for() {
    let good = session(AGENT, "feedback", "go", "");
    let bad = session(AGENT, "feedback", "go", r#","intended":["agentInRoom(agent0,room9)"]"#);
    let input = log([&bad, END, &good, END]);
    let stopped = goodbot(&["replay", "--json", "-"], &input);
    assert_eq!((stopped.code, stopped.output.as_str()), (2, ""));
    assert!(stopped.messages.contains(r#"standard input:1: field "intended[0]": there is no object "room9""#), "{}", stopped.messages);
    let went_on = goodbot(&["replay", "--keep-going", "-"], &input);
    assert_eq!(went_on.code, 0);
    assert!(went_on.output.contains("skipped              1 with faults"), "{}", went_on.output);
}

#[test]
fn a_log_without_a_session_is_refused_in_words() {
    let run = goodbot(&["replay", "-"], b"");
    assert_eq!(run.code, 2);
    assert!(run.messages.contains("the files have no session"), "{}", run.messages);
}

#[test]
fn the_summary_tells_what_was_believed_before_and_after() {
    let home = format!("{AGENT},{BLOCK}");
    let more = format!(r#","intended":["{TO_GREEN}"]"#);
    let run = goodbot(&["replay", "-"], &log([&session(&home, "feedback", "go there", &more), &step("north", "reward"), END]));
    assert!(run.output.contains("(one of 2 equally likely)"), "{}", run.output);
    assert!(run.output.contains("expected  agentInRoom(agent0,room1)  (right)"), "{}", run.output);
    assert!(run.output.contains("right at the end     1 of 1"), "{}", run.output);
}
