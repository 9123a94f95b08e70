//! The starter of the command line, in the page and on a board.

use crate::program::goodbot;
use goodbot::home::{Moves, paper_tasks};
use goodbot::memory::AgentHeap;
use goodbot::snapshot::{Contents, Places};
use goodbot::{Agent, Capacities, Options};
use goodbot_lesson::home;
use goodbot_lesson::name::task_name;
use goodbot_wasm::World;
use tempfile::TempDir;

/// Runs a command that writes a file, in this folder. Returns the file and the command's remarks.
fn written(folder: &TempDir, name: &str, arguments: &[&str]) -> (Vec<u8>, String) {
    let out = folder.path().join(name);
    let run = goodbot(&[arguments, &["--out", out.to_str().unwrap()]].concat(), b"");
    assert_eq!(run.code, 0, "{}", run.messages);
    (std::fs::read(out).unwrap(), run.messages)
}

const LOG: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/examples/sessions.jsonl");

#[test]
fn the_page_learns_the_same_model_from_a_starter() {
    let folder = TempDir::new().unwrap();
    let learned = |options: &[&str]| written(&folder, "a.goodbot", &[&["learn", LOG, "--learner", "roles"], options].concat()).0;
    let own = learned(&[]);
    for language in ["de", "en", "es", "fr", "zh"] {
        let [mut page, mut host] = [1, 2].map(|seed| World::new(seed).unwrap());
        page.restore(&own).unwrap();
        page.set_starter(language);
        host.restore(&learned(&["--starter", language])).unwrap();
        let [page, host] = [&mut page, &mut host].map(|world| {
            while !world.learn(u32::MAX) {}
            (world.agent().saved().unwrap(), world.heat())
        });
        assert!(page.0.len() > own.len() + 2_000 && page == host, "{language}");
    }
}

#[test]
fn a_board_that_only_obeys_understands_everyday_sentences() {
    let folder = TempDir::new().unwrap();
    let (model, _) = written(&folder, "a.goodbot", &["learn", LOG, "--starter", "en"]);
    let file = folder.path().join("a.goodbot");
    let (parameters, told) = written(&folder, "a.parameters", &["parameters", file.to_str().unwrap()]);
    assert!(
        told.contains("10752 bytes; they need words 69, tokens 22, translations 1587, alignments 1084"),
        "docs/robot.md says so: {told}"
    );
    let capacities = Capacities::SMALL.at_least(Contents::read(&model).unwrap().needs()).obeying();
    let mut agent = Agent::new(AgentHeap::new(&capacities), &paper_tasks().unwrap(), Options::DEFAULT).unwrap();
    agent.restore_parameters(&parameters).unwrap();
    let drawn = home::parse("home", include_str!("../../../docs/examples/home.json")).unwrap();
    let (home, start) = home::build(&drawn, Moves::Push, home::memory()).unwrap();
    agent.hear(&home, &start, "please carry the bag to the blue room").unwrap();
    let task = agent.most_likely().unwrap();
    assert!(agent.belief().probability(task) > 0.8);
    let task = agent.tasks()[task];
    assert_eq!(task_name(&home, &agent.lifted()[usize::from(task.lifted)], &task).unwrap().to_string(), "blockInRoom(block0,room1)");
}

#[test]
fn a_robot_that_joins_a_starters_model_learns_what_the_command_line_does() {
    let folder = TempDir::new().unwrap();
    let learned = |arguments: &[&str]| written(&folder, "a.goodbot", &[&["learn"], arguments].concat()).0;
    let (own, starter, both) = (learned(&[LOG]), learned(&["--starter", "en"]), learned(&[LOG, "--starter", "en"]));
    let capacities = Capacities { states: 64, hashed_states: 0, ..Capacities::STANDARD };
    let robot = |model: &[u8]| {
        let mut agent = Agent::new(AgentHeap::new(&capacities), &paper_tasks().unwrap(), Options::DEFAULT).unwrap();
        agent.restore(model).unwrap();
        agent
    };
    let mut joined = robot(&own);
    let sessions = joined.language().bitext().sessions();
    let added = joined.join_beside(&starter, sessions).unwrap();
    assert!(added > 0 && added < Contents::read(&starter).unwrap().sessions.len(), "{added}");
    assert_eq!(joined.saved().unwrap(), robot(&both).saved().unwrap());
    Places::last(&joined, added).leave(&mut joined);
    assert_eq!(joined.language().bitext().sessions(), sessions);
}
