//! Calls in any order, with any words and homes: nothing panics, and all returned numbers are probabilities.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)]

use goodbot::feedback::{Feedback, Strategy};
use goodbot::home::{Area, Cell, Home, HomeBuilder, HomeState, Moves};
use goodbot::language::Settings;
use goodbot::memory::AgentMemory;
use goodbot::memory::HomeMemory;
use goodbot::oomdp::{Action, Domain};
use goodbot::random::below;
use goodbot::session::Weights;
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg32;

const TINY: Capacities = Capacities { states: 40, words: 6, tokens: 9, sessions: 3, pairs: 20, goal_entries: 30, ..Capacities::SMALL };
const HASHING: Capacities = Capacities {
    states: 300,
    hashed_states: 200,
    word_bytes: 20,
    candidates: 300,
    candidate_tokens: 4_000,
    tasks: 40,
    beliefs: 120,
    ground_propositions: 40,
    cells: 200,
    objects: 32,
    ..Capacities::SMALL
};

fn pick<'a, T>(random: &mut Pcg32, of: &'a [T]) -> &'a T {
    &of[below(of.len(), random)]
}

fn coordinate(random: &mut Pcg32) -> i32 {
    match below(40, random) {
        0 => i32::MIN,
        1 => i32::MAX,
        _ => below(14, random) as i32 - 2,
    }
}

/// A random home: often sound, often with invalid objects.
fn any_home<M: HomeMemory>(memory: M, random: &mut Pcg32) -> Option<(Home<M>, HomeState)> {
    let colours = ["red", "green", "", "tan", "ßeta", "a-colour-with-a-very-long-name-that-is-no-colour-at-all"];
    let mut builder = HomeBuilder::new(memory);
    let width = 2 + below(4, random) as i32;
    for room in 0..1 + below(3, random) as i32 {
        let colour = colours[below(if below(20, random) == 0 { 6 } else { 4 }, random)];
        let _ = builder.room(&format!("room{room}"), Area::new(room * width, 0, (room + 1) * width, 2 + below(4, random) as i32), colour);
        let _ = builder.door(&format!("door{room}"), Area::new(room * width, 1, room * width, 1));
    }
    if below(4, random) == 0 {
        let area = Area::new(coordinate(random), coordinate(random), coordinate(random), coordinate(random));
        let _ = builder.room("odd", area, "blue");
        let _ = builder.door("oddDoor", area);
    }
    for (block, colour) in colours.iter().enumerate().take(below(4, random)) {
        let _ = builder.block(&format!("block{block}"), Cell::new(coordinate(random), coordinate(random)), colour, "star");
    }
    let _ = builder.agent("agent0", Cell::new(1 + below(width as usize, random) as i32, 1));
    builder.build(*pick(random, &[Moves::Push, Moves::PushAndPull])).ok()
}

fn any_command(random: &mut Pcg32) -> String {
    let words = ["go", "to", "the", "red", "green", "room", "take", "STAR", ".", "", "\u{0}", "İ", "🙂", "ﬁ", "\t", "room,", "a1", "über"];
    let count = if below(30, random) == 0 { 80 } else { below(8, random) };
    (0..count).map(|_| *pick(random, &words)).collect::<Vec<_>>().join(" ")
}

fn is_share(value: f32) -> bool {
    (0.0..=1.0).contains(&value)
}

fn check(agent: &Agent<impl AgentMemory>, seed: u64) {
    let belief = agent.belief();
    let sum: f32 = (0..belief.tasks()).map(|task| belief.probability(task)).inspect(|&p| assert!(is_share(p), "seed {seed}: {p}")).sum();
    assert!(belief.tasks() == 0 || (sum - 1.0).abs() < 1e-3, "seed {seed}: the tasks' probabilities add up to {sum}");
    let strategies = belief.strategies().len();
    let sum: f32 = (0..strategies).map(|s| belief.strategy_probability(s)).inspect(|&p| assert!(is_share(p), "seed {seed}: {p}")).sum();
    assert!((sum - 1.0).abs() < 1e-3, "seed {seed}: the strategies' probabilities add up to {sum}");
    let language = agent.language();
    if language.is_training() {
        return;
    }
    for token in std::iter::once(None).chain(language.tokens().iter().map(|(token, _)| Some(token))) {
        let row = language.words().iter().map(|(word, _)| language.tables().translation(word, token));
        let sum: f32 = row.inspect(|&t| assert!(is_share(t), "seed {seed}: t = {t}")).sum();
        assert!(sum < 1.001, "seed {seed}: the words' probabilities add up to {sum}");
    }
    for entry in agent.candidates().entries() {
        let value = entry.likelihood.value();
        assert!(is_share(value) || value < 1.0001, "seed {seed}: Pr(e|m) = {value}");
    }
}

fn act(agent: &mut Agent<impl AgentMemory>, homes: &[(Home<impl HomeMemory>, HomeState)], at: &mut (usize, HomeState), random: &mut Pcg32) {
    let (home, start) = (&homes[at.0].0, homes[at.0].1);
    let action = Action::new(*pick(random, &[0, 1, 2, 3, 4, 5, 15, 16, 255]));
    match below(22, random) {
        0 | 1 => {
            *at = {
                let home = below(homes.len(), random);
                (home, homes[home].1)
            };
            let _ = agent.hear(&homes[at.0].0, &at.1, &any_command(random));
        }
        2 => {
            let values = [0.0, 0.3, 1.0, f32::NAN, -1.0, f32::INFINITY, f32::MIN_POSITIVE];
            let value = *pick(random, &values);
            let _ =
                agent.hear_with_prior(home, &at.1, &any_command(random), |task, _| if task.bindings[1].index() == 0 { 0.5 } else { value });
        }
        3 => {
            at.1 = start;
            let _ = agent.hear_again(home, &at.1);
        }
        4..=6 => drop(agent.plan(home, &at.1, random.next_u32() % 50)),
        7..=9 => {
            let _ = agent.plan_fully(home, &at.1);
            if let Ok(decision) = agent.decide_with(home, &at.1, random) {
                at.1 = agent.acted(home, &at.1, decision.action).expect("an action that was decided on can be done");
                let _ = agent.feedback(*pick(random, &[Feedback::Reward, Feedback::Punish, Feedback::Neutral]));
            }
        }
        10 => drop(agent.decide(home, &at.1)),
        11 => drop(agent.acted(home, &at.1, action)),
        12 => drop(agent.feedback(*pick(random, &[Feedback::Reward, Feedback::Punish, Feedback::Neutral]))),
        13 | 14 => drop(agent.demonstrated(home, &at.1, action)),
        15 => agent.forget(),
        16 => drop(agent.finish(home)),
        17 => drop(agent.learn(random.next_u32() % 300)),
        18 => agent.learn_fully(),
        19 => {
            let value = |random: &mut Pcg32| *pick(random, &[0.0, 1.0, 0.5, 0.1, f32::NAN, 1e-30]);
            let strategies: Vec<_> = (0..below(5, random))
                .filter_map(|_| Some((Strategy::new(value(random), value(random), value(random)).ok()?, value(random))))
                .collect();
            let _ = agent.set_strategies(&strategies);
        }
        20 => at.1 = home.numbered(u64::from(random.next_u32()) % home.state_count()),
        _ => {
            // A home of another session.
            let other = below(homes.len(), random);
            *at = (other, homes[other].1);
            let _ = agent.weigh(&homes[other].0);
        }
    }
}

fn walk(capacities: &Capacities, seed: u64) {
    let random = &mut Pcg32::seed_from_u64(seed);
    let [mut memory, mut first, mut second] = [(); 3].map(|()| HeapMemory::new(capacities));
    let homes: Vec<_> = [any_home(&mut first.home, random), any_home(&mut second.home, random)].into_iter().flatten().collect();
    if !homes.is_empty() {
        let lifted: Vec<_> =
            ["agentInRoom(?a, ?r)", "blockInRoom(?o, ?r)", "agentInRoom(?a, ?r) & blockInRoom(?o, ?s)", "blockInDoor(?b, ?d)"]
                .iter()
                .take(1 + below(4, random))
                .map(|text| LiftedTask::parse(text, &goodbot::home::SCHEMA).unwrap())
                .collect();
        let language = Settings {
            length: below(3, random) == 0,
            smoothing: *pick(random, &[0.1, 0.0]),
            rounds: below(4, random) as u32,
            alignment_prior: *pick(random, &[0.0, 1.0]),
            ..Settings::PAPER
        };
        let weights = *pick(random, &[Weights::Paper, Weights::Belief]);
        let options = Options { language, weights, least_weight: *pick(random, &[5e-5, 0.5, 0.0]), ..Options::DEFAULT };
        let mut agent = Agent::new(&mut memory.agent, &lifted, options).unwrap();
        let mut at = (0, homes[0].1);
        for _ in 0..120 {
            act(&mut agent, &homes, &mut at, random);
            check(&agent, seed);
        }
    }
}

#[test]
fn calls_in_any_order_neither_panic_nor_give_what_is_no_probability() {
    let seeds = std::env::var("GOODBOT_SEEDS").ok().and_then(|text| text.parse().ok()).unwrap_or(60);
    for seed in 0..seeds {
        [&Capacities::SMALL, &TINY, &HASHING].iter().for_each(|capacities| walk(capacities, seed));
    }
}
