//! Laws that hold for every home, command, feedback and training data.

use goodbot::feedback::{Feedback, Strategy as Trainer};
use goodbot::home::paper_tasks;
use goodbot::language::{LanguageModel, Settings};
use goodbot::memory::{AgentHeap, AgentMemory};
use goodbot::oomdp::{Action, Domain};
use goodbot::planning::{Judgement, OptimalSet, Progress};
use goodbot::symbols::Symbol;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_tests::fixture::task_text;
use goodbot_tests::school::Lesson;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::RngSeed;
use std::collections::{BTreeMap, HashMap, VecDeque};

const COLORS: [&str; 5] = ["red", "green", "blue", "yellow", "purple"];

/// The small preset with room for any of the training data below.
const LARGE: Capacities = Capacities { alignments: 4_096, length_pairs: 64, ..Capacities::SMALL };

fn lesson() -> impl proptest::strategy::Strategy<Value = Lesson> {
    let color = || select(&COLORS[..]);
    let block = (color(), select(vec!["chair", "bag", "basket"]));
    let word = select(vec!["go", "take", "to", "the", "room", "red", "green", "chair", "bag"]);
    (vec(color(), 4), vec(block, 0..2), vec(word, 1..9)).prop_map(|(rooms, blocks, words)| Lesson {
        command: words.join(" "),
        rooms: [rooms[0], rooms[1], rooms[2], rooms[3]],
        blocks,
        intended: (None, 0),
    })
}

fn feedback() -> impl proptest::strategy::Strategy<Value = Feedback> {
    select(vec![Feedback::Reward, Feedback::Punish, Feedback::Neutral])
}

fn trainer() -> impl proptest::strategy::Strategy<Value = Trainer> {
    (0.0..=1.0_f32, 0.0..=1.0_f32, 0.0..=1.0_f32).prop_map(|(plus, minus, epsilon)| Trainer::new(plus, minus, epsilon).unwrap())
}

fn agent(memory: &mut HeapMemory, trainer: Trainer) -> Agent<&mut AgentHeap> {
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::PAPER).unwrap();
    agent.set_strategies(&[(trainer, 0.5), (Trainer::BALANCED, 0.5)]).unwrap();
    agent
}

fn posterior(agent: &Agent<impl AgentMemory>) -> Vec<f32> {
    (0..agent.tasks().len()).map(|task| agent.belief().probability(task)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn posteriors_sum_to_1_whatever_the_trainer_says(
        lesson in lesson(), trainer in trainer(), steps in vec((0..5_u8, feedback()), 1..30),
    ) {
        let (mut memory, mut home_memory) = (HeapMemory::new(&Capacities::SMALL), HeapMemory::new(&Capacities::SMALL));
        let mut agent = agent(&mut memory, trainer);
        let (home, state) = lesson.home(&mut home_memory.home);
        prop_assume!(agent.hear(&home, &state, &lesson.command).is_ok());
        agent.plan_fully(&home, &state).unwrap();
        for (action, feedback) in steps {
            let _ = agent.acted(&home, &state, Action::new(action));
            let _ = agent.feedback(feedback);
            let posterior = posterior(&agent);
            prop_assert!(posterior.iter().all(|probability| (0.0..=1.0).contains(probability)));
            prop_assert!((posterior.iter().sum::<f32>() - 1.0).abs() < 1e-5, "{posterior:?}");
        }
    }

    #[test]
    fn silence_of_a_trainer_who_is_silent_alike_after_right_and_wrong_changes_nothing(
        lesson in lesson(), mu in 0.01..=1.0_f32, epsilon in 0.0..=1.0_f32, first in feedback(), actions in vec(0..4_u8, 1..20),
    ) {
        let (mut memory, mut home_memory) = (HeapMemory::new(&Capacities::SMALL), HeapMemory::new(&Capacities::SMALL));
        let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::PAPER).unwrap();
        agent.set_strategies(&[(Trainer::new(mu, mu, epsilon).unwrap(), 1.0)]).unwrap();
        let (home, state) = lesson.home(&mut home_memory.home);
        prop_assume!(agent.hear(&home, &state, &lesson.command).is_ok());
        agent.plan_fully(&home, &state).unwrap();
        agent.acted(&home, &state, Action::new(0)).unwrap();
        let _ = agent.feedback(first).unwrap();
        let before = posterior(&agent);
        for action in actions {
            agent.acted(&home, &state, Action::new(action)).unwrap();
            let _ = agent.feedback(Feedback::Neutral).unwrap();
        }
        for (before, after) in before.iter().zip(posterior(&agent)) {
            prop_assert!((before - after).abs() < 1e-4, "{before} became {after}");
        }
    }

    #[test]
    fn an_action_that_is_as_good_for_every_task_says_nothing_about_the_task(
        lesson in lesson(), trainer in trainer(), feedback in feedback(),
    ) {
        let (mut memory, mut home_memory) = (HeapMemory::new(&Capacities::SMALL), HeapMemory::new(&Capacities::SMALL));
        let mut agent = agent(&mut memory, trainer);
        let (home, state) = lesson.home(&mut home_memory.home);
        prop_assume!(agent.hear(&home, &state, &lesson.command).is_ok());
        agent.plan_fully(&home, &state).unwrap();
        // Doing nothing reaches no goal: it is wrong for all tasks whose goal can still be reached.
        let apart = |task| !matches!(agent.planned().optimal(task), OptimalSet::Toward(_));
        prop_assume!(!(0..agent.tasks().len()).any(apart));
        let before = posterior(&agent);
        agent.acted(&home, &state, Action::NOOP).unwrap();
        let _ = agent.feedback(feedback).unwrap();
        for (before, after) in before.iter().zip(posterior(&agent)) {
            prop_assert!((before - after).abs() < 1e-5, "{before} became {after}");
        }
    }

    #[test]
    fn the_penalised_likelihood_never_falls_from_one_round_to_the_next(
        data in vec((vec(0..6_usize, 1..6), vec(0..8_usize, 1..6), 0.001..=1.0_f32), 1..8),
        (smoothing, alignment_prior) in prop_oneof![
            Just((Settings::PAPER.smoothing, Settings::PAPER.alignment_prior)),
            Just((Settings::SMOOTHED.smoothing, Settings::SMOOTHED.alignment_prior)),
            (0.01..1.0_f32, 0.0..6.0_f32),
        ],
    ) {
        let mut last = f64::NEG_INFINITY;
        for rounds in 1..12 {
            let mut memory = HeapMemory::new(&LARGE);
            let settings = Settings { smoothing, alignment_prior, rounds, ..Settings::PAPER };
            let mut model = LanguageModel::new(&mut memory.agent, settings).unwrap();
            for (tokens, words, weight) in &data {
                let command: Vec<Symbol> = tokens.iter().map(|token| model.lend().tokens_mut().intern(&format!("token{token}")).unwrap()).collect();
                let english: Vec<String> = words.iter().map(|word| format!("word{word}")).collect();
                let sentence = model.lend().hear(&english.join(" ")).unwrap();
                model.lend().add_session(&sentence, std::iter::once((&command[..], *weight))).unwrap();
            }
            model.lend().begin_training();
            while model.lend().train(u32::MAX) == Progress::Working {}
            let now = objective(model.read());
            prop_assert!(now >= last - 1e-4 * last.abs().max(1.0), "round {rounds}: {now} after {last}");
            last = now;
        }
    }

    #[test]
    fn permuting_the_objects_permutes_the_posterior(
        lesson in lesson(), order in Just((0..10_usize).collect::<Vec<_>>()).prop_shuffle(), steps in vec((0..5_u8, feedback()), 0..8),
    ) {
        let believe = |order: &[usize]| {
            let (mut memory, mut home_memory) = (HeapMemory::new(&Capacities::SMALL), HeapMemory::new(&Capacities::SMALL));
            let mut agent = agent(&mut memory, Trainer::PUNISH_ONLY);
            let (home, state) = lesson.home_in_order(order, &mut home_memory.home);
            agent.hear(&home, &state, &lesson.command).ok()?;
            agent.plan_fully(&home, &state).unwrap();
            for &(action, feedback) in &steps {
                let _ = agent.acted(&home, &state, Action::new(action));
                let _ = agent.feedback(feedback);
            }
            let name = |task| task_text(&home, agent.lifted(), task);
            let beliefs: BTreeMap<String, f32> = agent.tasks().iter().map(name).zip(posterior(&agent)).collect();
            Some(beliefs)
        };
        let (one, other) = (believe(&(0..10).collect::<Vec<_>>()), believe(&order));
        prop_assert_eq!(one.is_some(), other.is_some());
        let (one, other) = (one.unwrap_or_default(), other.unwrap_or_default());
        prop_assert!(one.keys().eq(other.keys()));
        for (name, belief) in &one {
            prop_assert!((belief - other[name]).abs() < 1e-5, "{}: {} and {}", name, belief, other[name]);
        }
    }

    #[test]
    fn plans_are_shortest_against_a_brute_force_search(lesson in lesson(), walk in vec(0..4_u8, 0..40)) {
        let (mut memory, mut home_memory) = (HeapMemory::new(&Capacities::SMALL), HeapMemory::new(&Capacities::SMALL));
        let mut agent = agent(&mut memory, Trainer::BALANCED);
        let (home, start) = lesson.home(&mut home_memory.home);
        prop_assume!(agent.hear(&home, &start, &lesson.command).is_ok());
        let state = walk.iter().fold(start, |state, &action| home.step(&state, Action::new(action)).unwrap_or(state));
        agent.plan_fully(&home, &state).unwrap();
        for (position, task) in agent.tasks().iter().enumerate() {
            let lifted = &agent.lifted()[usize::from(task.lifted)];
            let holds = |state: &_| task.propositions(lifted).all(|part| home.holds(&part, state));
            let expected = distance(&home, &state, holds);
            prop_assert_eq!(agent.planned().distance(position), expected);
            let Some(expected) = expected.filter(|&distance| distance > 0) else { continue };
            for action in (0..home.actions().len()).map(|action| Action::new(action as u8)) {
                let left = home.step(&state, action).and_then(|next| distance(&home, &next, holds));
                let optimal = agent.planned().judge(position, action) == Judgement::Correct;
                prop_assert_eq!(optimal, left == Some(expected - 1));
            }
        }
    }
}

/// Steps to the nearest state where the task holds, breadth first.
fn distance<D: Domain>(domain: &D, start: &D::State, holds: impl Fn(&D::State) -> bool) -> Option<u32> {
    let mut found = HashMap::from([(domain.number(start), 0)]);
    let mut open = VecDeque::from([*start]);
    while let Some(state) = open.pop_front() {
        let steps = found[&domain.number(&state)];
        if holds(&state) {
            return Some(steps);
        }
        for next in (0..domain.actions().len()).filter_map(|action| domain.step(&state, Action::new(action as u8))) {
            found.entry(domain.number(&next)).or_insert_with(|| {
                open.push_back(next);
                steps + 1
            });
        }
    }
    None
}

/// The logarithm of EM's objective: the weighted likelihood of the data times the priors that the pseudo-counts express.
fn objective(model: goodbot::language::LanguageRef<'_>) -> f64 {
    let (tables, bitext, settings) = (model.tables(), model.bitext(), model.settings());
    let rows = || std::iter::once(None).chain(model.tokens().iter().map(|(token, _)| Some(token)));
    let log = |value: f32| f64::from(value).ln();
    let mut sum = 0.0;
    for pair in bitext.pairs() {
        let (command, sentence) = (bitext.command(pair.command), bitext.sentence(pair.session));
        for (i, &word) in sentence.iter().enumerate() {
            let explained: f32 = std::iter::once(None)
                .chain(command.iter().copied().map(Some))
                .enumerate()
                .map(|(j, token)| tables.alignment(j, i, command.len(), sentence.len()) * tables.translation(word, token))
                .sum();
            sum += f64::from(pair.weight) * log(explained);
        }
    }
    for token in rows() {
        sum += model.words().iter().map(|(word, _)| f64::from(settings.smoothing) * log(tables.translation(word, token))).sum::<f64>();
    }
    if settings.alignment_prior > 0.0 {
        for lengths in tables.length_pairs() {
            let (machine, english) = (usize::from(lengths.machine), usize::from(lengths.english));
            let share = f64::from(settings.alignment_prior) / (machine + 1) as f64;
            for i in 0..english {
                sum += (0..=machine).map(|j| share * log(tables.alignment(j, i, machine, english))).sum::<f64>();
            }
        }
    }
    sum
}
