//! Joining the models of two robots: words and machine tokens match by their text, and common sessions are kept once.

use goodbot::capacity::Capacity;
use goodbot::feedback::Strategy;
use goodbot::home::paper_tasks;
use goodbot::language::Settings;
use goodbot::memory::{AgentHeap, AgentMemory};
use goodbot::snapshot::RestoreError;
use goodbot::{Agent, Capacities, HeapMemory, Options};
use goodbot_tests::school::{self, Lesson, tests_passed, train};
use rand_pcg::Pcg32;

const ROOMY: Capacities =
    Capacities { sessions: 64, sentence_words: 640, pairs: 1_024, commands: 128, command_tokens: 1_024, ..Capacities::SMALL };

fn agent(memory: &mut HeapMemory, options: Options) -> Agent<&mut AgentHeap> {
    Agent::new(&mut memory.agent, &paper_tasks().unwrap(), options).unwrap()
}

/// A model after these lessons.
fn model(lessons: &[&Lesson], options: Options, seed: u64) -> Vec<u8> {
    let mut memory = HeapMemory::new(&ROOMY);
    let mut agent = agent(&mut memory, options);
    let mut random = Pcg32::new(seed, 1);
    for lesson in lessons {
        train(&mut agent, lesson, Strategy::BALANCED, &mut random).unwrap();
    }
    saved(&agent)
}

/// A model that extends another one by these lessons.
fn grown(from: &[u8], lessons: &[&Lesson], seed: u64) -> Vec<u8> {
    let mut memory = HeapMemory::new(&ROOMY);
    let mut agent = agent(&mut memory, Options::PAPER);
    agent.restore(from).unwrap();
    agent.learn_fully();
    for lesson in lessons {
        train(&mut agent, lesson, Strategy::BALANCED, &mut Pcg32::new(seed, 1)).unwrap();
    }
    saved(&agent)
}

fn saved(agent: &Agent<impl AgentMemory>) -> Vec<u8> {
    let mut bytes = vec![0; agent.saved_bytes().unwrap()];
    agent.save(&mut bytes).unwrap();
    bytes
}

/// The command of each session, oldest first.
fn commands(agent: &Agent<impl AgentMemory>) -> Vec<String> {
    let language = agent.language();
    let text = |session| language.bitext().sentence(session).iter().map(|&word| language.words().text(word)).collect::<Vec<_>>().join(" ");
    (0..language.bitext().sessions() as u16).map(text).collect()
}

#[test]
fn two_robots_that_learned_half_the_course_each_know_all_of_it_together() {
    let lessons = school::lessons();
    // The second one met the words, the objects and the colours in another order.
    let first = model(&[&lessons[0], &lessons[1], &lessons[4]], Options::PAPER, 6);
    let second = model(&[&lessons[6], &lessons[5], &lessons[3], &lessons[2]], Options::PAPER, 6);
    let mut memory = HeapMemory::new(&ROOMY);
    let mut agent = agent(&mut memory, Options::PAPER);
    agent.restore(&first).unwrap();
    assert_eq!(agent.join(&second), Ok(4));
    agent.learn_fully();
    let said: Vec<&str> = [0, 1, 4, 6, 5, 3, 2].map(|lesson: usize| lessons[lesson].command.as_str()).to_vec();
    assert_eq!(commands(&agent), said);
    assert_eq!(agent.language().words().len(), 12);
    assert_eq!(tests_passed(&mut agent), 5);
}

#[test]
fn a_common_past_is_kept_once_wherever_it_stands() {
    let lessons = school::lessons();
    // The role model keeps whole words and treats words with the same beginning as one; Model 2 cuts them, or keeps them whole.
    for options in [Options::PAPER, Options { language: Settings::SMOOTHED, ..Options::PAPER }, Options::DEFAULT] {
        let past = model(&[&lessons[0], &lessons[5]], options, 1);
        let one = grown(&past, &[&lessons[2]], 2);
        let other = grown(&past, &[&lessons[3]], 3);
        let mut memory = HeapMemory::new(&ROOMY);
        let mut agent = agent(&mut memory, Options::PAPER);
        agent.restore(&one).unwrap();
        let here = commands(&agent);
        assert_eq!(agent.join(&other), Ok(1), "{options:?}");
        let joined = commands(&agent);
        assert_eq!((joined.len(), &joined[..3]), (4, here.as_slice()));
        // Joining again adds nothing, though the common sessions now have other positions.
        assert_eq!(agent.join(&other), Ok(0));
        assert_eq!(agent.join(&one), Ok(0));
        agent.learn_fully();
        assert_eq!(commands(&agent), joined);
    }
}

#[test]
fn what_was_taught_twice_counts_twice() {
    let lessons = school::lessons();
    // Without any doubt left, both sessions have the same weights to the last bit.
    let sure = Options { least_weight: 0.5, ..Options::PAPER };
    let twice = model(&[&lessons[0], &lessons[0], &lessons[0]], sure, 1);
    let mut memory = HeapMemory::new(&ROOMY);
    let mut agent = agent(&mut memory, sure);
    agent.restore(&model(&[&lessons[0]], sure, 1)).unwrap();
    let added = agent.join(&twice).unwrap();
    agent.learn_fully();
    assert_eq!(added, 2);
    assert_eq!(commands(&agent).len(), 3);
}

#[test]
fn whole_words_are_cut_to_those_that_count_here_and_cut_words_are_refused_where_whole_ones_count() {
    let lessons = school::lessons();
    let cut = Options { language: Settings { word_letters: 4, ..Settings::PAPER }, ..Options::PAPER };
    let (whole_words, cut_words) = (model(&[&lessons[4]], Options::PAPER, 1), model(&[&lessons[5]], cut, 1));
    let mut memory = HeapMemory::new(&ROOMY);
    let mut robot = agent(&mut memory, cut);
    robot.restore(&cut_words).unwrap();
    assert_eq!(robot.join(&whole_words), Ok(1));
    robot.learn_fully();
    assert_eq!(commands(&robot), ["take the purp bag to the blue room", "take the blue chai to the yell room"]);
    let mut memory = HeapMemory::new(&ROOMY);
    let mut robot = agent(&mut memory, Options::PAPER);
    robot.restore(&whole_words).unwrap();
    robot.learn_fully();
    let before = saved(&robot);
    assert_eq!(robot.join(&cut_words), Err(RestoreError::OtherForms));
    assert!(saved(&robot) == before);
}

#[test]
fn machine_commands_of_another_order_are_refused() {
    let lessons = school::lessons();
    let beside = Options { language: Settings { order: Settings::SMOOTHED.order, ..Settings::PAPER }, ..Options::PAPER };
    let mut memory = HeapMemory::new(&ROOMY);
    let mut robot = agent(&mut memory, Options::PAPER);
    assert_eq!(robot.join(&model(&[&lessons[0]], beside, 1)), Err(RestoreError::OtherForms));
    assert_eq!(robot.join(&model(&[], beside, 1)), Ok(0), "a model that has learned nothing says nothing in another way");
}

#[test]
fn other_settings_of_training_stay_those_of_here() {
    let lessons = school::lessons();
    let smooth = Options { language: Settings { smoothing: 0.5, rounds: 3, ..Settings::PAPER }, ..Options::PAPER };
    let mut memory = HeapMemory::new(&ROOMY);
    let mut robot = agent(&mut memory, Options::PAPER);
    assert_eq!(robot.join(&model(&[&lessons[0]], smooth, 1)), Ok(1));
    assert_eq!(*robot.options(), Options::PAPER);
}

#[test]
fn what_both_together_have_no_room_for_is_refused_by_the_capacitys_name() {
    let lessons = school::lessons();
    let mut memory = HeapMemory::new(&Capacities { sessions: 2, ..Capacities::SMALL });
    let mut robot = agent(&mut memory, Options::PAPER);
    robot.restore(&model(&[&lessons[0]], Options::PAPER, 1)).unwrap();
    robot.learn_fully();
    let before = saved(&robot);
    let full = robot.join(&model(&[&lessons[1], &lessons[2]], Options::PAPER, 1));
    assert!(matches!(full, Err(RestoreError::Capacity(error)) if error.capacity == Capacity::Sessions));
    robot.learn_fully();
    assert!(saved(&robot) == before);
}

#[test]
fn a_model_that_fills_the_memory_joins_itself() {
    let lessons = school::lessons();
    let model = model(&lessons.iter().collect::<Vec<_>>(), Options::PAPER, 1);
    let contents = goodbot::snapshot::Contents::read(&model).unwrap();
    let words = contents.words.len();
    let exactly =
        Capacities { words, sessions: contents.sessions.len(), pairs: contents.pairs.len(), commands: contents.commands.len(), ..ROOMY };
    let mut memory = HeapMemory::new(&exactly);
    let mut robot = agent(&mut memory, Options::PAPER);
    robot.restore(&model).unwrap();
    assert_eq!(robot.join(&model), Ok(0));
}
