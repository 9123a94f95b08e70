//! goodbot compared with others on the same work, in one run: ratios of medians of nine.
//!
//! The environment variable `GOODBOT_PEERS_PYTHON` names a Python that has NLTK; without it that comparison is left out.

use std::io::Write;
use std::ops::Range;
use std::process::{Command, ExitCode, Stdio};
use std::time::Duration;

use goodbot::language::Settings;
use goodbot::{Capacities, HeapMemory};
use goodbot_benches::dijkstra::{HOMES, one_a_star_a_task, one_dijkstra_a_task};
use goodbot_benches::homes::{Scene, Tasks, size};
use goodbot_benches::language::{model, sessions, train};
use goodbot_benches::timing::{ROUNDS, in_turn, median, ratio, time};
use goodbot_benches::works;
use serde_json::{Value, json};

fn main() -> ExitCode {
    let comparisons: [fn() -> Result<(), String>; 5] =
        [|| against_dijkstra(0..9), || against_dijkstra(100..109), many_tasks, the_course, against_nltk];
    for comparison in comparisons {
        if let Err(problem) = comparison() {
            eprintln!("error: {problem}");
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

/// Prints a ratio and checks it against its bounds. A bound reveals a fault, which changes a ratio many times over. Because the load of a
/// machine changes ratios too, `least` is at most about half of the lowest ratio ever measured, and `most` at least a third above the
/// highest.
fn show(what: &str, times: (Duration, Duration), least: Option<f64>, most: Option<f64>) -> Result<(), String> {
    let ratio = ratio(times);
    println!("{what}: {ratio:.2} ({:.3} ms against {:.3} ms)", times.0.as_secs_f64() * 1e3, times.1.as_secs_f64() * 1e3);
    if least.is_some_and(|least| ratio < least) || most.is_some_and(|most| ratio > most) {
        return Err(format!("{what} is {ratio:.2}, which is not within {least:?} to {most:?}"));
    }
    Ok(())
}

/// All tasks by one search, against one search per task by the crate pathfinding, from the start of each random home; and all states by one
/// sweep, against the peer's time from the start times the number of states.
fn against_dijkstra(seeds: Range<u64>) -> Result<(), String> {
    let (mut theirs, mut by_a_star, mut own, mut own_sweeps, mut theirs_everywhere) = [Duration::ZERO; 5].into();
    let (mut tasks, mut dead, mut expansions) = (0, 0, 0);
    for seed in seeds.clone() {
        let mut scene = Scene::seeded(seed, HOMES, Tasks::Paper);
        let count = scene.tasks.len();
        let plan = scene.plan();
        expansions += plan.expansions();
        let ours: Vec<Option<u32>> = (0..count).map(|task| plan.distance(task)).collect();
        for peer in [one_dijkstra_a_task(&scene), one_a_star_a_task(&scene)] {
            if ours != peer {
                return Err(format!("the distances are not equal: {ours:?} here, {peer:?} there"));
            }
        }
        tasks += ours.len();
        dead += ours.iter().filter(|distance| distance.is_none()).count();
        let (mut slow, mut guided, mut fast) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..ROUNDS {
            fast.push(time(|| scene.plan().expansions()));
            slow.push(time(|| one_dijkstra_a_task(&scene)));
            guided.push(time(|| one_a_star_a_task(&scene)));
        }
        own += median(fast);
        by_a_star += median(guided);
        let slow = median(slow);
        theirs += slow;
        own_sweeps += median((0..3).map(|_| time(|| scene.sweep())).collect());
        theirs_everywhere += slow * u32::try_from(scene.sweep().states()).unwrap_or(u32::MAX);
    }
    println!(
        "the random homes of seeds {seeds:?}, three rooms, two blocks: {tasks} tasks, {dead} of them dead ends, equal distances, {expansions} expansions"
    );
    show("one pathfinding::dijkstra a task / one search for all", (theirs, own), Some(10.0), None)?;
    show("one pathfinding::astar a task, its heuristic without walls / one search for all", (by_a_star, own), Some(5.0), None)?;
    show("the same for every state, the peer's time from one / one sweep", (theirs_everywhere, own_sweeps), Some(20.0), None)
}

/// 64 tasks against eight tasks, in one state space.
fn many_tasks() -> Result<(), String> {
    let mut many = Scene::roomy(size(12, 1), Tasks::Count(64));
    let mut few = Scene::roomy(size(12, 1), Tasks::Count(8));
    let times = in_turn(|| many.plan().expansions(), || few.plan().expansions());
    println!("{} expansions, {} and {} tasks", many.plan().expansions(), many.tasks.len(), few.tasks.len());
    show("64 tasks / 8 tasks", times, None, Some(1.5))
}

/// The whole course: planning, inference and learning.
fn the_course() -> Result<(), String> {
    let course = median((0..ROUNDS).map(|_| time(works::course)).collect());
    show("50 ms / the course of seven lessons and five tests", (Duration::from_millis(50), course), Some(1.0), None)
}

/// Ten rounds of Model 2 against NLTK's. The tables must be equal.
fn against_nltk() -> Result<(), String> {
    let Some(python) = std::env::var_os("GOODBOT_PEERS_PYTHON") else {
        println!("skipped: no Python with NLTK is named; `cargo xtask compare` installs one");
        return Ok(());
    };
    let data = sessions(64);
    let pairs: Vec<Value> = data.iter().flat_map(|(english, machine)| machine.iter().map(move |tokens| json!([tokens, english]))).collect();
    let request = json!({ "pairs": pairs, "rounds": 10, "times": ROUNDS }).to_string();
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/peers/model2.py");
    let mut child = Command::new(&python)
        .arg(script)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .map_err(|error| format!("{} could not be started: {error}", python.display()))?;
    if let Some(mut input) = child.stdin.take() {
        input.write_all(request.as_bytes()).map_err(|error| error.to_string())?;
    }
    let output = child.wait_with_output().map_err(|error| error.to_string())?;
    let reply: Value = serde_json::from_slice(&output.stdout).map_err(|error| format!("model2.py gave no tables: {error}"))?;

    let memory = HeapMemory::new(&Capacities::STANDARD);
    let settings = Settings { smoothing: 0.0, ..Settings::PAPER };
    let mut model = model(memory.agent, &data, settings, 1.0);
    let times: Vec<Duration> = (0..ROUNDS).map(|_| time(|| train(&mut model))).collect();
    let rows = |table: &str| reply[table].as_array().cloned().unwrap_or_default();
    let (mut cells, mut largest) = (0, 0.0_f64);
    let mut compare = |ours: f32, theirs: &Value| {
        cells += 1;
        largest = largest.max((f64::from(ours) - theirs.as_f64().unwrap_or(f64::NAN)).abs());
    };
    for row in rows("t") {
        let token = row[0].as_str().and_then(|token| model.read().tokens().find(token));
        let Some(word) = row[1].as_str().and_then(|word| model.read().words().find(word)) else { continue };
        compare(model.read().tables().translation(word, token), &row[2]);
    }
    for row in rows("a") {
        let at = |column: usize| row[column].as_u64().and_then(|number| usize::try_from(number).ok()).unwrap_or(usize::MAX);
        compare(model.read().tables().alignment(at(0), at(1), at(2), at(3)), &row[4]);
    }
    println!("{} pairs of 64 sessions, {cells} cells of t and a, largest difference {largest:.1e}", pairs.len());
    if cells == 0 || largest > 1e-3 {
        return Err("the tables are not equal".into());
    }
    let seconds = reply["seconds"].as_array().cloned().unwrap_or_default();
    let theirs = seconds.iter().filter_map(Value::as_f64).map(Duration::from_secs_f64).collect();
    show("NLTK's IBMModel2 / weighted EM", (median(theirs), median(times)), Some(100.0), None)
}
