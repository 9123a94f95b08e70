//! A robot comes back: what was learned in some memory is restored into the same memory with the same bits, and smaller memory refuses it
//! by the name of a table.

use goodbot::capacity::{Capacity, CapacityError};
use goodbot::feedback::Feedback;
use goodbot::home::paper_tasks;
use goodbot::language::{LanguageModel, Settings};
use goodbot::memory::{AgentHeap, AgentMemory};
use goodbot::planning::Progress;
use goodbot::session::Lessons;
use goodbot::snapshot::SAVED;
use goodbot::snapshot::{Contents, RestoreError, SaveError};
use goodbot::symbols::Symbol;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_tests::school::{self, Lesson, posterior_bits};
use rand_core::Rng;
use rand_pcg::Pcg32;

const WORDS: [&str; 24] = [
    "go", "to", "the", "red", "green", "blue", "yellow", "room", "take", "bag", "chair", "please", "robot", "now", "walk", "over", "into",
    "that", "thing", "push", "corner", "quickly", "kindly", "there",
];

fn agent(capacities: &Capacities, options: Options) -> Agent<AgentHeap> {
    Agent::new(AgentHeap::new(capacities), &paper_tasks().unwrap(), options).unwrap()
}

fn saved(agent: &Agent<impl AgentMemory>) -> Vec<u8> {
    let mut bytes = vec![0; agent.saved_bytes().unwrap()];
    agent.save(&mut bytes).unwrap();
    bytes
}

/// The tables that learned things lie in are as large as `saved`, the others as in `rest`.
fn with_saved(rest: Capacities, saved: &Capacities) -> Capacities {
    SAVED.into_iter().fold(rest, |mut capacities, table| {
        capacities.set(table, saved.get(table));
        capacities
    })
}

fn pick(random: &mut Pcg32, below: usize) -> usize {
    random.next_u32() as usize % below
}

/// A lesson's home, with a command of one to nine words.
fn random_lesson(random: &mut Pcg32) -> Lesson {
    let command = if pick(random, 3) == 0 {
        None
    } else {
        let words: Vec<&str> = (0..1 + pick(random, 9)).map(|_| WORDS[pick(random, WORDS.len())]).collect();
        Some(words.join(" "))
    };
    let lesson = school::lessons()[pick(random, 7)].clone();
    Lesson { command: command.unwrap_or(lesson.command.clone()), ..lesson }
}

/// Hears a lesson, takes a step, is told something, and learns.
fn experience(agent: &mut Agent<impl AgentMemory>, lesson: &Lesson, random: &mut Pcg32) {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let (home, state) = lesson.home(&mut memory.home);
    agent.hear(&home, &state, &lesson.command).unwrap();
    agent.plan_fully(&home, &state).unwrap();
    let decision = agent.decide_by(&home, &state, random).unwrap();
    let _ = agent.acted(&home, &state, decision.action).unwrap();
    let _ = agent.feedback([Feedback::Reward, Feedback::Punish, Feedback::Neutral][pick(random, 3)]).unwrap();
    let _ = agent.finish(&home).unwrap();
    agent.learn_fully();
}

/// What it believes on hearing each lesson's command, bit by bit.
fn beliefs(agent: &mut Agent<impl AgentMemory>) -> Vec<Vec<u32>> {
    school::lessons().iter().map(|lesson| posterior_bits(agent, lesson)).collect()
}

/// Restores the agent's model into new memory of these capacities. Checks that it comes back to the bit.
fn comes_back(agent: &mut Agent<impl AgentMemory>, capacities: &Capacities, told: &str) {
    let bytes = saved(agent);
    let mut restored = self::agent(capacities, Options::DEFAULT);
    restored.restore(&bytes).unwrap_or_else(|error| panic!("{told}: {error}"));
    restored.learn_fully();
    assert_eq!(saved(&restored), bytes, "{told}");
    assert_eq!(beliefs(&mut restored), beliefs(agent), "{told}");
}

#[test]
fn any_robot_restores_its_own_model_in_every_preset_and_with_either_language_model() {
    for (name, capacities) in [("TINY", Capacities::TINY), ("SMALL", Capacities::SMALL), ("STANDARD", Capacities::STANDARD)] {
        let roomy = Capacities { states: Capacities::SMALL.states, hashed_states: 0, ..capacities };
        for (model, options) in [("roles", Options::DEFAULT), ("Model 2", Options::PAPER), ("smoothed", Options::SMOOTHED)] {
            for seed in 0..8 {
                let (mut random, mut agent) = (Pcg32::new(seed, 5), agent(&roomy, options));
                let sessions = 1 + pick(&mut random, if name == "STANDARD" { 16 } else { 60 });
                for session in 1..=sessions {
                    experience(&mut agent, &random_lesson(&mut random), &mut random);
                    if session % 9 == 0 || session == sessions {
                        comes_back(&mut agent, &roomy, &format!("{name}, {model}, seed {seed}, {session} sessions"));
                    }
                }
            }
        }
    }
}

#[test]
fn any_robot_restores_its_own_model_in_the_least_capacities() {
    for (name, options) in [("roles", Options::DEFAULT), ("Model 2", Options::PAPER)] {
        for seed in 0..6 {
            let mut random = Pcg32::new(seed, 6);
            let lessons: Vec<Lesson> = (0..1 + pick(&mut random, 12)).map(|_| random_lesson(&mut random)).collect();
            let commands = Lessons::of(lessons.iter().map(|lesson| lesson.command.as_str())).unwrap();
            let mut memories: Vec<HeapMemory> = lessons.iter().map(|_| HeapMemory::new(&Capacities::SMALL)).collect();
            let homes: Vec<_> = lessons.iter().zip(&mut memories).map(|(lesson, memory)| lesson.home(&mut memory.home).0).collect();
            let least = agent(&Capacities::STANDARD, options).least_capacities_of_all(&homes, &commands).unwrap();
            let least = with_saved(Capacities::SMALL, &least);
            let mut taught = agent(&least, options);
            lessons.iter().for_each(|lesson| experience(&mut taught, lesson, &mut random));
            assert_eq!(taught.language().bitext().sessions(), lessons.len(), "nothing gave way");
            // Commands that were not counted on need room for their words, so ask in roomy memory.
            let bytes = saved(&taught);
            let mut restored = agent(&least, options);
            restored.restore(&bytes).unwrap_or_else(|error| panic!("{name}, seed {seed}: {error}"));
            restored.learn_fully();
            assert_eq!(saved(&restored), bytes);
            assert_eq!(
                lessons.iter().map(|lesson| posterior_bits(&mut restored, lesson)).collect::<Vec<_>>(),
                lessons.iter().map(|lesson| posterior_bits(&mut taught, lesson)).collect::<Vec<_>>(),
            );
        }
    }
}

/// A robot with what two others learned.
fn joined(capacities: &Capacities, options: Options, seed: u64) -> Agent<AgentHeap> {
    let mut random = Pcg32::new(seed, 7);
    let [mut one, mut other] = [agent(capacities, options), agent(capacities, options)];
    for robot in [&mut one, &mut other] {
        (0..1 + pick(&mut random, 14)).for_each(|_| experience(robot, &random_lesson(&mut random), &mut random));
    }
    one.join(&saved(&other)).unwrap();
    one.learn_fully();
    one
}

#[test]
fn what_two_robots_learned_together_is_restored_as_well() {
    let capacities = Capacities { states: Capacities::SMALL.states, hashed_states: 0, ..Capacities::STANDARD };
    for options in [Options::DEFAULT, Options::PAPER] {
        for seed in 0..4 {
            comes_back(&mut joined(&capacities, options, seed), &capacities, &format!("{options:?}, seed {seed}"));
        }
    }
}

#[test]
fn a_model_needs_exactly_what_it_says_and_one_entry_less_is_refused_by_name_and_number() {
    let capacities = Capacities { states: Capacities::SMALL.states, hashed_states: 0, ..Capacities::STANDARD };
    for options in [Options::DEFAULT, Options::PAPER] {
        for seed in 0..4 {
            let mut agent = joined(&capacities, options, seed);
            let bytes = saved(&agent);
            let needs = Contents::read(&bytes).unwrap().needs();
            let exact = with_saved(capacities, &needs);
            let mut restored = self::agent(&exact, options);
            restored.restore(&bytes).unwrap();
            restored.learn_fully();
            let translation =
                |agent: &Agent<AgentHeap>, word, token| agent.language().tables().translation(Symbol::new(word), Some(Symbol::new(token)));
            for word in 0..needs.words as u16 {
                for token in 0..needs.tokens as u16 {
                    assert_eq!(translation(&restored, word, token).to_bits(), translation(&agent, word, token).to_bits());
                }
            }
            let before = beliefs(&mut agent);
            for table in SAVED.into_iter().filter(|&table| needs.get(table) > 0 && table != Capacity::Strategies) {
                let mut less = exact;
                less.set(table, needs.get(table) - 1);
                let mut smaller = self::agent(&less, options);
                let refused = CapacityError::new(table, needs.get(table) - 1, needs.get(table));
                assert_eq!(smaller.restore(&bytes), Err(RestoreError::Capacity(refused)));
            }
            assert_eq!(beliefs(&mut agent), before);
        }
    }
}

#[test]
fn long_machine_commands_of_model_2_are_counted_like_short_ones() {
    let mut model = LanguageModel::new(AgentHeap::new(&Capacities::STANDARD), Settings::PAPER).unwrap();
    let token = model.tokens_mut().intern("roomIsRed").unwrap();
    let sentence = model.hear("go to the red room").unwrap();
    for length in [30, 40, 60] {
        let command = vec![token; length];
        model.add_session(&sentence, core::iter::once((command.as_slice(), 1.0))).unwrap();
    }
    let mut bytes = vec![0; 4_096];
    let length = model.save(&mut bytes).unwrap();
    let needs = Contents::read(&bytes[..length]).unwrap().needs();
    assert_eq!((needs.length_pairs, needs.alignments), (3, (31 + 41 + 61) * 5));
}

#[test]
fn a_robot_that_is_just_learning_a_session_says_so_and_saves_nothing_that_could_not_be_restored() {
    for options in [Options::DEFAULT, Options::PAPER] {
        let (mut random, mut agent) = (Pcg32::new(3, 8), agent(&Capacities::SMALL, options));
        let mut memory = HeapMemory::new(&Capacities::SMALL);
        for lesson in (0..20).map(|_| random_lesson(&mut random)).chain(school::lessons()) {
            let (home, state) = lesson.home(&mut memory.home);
            agent.hear(&home, &state, &lesson.command).unwrap();
            agent.begin_finishing(&home).unwrap();
            let mut buffer = vec![0; 8_192];
            while agent.finish_on(&home, 1).unwrap().is_none() {
                match agent.save(&mut buffer) {
                    Ok(length) => assert_eq!(Contents::read(&buffer[..length]).map(|_| ()), Ok(())),
                    Err(error) => assert_eq!(error, SaveError::StillLearning),
                }
            }
            while agent.learn(1) == Progress::Working {}
        }
    }
}
