//! Saving and restoring keep the model to the last bit.

use goodbot::capacity::Capacity;
use goodbot::feedback::Strategy;
use goodbot::home::paper_tasks;
use goodbot::language::Settings;
use goodbot::memory::{AgentHeap, AgentMemory};
use goodbot::oomdp::Schema;
use goodbot::planning::Progress;
use goodbot::snapshot::{Contents, RestoreError, SaveError, most_bytes};
use goodbot::task::LiftedTask;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_tests::school::{self, posterior_bits, train};
use rand_pcg::Pcg32;

const TRAINERS: [(Strategy, f32); 3] = [(Strategy::BALANCED, 0.4), (Strategy::PUNISH_ONLY, 0.3), (Strategy::REWARD_ONLY, 0.3)];

fn agent(memory: &mut HeapMemory) -> Agent<&mut AgentHeap> {
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::PAPER).unwrap();
    agent.set_strategies(&TRAINERS).unwrap();
    agent
}

fn saved(agent: &Agent<impl AgentMemory>) -> Vec<u8> {
    let mut buffer = vec![0; most_bytes(&Capacities::STANDARD)];
    let length = agent.save(&mut buffer).unwrap();
    buffer.truncate(length);
    buffer
}

/// The agent's parameters, its trainer beliefs and its posteriors of the tests, as bits.
fn mind(agent: &mut Agent<impl AgentMemory>) -> Vec<u32> {
    let mut bits: Vec<u32> = (0..3).map(|strategy| agent.belief().strategy_probability(strategy).to_bits()).collect();
    for (token, _) in agent.language().tokens().iter() {
        bits.extend(agent.language().words().iter().map(|(word, _)| agent.language().tables().translation(word, Some(token)).to_bits()));
    }
    for test in school::tests() {
        bits.extend(posterior_bits(agent, &test));
    }
    bits
}

#[test]
fn a_restored_robot_goes_on_as_if_it_had_never_been_switched_off() {
    let mut random = Pcg32::new(7, 7);
    let mut first_memory = HeapMemory::new(&Capacities::SMALL);
    let mut never_saved = agent(&mut first_memory);
    for lesson in school::lessons() {
        // The size of the memory into which a model is restored makes no difference.
        let mut same_memory = HeapMemory::new(&Capacities::SMALL);
        let mut larger_memory = HeapMemory::new(&Capacities::STANDARD);
        let mut restored = [agent(&mut same_memory), agent(&mut larger_memory)];
        let (bytes, before) = (saved(&never_saved), random.clone());
        train(&mut never_saved, &lesson, Strategy::BALANCED, &mut random).unwrap();
        let expected = mind(&mut never_saved);
        for other in &mut restored {
            other.restore(&bytes).unwrap();
            other.learn_fully();
            train(other, &lesson, Strategy::BALANCED, &mut before.clone()).unwrap();
            assert_eq!(mind(other), expected);
        }
        assert_eq!(saved(&restored[0]), saved(&never_saved));
    }
    assert_eq!(school::tests_passed(&mut never_saved), 5);
}

#[test]
fn what_is_restored_is_saved_as_the_same_bytes() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = agent(&mut memory);
    let mut random = Pcg32::new(1, 1);
    for lesson in &school::lessons()[..3] {
        train(&mut agent, lesson, Strategy::PUNISH_ONLY, &mut random).unwrap();
        let bytes = saved(&agent);
        assert_eq!(agent.saved_bytes(), Ok(bytes.len()));
        agent.restore(&bytes).unwrap();
        assert_eq!(agent.learn(1), Progress::Working);
        // The same in the middle of training.
        assert_eq!(saved(&agent), bytes);
        agent.restore(&bytes).unwrap();
        agent.learn_fully();
        assert_eq!(saved(&agent), bytes);
    }
}

#[test]
fn a_model_saved_in_the_middle_of_a_training_is_trained_to_the_same_bits() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = agent(&mut memory);
    for lesson in school::lessons() {
        train(&mut agent, &lesson, Strategy::BALANCED, &mut Pcg32::new(3, 3)).unwrap();
    }
    let (bytes, expected) = (saved(&agent), mind(&mut agent));
    agent.restore(&bytes).unwrap();
    for budget in [1, 100, 3_000] {
        assert_eq!(agent.learn(budget), Progress::Working);
        agent.restore(&saved(&agent)).unwrap();
    }
    agent.learn_fully();
    assert_eq!(mind(&mut agent), expected);
}

#[test]
fn a_buffer_that_is_too_small_is_told_how_much_is_needed() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = agent(&mut memory);
    train(&mut agent, &school::lessons()[0], Strategy::BALANCED, &mut Pcg32::new(1, 1)).unwrap();
    let needed = agent.saved_bytes().unwrap();
    assert!(needed <= most_bytes(&Capacities::SMALL));
    for given in [0, 13, 20, needed - 1] {
        assert_eq!(agent.save(&mut vec![0; given]), Err(SaveError::Buffer { needed, given }));
    }
    assert_eq!(agent.save(&mut vec![0; needed]), Ok(needed));
}

#[test]
fn what_does_not_fit_is_refused_by_the_capacitys_name_and_changes_nothing() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut full = agent(&mut memory);
    for lesson in school::lessons() {
        train(&mut full, &lesson, Strategy::BALANCED, &mut Pcg32::new(5, 5)).unwrap();
    }
    let bytes = saved(&full);
    let contents = Contents::read(&bytes).unwrap();
    assert_eq!((contents.sessions.len(), contents.sizes.words), (7, Capacities::SMALL.words));
    let small = Capacities::SMALL;
    let smaller = [
        (Capacities { words: 4, ..small }, Capacity::Words),
        (Capacities { word_bytes: 30, ..small }, Capacity::WordBytes),
        (Capacities { tokens: 14, ..small }, Capacity::Tokens),
        (Capacities { token_bytes: 110, ..small }, Capacity::TokenBytes),
        (Capacities { commands: 4, ..small }, Capacity::Commands),
        (Capacities { command_tokens: 30, ..small }, Capacity::CommandTokens),
        (Capacities { sessions: 2, ..small }, Capacity::Sessions),
        (Capacities { sentence_words: 20, ..small }, Capacity::SentenceWords),
        (Capacities { pairs: 8, ..small }, Capacity::Pairs),
        (Capacities { translations: 150, ..small }, Capacity::Translations),
        (Capacities { alignments: 100, ..small }, Capacity::Alignments),
        (Capacities { length_pairs: 2, ..small }, Capacity::LengthPairs),
    ];
    for (capacities, capacity) in smaller {
        let mut memory = HeapMemory::new(&capacities);
        let mut other = agent(&mut memory);
        let _ = train(&mut other, &school::lessons()[0], Strategy::BALANCED, &mut Pcg32::new(1, 1));
        let before = saved(&other);
        match other.restore(&bytes) {
            Err(RestoreError::Capacity(error)) => assert_eq!(error.capacity, capacity),
            result => panic!("{capacity:?}: {result:?}"),
        }
        assert_eq!(saved(&other), before);
    }
    let mut memory = HeapMemory::new(&Capacities { strategies: 2, beliefs: 24, ..small });
    let mut other = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::PAPER).unwrap();
    assert!(matches!(other.restore(&bytes), Err(RestoreError::Capacity(error)) if error.capacity == Capacity::Strategies));
}

#[test]
fn a_model_of_another_domain_is_refused() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let agent = agent(&mut memory);
    let schema = Schema { attributes: &[], ..goodbot::home::SCHEMA };
    let tasks = [LiftedTask::parse("agentInRoom(?a, ?r)", &schema).unwrap()];
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut other = Agent::new(&mut memory.agent, &tasks, Options::PAPER).unwrap();
    assert_eq!(other.restore(&saved(&agent)), Err(RestoreError::OtherDomain));
}

/// The model after the paper's course with a trainer of three strategies, saved in format 1. The file stays as it is for ever.
const FORMAT_1: &[u8] = include_bytes!("format_1.model");

#[test]
fn a_file_of_format_1_is_understood_for_ever() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = agent(&mut memory);
    agent.restore(FORMAT_1).unwrap();
    agent.learn_fully();
    let bitext = agent.language().bitext();
    assert_eq!((bitext.sessions(), agent.language().words().len()), (7, 12));
    assert_eq!(*agent.options(), Options::PAPER);
    assert_eq!(agent.belief().strategies().len(), 3);
    assert_eq!(school::tests_passed(&mut agent), 5);
}

/// The model that `goodbot learn` makes of the log that `goodbot example log` prints, with its layer, saved in format 3. The file stays as it
/// is for ever.
const FORMAT_3: &[u8] = include_bytes!("format_3.model");

#[test]
fn a_file_of_format_3_is_understood_for_ever_with_its_layer_and_without() {
    let contents = Contents::read(FORMAT_3).unwrap();
    assert!(contents.options.language.layer && contents.possible_counts.len() == 4);
    let capacities = Capacities::STANDARD.at_least(contents.sizes);
    let restored = |memory: AgentHeap| {
        let mut agent = Agent::new(memory, &paper_tasks().unwrap(), Options::DEFAULT).unwrap();
        agent.restore(FORMAT_3).unwrap();
        agent.learn_fully();
        agent
    };
    let layered = restored(goodbot_layer::above(AgentHeap::new(&capacities), contents.possible.len()));
    assert_eq!(layered.saved().unwrap(), FORMAT_3);
    let alone = restored(AgentHeap::new(&capacities));
    assert_eq!((alone.language().bitext().sessions(), alone.options().language), (4, Settings::DEFAULT));
    let saved = alone.saved().unwrap();
    assert_eq!(&saved[8..10], [2, 0]);
    assert!(FORMAT_3.starts_with(&saved[..8]) && FORMAT_3.windows(saved.len() - 18).any(|part| part == &saved[14..saved.len() - 4]));
}

#[test]
fn a_later_format_is_refused_by_its_number() {
    let mut bytes = FORMAT_1.to_vec();
    bytes[8] = 4;
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = agent(&mut memory);
    assert_eq!(agent.restore(&bytes), Err(RestoreError::Version { found: 4 }));
}

#[test]
fn what_was_joined_without_room_is_undone() {
    let mut memory = HeapMemory::new(&Capacities { words: 8, ..Capacities::SMALL });
    let mut agent = agent(&mut memory);
    train(&mut agent, &school::lessons()[0], Strategy::BALANCED, &mut Pcg32::new(1, 1)).unwrap();
    let knew = mind(&mut agent);
    let before = saved(&agent);
    assert!(matches!(agent.join(FORMAT_1), Err(RestoreError::Capacity(error)) if error.capacity == Capacity::Words));
    agent.learn_fully();
    assert_eq!(saved(&agent), before);
    assert_eq!(mind(&mut agent)[3..], knew[3..]);
}
