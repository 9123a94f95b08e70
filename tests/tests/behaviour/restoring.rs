//! A model restored into memory of the same capacities has the same bits; memory that is too small refuses it and names a table.

use goodbot::capacity::{Capacity, CapacityError};
use goodbot::feedback::Feedback;
use goodbot::home::paper_tasks;
use goodbot::language::{LanguageModel, Settings};
use goodbot::memory::{AgentHeap, AgentMemory};
use goodbot::planning::Progress;
use goodbot::session::{Lessons, Phase};
use goodbot::snapshot::SAVED;
use goodbot::snapshot::{Contents, RestoreError, Restoring, SaveError, Saving};
use goodbot::symbols::Symbol;
use goodbot::{Agent, AgentError, Capacities, HeapMemory, Options};
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

/// The capacities of `saved` for the tables that a model fills, and those of `rest` for the others.
fn with_saved(rest: Capacities, saved: &Capacities) -> Capacities {
    SAVED.into_iter().fold(rest, |mut capacities, table| {
        capacities.set(table, saved.get(table));
        capacities
    })
}

fn pick(random: &mut Pcg32, below: usize) -> usize {
    random.next_u32() as usize % below
}

/// A lesson's home, with its own command or one of one to nine random words.
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

/// Hears a lesson, takes a step, gets feedback, and learns.
fn experience(agent: &mut Agent<impl AgentMemory>, lesson: &Lesson, random: &mut Pcg32) {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let (home, state) = lesson.home(&mut memory.home);
    agent.hear(&home, &state, &lesson.command).unwrap();
    agent.plan_fully(&home, &state).unwrap();
    let decision = agent.decide_with(&home, &state, random).unwrap();
    let _ = agent.acted(&home, &state, decision.action).unwrap();
    let _ = agent.feedback([Feedback::Reward, Feedback::Punish, Feedback::Neutral][pick(random, 3)]).unwrap();
    let _ = agent.finish(&home).unwrap();
    agent.learn_fully();
}

/// The bits of its posterior after each lesson's command.
fn beliefs(agent: &mut Agent<impl AgentMemory>) -> Vec<Vec<u32>> {
    school::lessons().iter().map(|lesson| posterior_bits(agent, lesson)).collect()
}

/// Restores the agent's model into new memory of these capacities. Checks that no bit differs.
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
            // Further commands need room for their words, so their posteriors are compared in roomy memory.
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

/// A robot with the joined models of two others.
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
    let token = model.lend().tokens_mut().intern("roomIsRed").unwrap();
    let sentence = model.lend().hear("go to the red room").unwrap();
    for length in [30, 40, 60] {
        let command = vec![token; length];
        model.lend().add_session(&sentence, core::iter::once((command.as_slice(), 1.0))).unwrap();
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

/// A robot that has had some lessons.
fn taught(options: Options, seed: u64) -> Agent<AgentHeap> {
    let (mut random, mut agent) = (Pcg32::new(seed, 9), agent(&Capacities::SMALL, options));
    (0..20).for_each(|_| experience(&mut agent, &random_lesson(&mut random), &mut random));
    agent
}

fn saved_in_parts(agent: &Agent<impl AgentMemory>, mut budget: impl FnMut() -> u32) -> Vec<u8> {
    let (mut saving, mut bytes) = (Saving::new(), vec![0; 16_384]);
    let mut parts = 0;
    loop {
        parts += 1;
        assert!(parts < 20_000, "each part does something");
        if let Some(length) = agent.save_on(&mut saving, &mut bytes, budget()).unwrap() {
            bytes.truncate(length);
            return bytes;
        }
    }
}

fn restore_in_parts(agent: &mut Agent<impl AgentMemory>, bytes: &[u8], mut budget: impl FnMut() -> u32) -> Result<usize, RestoreError> {
    let (mut restoring, mut parts) = (Restoring::of(bytes), 1);
    while agent.restore_on(&mut restoring, budget())? == Progress::Working {
        parts += 1;
        assert!(parts < 20_000, "each part does something");
    }
    Ok(parts)
}

#[test]
fn a_model_is_saved_and_comes_back_with_the_same_bits_in_parts_of_any_size() {
    for (options, seed) in [(Options::DEFAULT, 1), (Options::PAPER, 2), (Options::SMOOTHED, 3)] {
        let mut agent = taught(options, seed);
        let bytes = saved(&agent);
        let before = beliefs(&mut agent);
        let mut random = Pcg32::new(seed, 10);
        let mut some = || 1 + random.next_u32() % 90;
        let budgets: [&mut dyn FnMut() -> u32; 6] = [&mut || 0, &mut || 1, &mut || 17, &mut || 400, &mut || u32::MAX, &mut some];
        for budget in budgets {
            assert_eq!(saved_in_parts(&agent, &mut *budget), bytes);
            let mut restored = taught(options, seed + 10);
            restore_in_parts(&mut restored, &bytes, &mut *budget).unwrap();
            assert_eq!(restored.phase(), Phase::Learning);
            restored.learn_fully();
            assert_eq!(saved(&restored), bytes);
            assert_eq!(beliefs(&mut restored), before);
        }
        let mut restored = self::agent(&Capacities::SMALL, options);
        assert!(restore_in_parts(&mut restored, &bytes, || 1).unwrap() > 300, "the smallest parts are small");
    }
}

#[test]
fn what_is_refused_at_once_is_refused_in_parts_and_the_robot_is_as_before() {
    let mut random = Pcg32::new(1, 11);
    let mut agent = taught(Options::DEFAULT, 4);
    let before = saved(&agent);
    let other = saved(&taught(Options::DEFAULT, 5));
    let too_large = saved(&joined(&Capacities::STANDARD, Options::DEFAULT, 3));
    let mut models = vec![Vec::new(), vec![0; 40], too_large];
    models.extend((0..200).map(|_| {
        let mut damaged = other.clone();
        let at = pick(&mut random, damaged.len());
        damaged[at] ^= 1 << pick(&mut random, 8);
        if random.next_u32().is_multiple_of(2) {
            // With a valid checksum, the content is wrong or is another model.
            super::bit_flips::sign(&mut damaged);
        }
        damaged
    }));
    for model in models {
        let mut at_once = taught(Options::DEFAULT, 4);
        let whole = at_once.restore(&model);
        let in_parts = restore_in_parts(&mut agent, &model, || 5).map(|_| ());
        assert_eq!(in_parts, whole);
        assert_eq!(saved(&agent), saved(&at_once));
        if whole.is_err() {
            assert_eq!(saved(&agent), before);
        } else {
            agent = taught(Options::DEFAULT, 4);
        }
    }
}

#[test]
fn while_a_model_is_checked_the_robot_does_what_it_did_and_while_it_comes_back_it_has_learned_nothing() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let (home, state) = school::lessons()[0].home(&mut memory.home);
    let bytes = saved(&taught(Options::DEFAULT, 6));
    let mut agent = taught(Options::DEFAULT, 7);
    let known = agent.language().bitext().sessions();
    agent.hear(&home, &state, "go to the red room").unwrap();
    let mut restoring = Restoring::of(&bytes);
    while agent.phase() != Phase::Restoring {
        assert_eq!(agent.phase(), Phase::Ready);
        assert_eq!(agent.language().bitext().sessions(), known);
        agent.plan_fully(&home, &state).unwrap();
        assert_eq!(agent.restore_on(&mut restoring, 1), Ok(Progress::Working));
    }
    let mut buffer = [0; 8_192];
    while agent.phase() == Phase::Restoring {
        assert_eq!(agent.hear(&home, &state, "go"), Err(AgentError::NotNow(Phase::Restoring)));
        assert_eq!(agent.hear_again(&home, &state), Err(AgentError::NotNow(Phase::Idle)));
        assert_eq!(agent.save(&mut buffer), Err(SaveError::StillLearning), "it would be half a model");
        assert_eq!((agent.language().bitext().sessions(), agent.language().words().len()), (0, 0));
        assert_eq!(agent.learn(1), Progress::Done, "there is nothing to learn");
        let _ = agent.restore_on(&mut restoring, 1).unwrap();
    }
    agent.learn_fully();
    assert_eq!(saved(&agent), bytes);
}

#[test]
fn a_model_that_is_given_up_half_way_leaves_a_robot_that_can_learn() {
    let bytes = saved(&taught(Options::DEFAULT, 8));
    let other = saved(&taught(Options::DEFAULT, 9));
    type Interruption = fn(&mut Agent<AgentHeap>, &[u8]);
    let interruptions: [Interruption; 6] = [
        |agent, _| agent.leave(),
        |agent, _| agent.begin_learning(),
        |agent, _| agent.forget(),
        |agent, _| agent.set_strategies(&[(goodbot::feedback::Strategy::BALANCED, 1.0)]).unwrap(),
        |agent, other| agent.restore(other).unwrap(),
        |agent, other| assert!(agent.join(other).unwrap() > 0),
    ];
    for interrupt in interruptions {
        for parts in [0, 1, 30, 80] {
            let mut agent = taught(Options::DEFAULT, 10);
            let mut restoring = Restoring::of(&bytes);
            while agent.phase() != Phase::Restoring {
                let _ = agent.restore_on(&mut restoring, 1).unwrap();
            }
            (0..parts).for_each(|_| assert_eq!(agent.restore_on(&mut restoring, 1), Ok(Progress::Working)));
            assert_eq!(agent.phase(), Phase::Restoring);
            interrupt(&mut agent, &other);
            assert_eq!(agent.restore_on(&mut restoring, 1), Err(RestoreError::Interrupted));
            agent.learn_fully();
            let lesson = &school::lessons()[0];
            experience(&mut agent, lesson, &mut Pcg32::new(1, 1));
            assert_eq!(Contents::read(&saved(&agent)).map(|_| ()), Ok(()));
            agent.restore(&bytes).unwrap();
            agent.learn_fully();
            assert_eq!(saved(&agent), bytes);
        }
    }
    // Two restores at the same time: the one begun last is completed.
    let mut agent = taught(Options::DEFAULT, 10);
    let [mut first, mut second] = [Restoring::of(&bytes), Restoring::of(&other)];
    while agent.phase() != Phase::Restoring {
        let _ = agent.restore_on(&mut first, 1).unwrap();
    }
    while agent.restore_on(&mut second, 50).unwrap() == Progress::Working {}
    assert_eq!(agent.restore_on(&mut first, 1), Err(RestoreError::Interrupted));
    agent.learn_fully();
    assert_eq!(saved(&agent), other);
}

#[test]
fn a_model_that_changes_while_it_is_saved_says_so_and_words_of_the_trainer_are_no_change() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let (home, state) = school::lessons()[0].home(&mut memory.home);
    for parts in [1, 9, 300] {
        let mut agent = taught(Options::DEFAULT, 11);
        let (mut saving, mut bytes) = (Saving::new(), vec![0; 16_384]);
        (0..parts).for_each(|_| assert_eq!(agent.save_on(&mut saving, &mut bytes, 1), Ok(None)));
        agent.hear(&home, &state, "go to the large hall").unwrap();
        agent.plan_fully(&home, &state).unwrap();
        let action = agent.decide(&home, &state).unwrap().action;
        let _ = agent.acted(&home, &state, action).unwrap();
        let _ = agent.feedback(Feedback::Reward).unwrap();
        let mut unchanged = saving.clone();
        let length = loop {
            if let Some(length) = agent.save_on(&mut unchanged, &mut bytes, 1).unwrap() {
                break length;
            }
        };
        assert_eq!(Contents::read(&bytes[..length]).map(|_| ()), Ok(()));
        let _ = agent.finish(&home).unwrap();
        agent.learn_fully();
        assert_eq!(agent.save_on(&mut saving, &mut bytes, 1), Err(SaveError::Changed));
        let other = saved(&agent);
        agent.restore(&other).unwrap();
        assert_eq!(agent.save_on(&mut saving, &mut bytes, 1), Err(SaveError::Changed));
    }
}

#[test]
fn a_buffer_that_is_too_small_is_told_of_in_parts_as_well() {
    let agent = taught(Options::DEFAULT, 12);
    let needed = agent.saved_bytes().unwrap();
    for given in [0, 10, needed - 1] {
        let (mut saving, mut bytes) = (Saving::new(), vec![0; given]);
        let refused = loop {
            match agent.save_on(&mut saving, &mut bytes, 3) {
                Ok(None) => {}
                other => break other,
            }
        };
        assert_eq!(refused, Err(SaveError::Buffer { needed, given }));
    }
}
