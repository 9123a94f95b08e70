//! A life of many sessions in the memory of a controller: full tables drop old sessions, and learning goes on.

use goodbot::capacity::{Capacity, CapacityError};
use goodbot::feedback::Strategy;
use goodbot::home::paper_tasks;
use goodbot::memory::AgentMemory;
use goodbot::{Agent, AgentError, Capacities, HeapMemory, Options};
use goodbot_tests::school::{self, Lesson, tests_passed, train};
use rand_core::Rng;
use rand_pcg::Pcg32;

/// Sessions of one life in every test run, many times more than memory holds, and in the published figures.
const SESSIONS: usize = 200;
const PUBLISHED: usize = 1_000;

fn draw(count: usize, random: &mut Pcg32) -> usize {
    (random.next_u32() as usize) % count
}

/// A life: chooses the next lesson.
type Life = fn(usize, &mut Pcg32) -> Lesson;

fn any_lesson(_: usize, random: &mut Pcg32) -> Lesson {
    let mut lessons = school::lessons();
    lessons.swap_remove(draw(lessons.len(), random))
}

/// The course once, and from then on the same two commands.
fn course_then_the_same(session: usize, random: &mut Pcg32) -> Lesson {
    let mut lessons = school::lessons();
    let position = if session < lessons.len() { session } else { draw(2, random) };
    lessons.swap_remove(position)
}

/// Three commands in ten have a word that never occurs again.
fn with_slips(session: usize, random: &mut Pcg32) -> Lesson {
    let mut lesson = any_lesson(session, random);
    if draw(10, random) < 3 {
        lesson.command = format!("{} slip{session}", lesson.command);
    }
    lesson
}

/// Half of the commands consist of words that never occur again.
fn half_of_it_noise(session: usize, random: &mut Pcg32) -> Lesson {
    let mut lesson = any_lesson(session, random);
    if draw(2, random) == 0 {
        lesson.command = format!("a{session} b{session} c{session}");
    }
    lesson
}

/// Each life, and how many of the five tests a robot passes after it at least.
const LIVES: [(&str, Life, usize); 4] = [
    ("the seven commands in any order", any_lesson, 5),
    ("the course, then two commands for ever", course_then_the_same, 5),
    ("three commands in ten with a new word", with_slips, 5),
    ("half of the commands all new words", half_of_it_noise, 4),
];

/// The robots that live each life.
const ROBOTS: u64 = 10;

fn live(name: &str, life: Life, options: Options, seed: u64, sessions: usize) -> usize {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), options).unwrap();
    let mut random = Pcg32::new(seed, 1);
    for session in 0..sessions {
        let lesson = life(session, &mut random);
        train(&mut agent, &lesson, Strategy::BALANCED, &mut random).unwrap_or_else(|error| panic!("{name}, session {session}: {error}"));
        let language = agent.language();
        assert!(language.bitext().sentence(language.bitext().sessions() as u16 - 1).len() > 2, "the newest session is kept");
    }
    tests_passed(&mut agent)
}

/// All lives, with the paper's settings, and with the default ones for fewer robots.
fn live_all(sessions: usize) {
    for (options, called, robots) in [(Options::PAPER, "the paper's", ROBOTS), (Options::DEFAULT, "the default", ROBOTS / 2)] {
        for (name, life, least) in LIVES {
            let passed: Vec<usize> = (0..robots).map(|seed| live(name, life, options, seed, sessions)).collect();
            println!("{sessions} sessions, {name}, {called} settings: tests passed {passed:?} of 5");
            assert!(passed.iter().all(|&passed| passed >= least), "{name}");
        }
    }
}

#[test]
fn after_two_hundred_sessions_in_the_small_preset_the_five_tests_pass() {
    live_all(SESSIONS);
}

#[test]
#[ignore = "a minute: the figures of docs/reliability.md"]
fn after_a_thousand_sessions_in_the_small_preset_the_five_tests_pass() {
    live_all(PUBLISHED);
}

/// The robot's model, as saved.
fn saved(agent: &Agent<impl AgentMemory>) -> Vec<u8> {
    let mut bytes = vec![0; agent.saved_bytes().unwrap()];
    agent.save(&mut bytes).unwrap();
    bytes
}

#[test]
fn a_robot_that_was_saved_and_restored_forgets_as_one_that_never_was() {
    let mut memories = [HeapMemory::new(&Capacities::SMALL), HeapMemory::new(&Capacities::SMALL)];
    let tasks = paper_tasks().unwrap();
    let [mut never, mut restored] = memories.each_mut().map(|memory| Agent::new(&mut memory.agent, &tasks, Options::PAPER).unwrap());
    let mut randoms = [Pcg32::new(3, 1), Pcg32::new(3, 1)];
    for session in 0..120 {
        for (agent, random) in [&mut never, &mut restored].into_iter().zip(&mut randoms) {
            let lesson = half_of_it_noise(session, random);
            train(agent, &lesson, Strategy::BALANCED, random).unwrap();
        }
        restored.restore(&saved(&restored)).unwrap();
        restored.learn_fully();
        assert!(saved(&never) == saved(&restored), "session {session}");
    }
}

#[test]
fn a_home_with_more_new_things_than_there_is_room_for_is_lived_in_and_learned() {
    // The seven lessons' homes have nineteen machine tokens.
    let mut memory = HeapMemory::new(&Capacities { tokens: 12, ..Capacities::SMALL });
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::PAPER).unwrap();
    let mut random = Pcg32::new(1, 1);
    for _ in 0..3 {
        for lesson in school::lessons() {
            train(&mut agent, &lesson, Strategy::BALANCED, &mut random).unwrap();
        }
    }
    // A token that had no room at first is learned when it is met again.
    for lesson in [&school::lessons()[0], &school::lessons()[1]] {
        for _ in 0..6 {
            train(&mut agent, lesson, Strategy::BALANCED, &mut random).unwrap();
        }
        assert!(school::understands(&mut agent, lesson), "{}", lesson.command);
    }
}

#[test]
fn words_that_stand_in_no_session_any_more_are_forgotten() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::PAPER).unwrap();
    let mut random = Pcg32::new(1, 1);
    for session in 0..60 {
        train(&mut agent, &half_of_it_noise(session, &mut random), Strategy::BALANCED, &mut random).unwrap();
        let language = agent.language();
        let kept = |symbol| (0..language.bitext().sessions() as u16).any(|session| language.bitext().sentence(session).contains(&symbol));
        assert!(language.words().iter().all(|(symbol, _)| kept(symbol)), "session {session}");
    }
}

#[test]
fn a_vocabulary_that_was_restored_full_makes_room_for_a_command_of_new_words() {
    let mut memory = HeapMemory::new(&Capacities::SMALL);
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::PAPER).unwrap();
    let mut random = Pcg32::new(1, 1);
    for lesson in school::lessons() {
        train(&mut agent, &lesson, Strategy::BALANCED, &mut random).unwrap();
    }
    let words = agent.language().words().len();
    let mut memory = HeapMemory::new(&Capacities { words, ..Capacities::SMALL });
    let mut full = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::PAPER).unwrap();
    full.restore(&saved(&agent)).unwrap();
    full.learn_fully();
    let new = Lesson { command: "vite".to_owned(), ..school::lessons()[0].clone() };
    let error = AgentError::Capacity(CapacityError::full(Capacity::Words, words));
    assert_eq!(train(&mut full, &new, Strategy::BALANCED, &mut random), Err(error));
    full.learn_fully();
    assert_eq!(tests_passed(&mut full), 5, "what was learned is still known");
    assert_eq!(train(&mut full, &new, Strategy::BALANCED, &mut random), Ok(()));
    assert!(full.language().words().find("vite").is_some());
}

#[test]
fn a_session_too_large_for_the_memory_is_refused_and_nothing_is_forgotten() {
    let mut memory = HeapMemory::new(&Capacities { sentence_words: 16, ..Capacities::SMALL });
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::PAPER).unwrap();
    let mut random = Pcg32::new(1, 1);
    for lesson in &school::lessons()[..3] {
        train(&mut agent, lesson, Strategy::BALANCED, &mut random).unwrap();
    }
    let before = saved(&agent);
    let long = Lesson { command: "go ".repeat(17), ..school::lessons()[0].clone() };
    let error = CapacityError::new(Capacity::SentenceWords, 16, 17);
    assert_eq!(train(&mut agent, &long, Strategy::BALANCED, &mut random), Err(AgentError::Capacity(error)));
    assert!(before == saved(&agent));
}

#[test]
fn words_beyond_a_full_vocabulary_are_left_out_and_the_rest_is_learned() {
    let mut memory = HeapMemory::new(&Capacities { words: 6, ..Capacities::SMALL });
    let mut agent = Agent::new(&mut memory.agent, &paper_tasks().unwrap(), Options::PAPER).unwrap();
    let long = Lesson { command: "please go at once to the green room".to_owned(), ..school::lessons()[0].clone() };
    train(&mut agent, &long, Strategy::BALANCED, &mut Pcg32::new(1, 1)).unwrap();
    let language = agent.language();
    let words: Vec<&str> = language.bitext().sentence(0).iter().map(|&word| language.words().text(word)).collect();
    assert_eq!(words, ["please", "go", "at", "once", "to", "the"]);
}
