//! The core against reference numbers computed in double precision by an independent implementation.

use goodbot::feedback::Feedback;
use goodbot::home::{self, Moves};
use goodbot::language::{LanguageModel, Settings};
use goodbot::memory::AgentMemory;
use goodbot::oomdp::{Domain, action_named};
use goodbot::session::{Evidence, Weights};
use goodbot::symbols::Symbol;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_tests::fixture::{home, read, task_text};
use goodbot_tests::plan_sums::PlanSums;
use goodbot_tests::reachable::reachable;
use serde_json::Value;

const TOLERANCE: f64 = 1e-4;

fn assert_close(what: &str, ours: f32, reference: f64) {
    assert!((f64::from(ours) - reference).abs() <= TOLERANCE, "{what}: {ours} here, {reference} in the reference");
}

fn symbols(model: &mut LanguageModel<impl AgentMemory>, command: &str) -> Vec<Symbol> {
    command.split(' ').map(|token| model.lend().tokens_mut().intern(token).unwrap()).collect()
}

#[test]
fn weighted_model_2_gives_the_reference_tables() {
    let reference = read("ibm2.json");
    for fit in reference["fits"].as_array().unwrap() {
        let settings = Settings {
            smoothing: fit["smoothing"].as_f64().unwrap() as f32,
            rounds: fit["iterations"].as_u64().unwrap() as u32,
            length: fit["length"] == "freq",
            ..Settings::PAPER
        };
        let mut memory = HeapMemory::new(&Capacities::STANDARD);
        let mut model = LanguageModel::new(&mut memory.agent, settings).unwrap();
        for row in reference["data"].as_array().unwrap() {
            let command = symbols(&mut model, row[0].as_str().unwrap());
            let sentence = model.lend().hear(row[1].as_str().unwrap()).unwrap();
            model.lend().add_session(&sentence, std::iter::once((&command[..], row[2].as_f64().unwrap() as f32))).unwrap();
        }
        model.lend().begin_training();
        while model.lend().train(7) == goodbot::planning::Progress::Working {}
        for (token, row) in fit["t"].as_object().unwrap() {
            let token = (token != reference["null"].as_str().unwrap()).then(|| model.read().tokens().find(token).unwrap());
            for (word, t) in fit["words"].as_array().unwrap().iter().zip(row.as_array().unwrap()) {
                let word = model.read().words().find(word.as_str().unwrap()).unwrap();
                assert_close("t", model.read().tables().translation(word, token), t.as_f64().unwrap());
            }
        }
        for (lengths, rows) in fit["a"].as_object().unwrap() {
            let (l, n) = lengths.split_once(',').unwrap();
            let (l, n): (usize, usize) = (l.parse().unwrap(), n.parse().unwrap());
            for (i, row) in rows.as_array().unwrap().iter().enumerate() {
                for (j, a) in row.as_array().unwrap().iter().enumerate() {
                    assert_close("a", model.read().tables().alignment(j, i, l, n), a.as_f64().unwrap());
                }
            }
        }
        for query in fit["queries"].as_array().unwrap() {
            let command = symbols(&mut model, query[0].as_str().unwrap());
            let sentence = model.lend().hear(query[1].as_str().unwrap()).unwrap();
            // For a length never seen with a known l, the reference's length factor is 1, the definition's 0.
            if settings.length && query[1] == "go there" {
                continue;
            }
            let ours = model.read().likelihood(&sentence, &command).value();
            let reference = query[2].as_f64().unwrap();
            assert!((f64::from(ours) - reference).abs() <= 1e-3 * reference.max(1e-30), "{ours} here, {reference} in the reference");
        }
    }
}

#[test]
fn plans_from_every_state_are_the_reference_plans() {
    let reference = read("plans.json");
    for case in reference.as_array().unwrap() {
        let mut memory = HeapMemory::new(&Capacities::STANDARD);
        let (home, start) = home(&case["world"], &mut memory.home, Moves::PushAndPull);
        let lifted = home::paper_tasks().unwrap();
        let mut agent = Agent::new(&mut memory.agent, &lifted, Options::PAPER).unwrap();
        agent.hear(&home, &start, case["command"].as_str().unwrap()).unwrap();
        let states = reachable(&home, &start);
        assert_eq!(states.len() as u64, case["reachable"].as_u64().unwrap());
        // The largest home has too many states to start from each: only its start is compared.
        let every = states.len() < 10_000;
        let mut sums = vec![PlanSums::default(); agent.tasks().len()];
        let mut from_start = vec![0; agent.tasks().len()];
        for state in states.values().filter(|&&state| every || state == start) {
            // A dead end lasts for the session, so each state needs a session of its own.
            agent.hear_again(&home, &start).unwrap();
            agent.plan_fully(&home, state).unwrap();
            for (task, sums) in sums.iter_mut().enumerate() {
                let Some(distance) = agent.planned().distance(task).map(u64::from) else { continue };
                if *state == start {
                    from_start[task] = distance;
                }
                let moves = if distance > 0 { agent.planned().optimal(task).exact().unwrap().len() } else { 0 };
                sums.add(distance, moves as u64);
            }
        }
        let tasks = case["tasks"].as_object().unwrap();
        assert_eq!(agent.tasks().len(), tasks.len());
        for ((task, sums), from_start) in agent.tasks().iter().zip(&sums).zip(from_start) {
            let name = task_text(&home, &lifted, task);
            assert_eq!(from_start, tasks[&name]["start"].as_u64().unwrap(), "{name}");
            if every {
                sums.assert_are(&name, &tasks[&name]);
            }
        }
    }
}

fn assert_probabilities(what: &str, ours: &[(String, f32)], reference: &Value) {
    let reference = reference.as_object().unwrap();
    assert_eq!(ours.len(), reference.len(), "{what}: {ours:?}");
    for (name, probability) in ours {
        assert_close(&format!("{what}: {name}"), *probability, reference[name].as_f64().unwrap());
    }
}

fn posterior<D: Domain>(agent: &Agent<impl AgentMemory>, domain: &D) -> Vec<(String, f32)> {
    let name = |task| task_text(domain, agent.lifted(), task);
    agent.tasks().iter().enumerate().map(|(position, task)| (name(task), agent.belief().probability(position))).collect()
}

fn follow_curriculum(case: &Value, weights: Weights) {
    let lifted = home::paper_tasks().unwrap();
    let mut home_memories: Vec<HeapMemory> = (0..32).map(|_| HeapMemory::new(&Capacities::STANDARD)).collect();
    let mut homes = home_memories.iter_mut();
    let mut memory = HeapMemory::new(&Capacities::STANDARD);
    let mut agent = Agent::new(&mut memory.agent, &lifted, Options { weights, ..Options::PAPER }).unwrap();
    for (lesson, session) in case["train"].as_array().unwrap().iter().enumerate() {
        let (home, start) = home(&session["world"], &mut homes.next().unwrap().home, Moves::Push);
        agent.hear(&home, &start, session["command"].as_str().unwrap()).unwrap();
        assert_probabilities(&format!("lesson {lesson} prior"), &posterior(&agent, &home), &session["prior"]);
        let mut state = start;
        for step in session["walk"].as_array().unwrap() {
            let action = action_named(&home, step[0].as_str().unwrap()).unwrap();
            let feedback = match step[1].as_i64().unwrap() {
                1 => Feedback::Reward,
                -1 => Feedback::Punish,
                _ => Feedback::Neutral,
            };
            agent.plan_fully(&home, &state).unwrap();
            state = agent.acted(&home, &state, action).unwrap();
            assert_eq!(agent.feedback(feedback), Ok(Evidence::Used));
        }
        assert_probabilities(&format!("lesson {lesson} posterior"), &posterior(&agent, &home), &session["posterior"]);
        agent.weigh(&home).unwrap();
        let candidates = agent.candidates();
        let whole = goodbot::probability::total(candidates.entries().iter().map(|entry| entry.weight));
        let machine: Vec<(String, f32)> = candidates
            .entries()
            .iter()
            .map(|entry| {
                let tokens: Vec<&str> = candidates.tokens(entry).iter().map(|&token| agent.language().tokens().text(token)).collect();
                (tokens.join(" "), entry.weight.over(whole))
            })
            .collect();
        assert_probabilities(&format!("lesson {lesson} machine commands"), &machine, &session["machine"]);
        let _ = agent.finish(&home).unwrap();
        agent.learn_fully();
    }
    for test in case["tests"].as_array().unwrap() {
        let (home, start) = home(&test["world"], &mut homes.next().unwrap().home, Moves::Push);
        agent.hear(&home, &start, test["command"].as_str().unwrap()).unwrap();
        assert_probabilities(test["command"].as_str().unwrap(), &posterior(&agent, &home), &test["posterior"]);
    }
    for probe in case["probes"].as_array().unwrap() {
        let language = agent.language();
        let token = language.tokens().find(probe[0].as_str().unwrap()).unwrap();
        let word = language.words().find(probe[1].as_str().unwrap()).unwrap();
        assert_close(probe[0].as_str().unwrap(), language.tables().translation(word, Some(token)), probe[2].as_f64().unwrap());
    }
}

#[test]
fn the_papers_course_gives_the_reference_beliefs_with_the_papers_weights() {
    let reference = read("curriculum.json");
    follow_curriculum(&reference["attributes, paper weights"], Weights::Paper);
}

#[test]
fn the_papers_course_gives_the_reference_beliefs_with_belief_weights() {
    let reference = read("curriculum.json");
    follow_curriculum(&reference["attributes, original weights"], Weights::Belief);
}
