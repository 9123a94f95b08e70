//! One robot that learns commands with ways from reward and punishment alone.

use super::exercise::{Exercise, ThreeStoreys};
use crate::questions::simulation::answer;
use goodbot::asking::Asking;
use goodbot::feedback::Strategy;
use goodbot::task::LiftedTask;
use goodbot::{Agent, HeapMemory, Options};
use goodbot_console::outcome::Failure;
use goodbot_course::{CourseTrainer, Lesson, Turn, generator};

/// The settings of the simulation.
#[derive(Clone, Debug)]
pub struct Setting {
    /// The kinds of tasks that commands may mean.
    pub lifted: Vec<LiftedTask>,
    /// When the robot asks.
    pub asking: Asking,
    /// The number of lessons.
    pub lessons: usize,
    /// The robot is tested before the first lesson, and after each this many lessons.
    pub every: usize,
    /// The number of commands in a test.
    pub tests: usize,
}

/// The results of one robot.
#[derive(Clone, Debug, Default)]
pub struct Learned {
    /// Commands understood in each test.
    pub right: Vec<usize>,
    /// Steps of all lessons.
    pub steps: usize,
    /// Words of reward and punishment in all lessons.
    pub words: usize,
    /// Questions in all lessons.
    pub questions: usize,
}

/// Trains one robot, each lesson in a new home, with the paper's balanced trainer.
///
/// # Errors
/// The robot's error.
pub fn simulate(memory: &mut HeapMemory, setting: &Setting, seed: u64) -> Result<Learned, Failure> {
    let mut random = generator(seed);
    // Tests are drawn separately, so that they are the same with and without questions.
    let mut drawn = generator(seed ^ TESTS);
    let mut agent = Agent::new(&mut memory.agent, &setting.lifted, Options::DEFAULT)?;
    agent.set_strategies(&[(Strategy::BALANCED, 1.0)])?;
    let mut learned = Learned::default();
    for lesson in 0..=setting.lessons {
        if lesson % setting.every.max(1) == 0 || lesson == setting.lessons {
            let mut right = 0;
            for _ in 0..setting.tests {
                let home = ThreeStoreys::random(&mut memory.home, &mut drawn).map_err(|error| Failure::Result(error.to_string()))?;
                let exercise = Exercise::random(&home, &mut drawn);
                agent.hear(&home.home, &home.start, &exercise.command)?;
                let meant = exercise.find(&agent, &home);
                right += usize::from(meant.is_some() && agent.most_likely() == meant);
            }
            learned.right.push(right);
        }
        if lesson == setting.lessons {
            break;
        }
        let home = ThreeStoreys::random(&mut memory.home, &mut random).map_err(|error| Failure::Result(error.to_string()))?;
        let exercise = Exercise::random(&home, &mut random);
        agent.hear(&home.home, &home.start, &exercise.command)?;
        let Some(meant) = exercise.find(&agent, &home) else {
            return Err(Failure::Result(format!("no task of the home is what \"{}\" means", exercise.command)));
        };
        let mut under_way = Lesson::meaning(&home.start, meant);
        let report = loop {
            let state = *under_way.state();
            agent.plan_fully(&home.home, &state)?;
            while let Some(question) = agent.question(&home.home, &state, &setting.asking)? {
                learned.questions += 1;
                let _ = agent.answer(answer(&question, meant, setting.asking.eta, &mut random))?;
            }
            match under_way.act(&mut agent, &home.home, &CourseTrainer::BALANCED, &mut random) {
                Ok(Turn::Acted(_)) => {}
                Ok(Turn::Ended(ending)) => break under_way.report(ending),
                Err(error) => return Err(Failure::Result(error.to_string())),
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
