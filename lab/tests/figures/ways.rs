//! How robots learn commands with a way from reward and punishment: through a room, through one of two, or around one.
//!
//! `GOODBOT_ROBOTS=20 cargo test -p goodbot-lab --test figures ways:: -- --nocapture` prints the figures of docs/how-it-works.md. Each lesson of a
//! robot without words has a new home of three storeys, and the paper's balanced trainer. A test has commands in homes of its own, without
//! feedback; a command is right if the most probable of about 50 tasks is the intended one.

mod exercise;

use crate::robots;
use exercise::{Exercise, ThreeStoreys};
use goodbot::asking::Asking;
use goodbot::feedback::Strategy;
use goodbot::home::{AGENT_IN_ROOM, SCHEMA, with_routes};
use goodbot::task::LiftedTask;
use goodbot::{Agent, AgentError, Capacities, HeapMemory, Options};
use goodbot_course::{CourseTrainer, Lesson, Turn, generator};
use goodbot_lab::calibration::Mean;
use goodbot_lab::study::trainer::answer;
use rayon::prelude::*;

const LESSONS: usize = 30;
/// A robot is tested before the first lesson, and after each this many lessons.
const EVERY: usize = 10;
/// The number of commands in a test.
const COMMANDS: usize = 20;

/// The results of one robot.
#[derive(Clone, Debug, Default)]
struct Learned {
    /// Commands understood in each test.
    right: Vec<usize>,
    /// Steps of all lessons.
    steps: usize,
    /// Words of reward and punishment in all lessons.
    words: usize,
    /// Questions in all lessons.
    questions: usize,
}

/// Trains one robot, each lesson in a new home, with the paper's balanced trainer.
fn simulate(memory: &mut HeapMemory, lifted: &[LiftedTask], asking: Asking, seed: u64) -> Result<Learned, AgentError> {
    let mut random = generator(seed);
    // Tests are drawn separately, so that they are the same with and without questions.
    let mut drawn = generator(seed ^ TESTS);
    let mut agent = Agent::new(&mut memory.agent, lifted, Options::DEFAULT)?;
    agent.set_strategies(&[(Strategy::BALANCED, 1.0)])?;
    let mut learned = Learned::default();
    for lesson in 0..=LESSONS {
        if lesson % EVERY == 0 || lesson == LESSONS {
            let mut right = 0;
            for _ in 0..COMMANDS {
                let home = ThreeStoreys::random(&mut memory.home, &mut drawn).expect("a home");
                let exercise = Exercise::random(&home, &mut drawn);
                agent.hear(&home.home, &home.start, &exercise.command)?;
                let meant = exercise.find(&agent, &home);
                right += usize::from(meant.is_some() && agent.most_likely() == meant);
            }
            learned.right.push(right);
        }
        if lesson == LESSONS {
            break;
        }
        let home = ThreeStoreys::random(&mut memory.home, &mut random).expect("a home");
        let exercise = Exercise::random(&home, &mut random);
        agent.hear(&home.home, &home.start, &exercise.command)?;
        let meant = exercise.find(&agent, &home).expect("a task of the home");
        let mut under_way = Lesson::meaning(&home.start, meant);
        let report = loop {
            let state = *under_way.state();
            agent.plan_fully(&home.home, &state)?;
            while let Some(question) = agent.question(&home.home, &state, &asking)? {
                learned.questions += 1;
                let _ = agent.answer(answer(&question, meant, asking.eta, &mut random))?;
            }
            if let Turn::Ended(ending) = under_way.act(&mut agent, &home.home, &CourseTrainer::BALANCED, &mut random).expect("a step") {
                break under_way.report(ending);
            }
        };
        let _ = agent.finish(&home.home)?;
        agent.learn_fully();
        learned.steps += usize::from(report.steps);
        learned.words += (report.feedback.reward + report.feedback.punish) as usize;
    }
    Ok(learned)
}

/// Separates the seed of the tests from that of the lessons.
const TESTS: u64 = 0x7e57_7e57_7e57_7e57;

#[test]
fn robots_that_ask_learn_ways_sooner_than_those_that_never_do() {
    let lifted = with_routes(&[LiftedTask::single(AGENT_IN_ROOM, &SCHEMA).expect("a task")]).expect("four kinds").to_vec();
    let robots_learned = [("never asks", Asking::NEVER), ("asks", Asking { kappa: 4.0, ..Asking::DEFAULT })].map(|(name, asking)| {
        let memory = || HeapMemory::new(&Capacities { states: 4_096, hashed_states: 0, ..Capacities::STANDARD });
        let robot = |memory: &mut HeapMemory, run: u64| simulate(memory, &lifted, asking, 1 + run).expect("a robot that learns");
        let learned: Vec<Learned> = (0..robots(2)).into_par_iter().map_init(memory, robot).collect();
        let shares: Vec<f64> = (0..=LESSONS / EVERY)
            .map(|test| {
                let Mean { mean, half } = Mean::of(learned.iter().map(|robot| 100.0 * robot.right[test] as f64 / COMMANDS as f64));
                println!("{name:10} after {:2} lessons: {mean:5.1} % ± {half:4.1} right of {COMMANDS} commands", test * EVERY);
                mean
            })
            .collect();
        let in_a_lesson = |of: fn(&Learned) -> usize| learned.iter().map(of).sum::<usize>() as f64 / (learned.len() * LESSONS) as f64;
        let (steps, words, questions) = (in_a_lesson(|it| it.steps), in_a_lesson(|it| it.words), in_a_lesson(|it| it.questions));
        println!("{name:10} a lesson took {steps:.1} steps, {words:.1} words of feedback, {questions:.2} questions");
        (shares, questions)
    });
    let [(silent, never), (asked, questions)] = robots_learned;
    assert!(never == 0.0 && questions > 0.0);
    assert_eq!(silent[0], asked[0], "the same commands before the first lesson");
    assert!(asked[LESSONS / EVERY] > silent[LESSONS / EVERY] + 30.0, "{asked:?} {silent:?}");
}
