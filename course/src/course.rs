//! The whole course: seven lessons, each learned from, then five tests without learning.

use crate::error::CourseError;
use crate::exercise::{Exercise, LESSONS, TESTS};
use crate::layout::Homes;
use crate::lesson::{Ending, FeedbackCounts, LessonReport, Step, run_lesson};
use crate::trainer::Trainer;
use goodbot::feedback::Strategy;
use goodbot::home::{Home, HomeState};
use goodbot::memory::{AgentMemory, HomeMemory};
use goodbot::{Agent, AgentError};
use rand_core::Rng;

/// The view of an observer at any time.
#[derive(Debug)]
pub struct Scene<'a, H, M> {
    /// The lesson or test, from 0.
    pub number: usize,
    /// The command and its meaning.
    pub exercise: &'static Exercise,
    /// The home.
    pub home: &'a Home<H>,
    /// The present state.
    pub state: &'a HomeState,
    /// The agent.
    pub agent: &'a Agent<M>,
    /// The intended task, by its position among those of the session.
    pub intended: usize,
}

/// An observer of a course. Every method may be left out.
pub trait Observer {
    /// A lesson begins: the agent has heard the command.
    fn lesson_begins(&mut self, _scene: &Scene<'_, impl HomeMemory, impl AgentMemory>) {}
    /// The agent has acted and used the feedback; the scene's state is the one before the action.
    fn acted(&mut self, _scene: &Scene<'_, impl HomeMemory, impl AgentMemory>, _step: &Step) {}
    /// A lesson is over and learned from.
    fn lesson_ends(&mut self, _number: usize, _agent: &Agent<impl AgentMemory>, _report: &LessonReport) {}
    /// The agent has heard a test's command.
    fn tested(&mut self, _scene: &Scene<'_, impl HomeMemory, impl AgentMemory>, _report: &TestReport) {}
}

impl Observer for () {}

/// The result of a test.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TestReport {
    /// Whether the most likely task is the intended one.
    pub right: bool,
    /// The most likely task.
    pub task: usize,
    /// The probability of the intended task.
    pub probability: f32,
}

/// The result of a course.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Results {
    /// The lessons.
    pub lessons: [LessonReport; LESSONS.len()],
    /// The tests.
    pub tests: [TestReport; TESTS.len()],
}

impl Results {
    /// The trainer's words in all lessons together.
    pub fn feedback(&self) -> FeedbackCounts {
        self.lessons.iter().fold(FeedbackCounts::default(), |sum, lesson| sum.plus(lesson.feedback))
    }

    /// Whether every test was right.
    pub fn all_tests_right(&self) -> bool {
        self.tests.iter().all(|test| test.right)
    }
}

const UNFINISHED: LessonReport =
    LessonReport { understood: false, ending: Ending::TooLong, steps: 0, feedback: FeedbackCounts { reward: 0, punish: 0, neutral: 0 } };

/// Trains an agent through the lessons and tests it. The agent assumes that the trainer follows the strategy `believed`.
///
/// # Errors
/// [`CourseError`].
pub fn run_course<R: Rng + ?Sized>(
    agent: &mut Agent<impl AgentMemory>,
    memory: &mut impl HomeMemory,
    homes: &Homes,
    trainer: &impl Trainer,
    believed: Strategy,
    random: &mut R,
    observer: &mut impl Observer,
) -> Result<Results, CourseError> {
    agent.set_strategies(&[(believed, 1.0)])?;
    let mut results = Results { lessons: [UNFINISHED; LESSONS.len()], tests: [TestReport::default(); TESTS.len()] };
    for (number, (exercise, report)) in LESSONS.iter().zip(&mut results.lessons).enumerate() {
        let (home, start) = homes.layout(exercise.home).build(&mut *memory)?;
        *report = run_lesson(agent, &home, &start, exercise, trainer, random, |agent, state, lesson, step| {
            let scene = Scene { number, exercise, home: &home, state, agent, intended: lesson.intended() };
            match step {
                Some(step) => observer.acted(&scene, step),
                None => observer.lesson_begins(&scene),
            }
        })?;
        observer.lesson_ends(number, agent, report);
    }
    let (home, start) = homes.test.build(&mut *memory)?;
    for (number, (exercise, report)) in TESTS.iter().zip(&mut results.tests).enumerate() {
        let intended = exercise.pose(agent, &home, &start)?.ok_or(CourseError::NotPosed)?;
        let task = agent.most_likely_with(random).ok_or(CourseError::Agent(AgentError::NoTask))?;
        *report = TestReport { right: task == intended, task, probability: agent.belief().probability(intended) };
        observer.tested(&Scene { number, exercise, home: &home, state: &start, agent, intended }, report);
        agent.forget();
    }
    Ok(results)
}
