//! One agent with one trainer: lessons, each with training after it, then tests.
//!
//! Chance comes from four generators of the seed: for the homes, the trainer's person, the trainer's feedback, and the agent. So all agents
//! meet the same homes and the same people.

use super::agent::{Learner, Learns, Now};
use super::course::{Course, Place};
use super::trainer::{Habits, Listening, answer};
use goodbot::AgentError;
use goodbot::feedback::Feedback;
use goodbot::home::HomeState;
use goodbot::oomdp::{Action, ActionSet, apply};
use goodbot::planning::OptimalSet;
use goodbot_course::generator;
use rand_pcg::Pcg32;
use std::fmt;

/// The lesson ends after this many rests in a row at the intended goal.
pub const RESTS: u8 = 3;
/// The trainer gives up a lesson after this many steps.
pub const MOST_STEPS: u16 = 150;
/// A test ends after this many steps.
pub const TEST_STEPS: u16 = 100;
/// An agent is certain above this probability.
pub const CERTAIN: f32 = 0.95;

/// Why a lesson ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The agent rests at the intended goal.
    Goal,
    /// The intended task has become impossible.
    DeadEnd,
    /// It took too long.
    TooLong,
    /// The trainer left, though the goal was not reached.
    Left,
}

impl Ending {
    /// All endings.
    pub const ALL: [Self; 4] = [Self::Goal, Self::DeadEnd, Self::TooLong, Self::Left];

    /// Its name in output.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Goal => "goal",
            Self::DeadEnd => "dead end",
            Self::TooLong => "too long",
            Self::Left => "left",
        }
    }
}

/// The result of a lesson.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LessonOutcome {
    /// Why it ended.
    pub ending: Ending,
    /// The number of steps.
    pub steps: u16,
    /// How often the trainer said something: "good bot", "bad bot", or an answer.
    pub words: u16,
    /// How many questions it answered.
    pub answers: u16,
    /// Whether the agent was ever certain of a wrong task.
    pub wrongly_certain: bool,
}

/// The result of a test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TestOutcome {
    /// Whether the agent did the intended task, and then rested.
    pub right: bool,
    /// Whether it was certain of a wrong task when it heard the command.
    pub wrongly_certain: bool,
}

/// The result of one agent with one trainer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// The lessons.
    pub lessons: Vec<LessonOutcome>,
    /// The tests.
    pub tests: Vec<TestOutcome>,
}

impl Outcome {
    /// How many tests were right.
    pub fn tests_right(&self) -> usize {
        self.tests.iter().filter(|test| test.right).count()
    }

    /// The steps of each lesson; a lesson that did not end at the goal counts as the most steps.
    pub fn steps(&self) -> impl Iterator<Item = u16> + '_ {
        self.lessons.iter().map(|lesson| if lesson.ending == Ending::Goal { lesson.steps } else { MOST_STEPS })
    }
}

/// The purpose of a generator.
#[derive(Clone, Copy, Debug)]
enum Chance {
    Words = 2,
    Agent = 3,
}

/// A generator that is independent of those with the same seed for other purposes.
fn chance(seed: u64, purpose: Chance) -> Pcg32 {
    generator(seed.wrapping_mul(0x2545_f491_4f6c_dd1d).wrapping_add(purpose as u64))
}

/// The homes and commands of a seed, with all plans made in them: every agent meets the same.
#[derive(Debug)]
pub struct CoursePlaces {
    lessons: Vec<Place>,
    tests: Vec<Place>,
}

impl CoursePlaces {
    /// The places of a course.
    ///
    /// # Errors
    /// [`StudyError`].
    pub fn new(course: Course, seed: u64) -> Result<Self, StudyError> {
        let [lessons, tests] = course.exercises(seed)?;
        Ok(Self { lessons: Place::all(&lessons)?, tests: Place::all(&tests)? })
    }
}

/// Takes an agent through a course, with a trainer of these habits.
///
/// # Errors
/// [`StudyError`].
pub fn run(learns: &Learns, habits: Habits, places: &mut CoursePlaces, seed: u64) -> Result<Outcome, StudyError> {
    let mut words = chance(seed, Chance::Words);
    let mut learner = learns.begin(chance(seed, Chance::Agent))?;
    let mut lesson = |place| lesson(&mut *learner, place, habits, &mut words);
    let lessons = places.lessons.iter_mut().map(&mut lesson).collect::<Result<_, _>>()?;
    let tests = places.tests.iter_mut().map(|place| test(&mut *learner, place)).collect::<Result<_, _>>()?;
    Ok(Outcome { lessons, tests })
}

/// The rightness of an action for the intended task, and the next state.
struct Step {
    correct: bool,
    at_goal: bool,
    next: HomeState,
}

/// Lets the agent act; `None` if the intended task has become impossible.
fn act(learner: &mut dyn Learner, place: &mut Place, state: &HomeState, is_test: bool) -> Result<Option<(Action, Step)>, StudyError> {
    let outlook = place.outlook(state)?;
    let meant = outlook.optimal[place.intended];
    if matches!(meant, OptimalSet::DeadEnd(_)) {
        return Ok(None);
    }
    let action = learner.act(&Now { place, state, outlook: &outlook, is_test })?;
    let next = apply(&place.home, state, action).ok_or(AgentError::NotApplicable)?;
    // The trainer accepts an approximate plan as the shortest.
    let right = meant.exact().or(meant.onward()).unwrap_or(ActionSet::EMPTY);
    Ok(Some((action, Step { correct: right.contains(action), at_goal: meant == OptimalSet::Goal, next })))
}

/// Lets the agent ask until it has no more questions. Returns how many were answered. The trainer answers with its own error; one who never
/// speaks does not answer.
fn ask(learner: &mut dyn Learner, place: &mut Place, state: &HomeState, habits: &Habits, random: &mut Pcg32) -> Result<u16, StudyError> {
    let Some(mistaken) = habits.mistaken() else { return Ok(0) };
    let outlook = place.outlook(state)?;
    let now = Now { place, state, outlook: &outlook, is_test: false };
    let mut answers = 0;
    while let Some(question) = learner.asks(&now)? {
        learner.answered(answer(&question, place.intended, mistaken, random))?;
        answers += 1;
    }
    Ok(answers)
}

/// Whether the agent is certain of a wrong task.
fn is_wrongly_certain(learner: &dyn Learner, place: &Place) -> bool {
    learner.belief().iter().enumerate().any(|(task, &probability)| task != place.intended && probability > CERTAIN)
}

fn lesson(learner: &mut dyn Learner, place: &mut Place, habits: Habits, random: &mut Pcg32) -> Result<LessonOutcome, StudyError> {
    let mut trainer = Listening::new(habits);
    learner.hear(place)?;
    let mut state = place.start;
    let (mut rests, mut steps, mut words, mut answers) = (0, 0, 0, 0);
    let mut wrongly_certain = is_wrongly_certain(learner, place);
    let ending = loop {
        if steps >= MOST_STEPS {
            break Ending::TooLong;
        }
        answers += ask(learner, place, &state, &habits, random)?;
        let Some((action, step)) = act(learner, place, &state, false)? else { break Ending::DeadEnd };
        let word = trainer.says(step.correct, random);
        learner.told(word)?;
        steps += 1;
        words += u16::from(word != Feedback::Neutral);
        wrongly_certain = wrongly_certain || is_wrongly_certain(learner, place);
        rests = if step.at_goal && action == Action::NOOP { rests + 1 } else { 0 };
        if rests == RESTS {
            break Ending::Goal;
        }
        state = step.next;
        if trainer.leaves(step.at_goal, random) {
            break if step.at_goal { Ending::Goal } else { Ending::Left };
        }
    };
    learner.finish(place)?;
    Ok(LessonOutcome { ending, steps, words: words + answers, answers, wrongly_certain })
}

fn test(learner: &mut dyn Learner, place: &mut Place) -> Result<TestOutcome, StudyError> {
    learner.hear(place)?;
    let wrongly_certain = is_wrongly_certain(learner, place);
    let mut state = place.start;
    let (mut rests, mut steps) = (0, 0);
    while rests < RESTS && steps < TEST_STEPS {
        let Some((action, step)) = act(learner, place, &state, true)? else { break };
        rests = if step.at_goal && action == Action::NOOP { rests + 1 } else { 0 };
        state = step.next;
        steps += 1;
    }
    Ok(TestOutcome { right: rests == RESTS, wrongly_certain })
}

/// Why a run could not continue: an agent, a home or a language program failed.
#[derive(Debug)]
pub struct StudyError(pub String);

impl<E: std::error::Error> From<E> for StudyError {
    fn from(error: E) -> Self {
        Self(error.to_string())
    }
}

impl fmt::Display for StudyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}
