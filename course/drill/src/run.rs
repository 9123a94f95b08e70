//! The run: lessons, then tests.

use crate::digest::Digest;
use goodbot::feedback::{Strategy, binary_entropy};
use goodbot::home;
use goodbot::memory::{AgentMemory, HomeMemory};
use goodbot::oomdp::Domain;
use goodbot::planning::Progress;
use goodbot::{Agent, Options};
use goodbot_course::exercise::{self, Exercise, TESTS};
use goodbot_course::layout::Layout;
use goodbot_course::lesson::{Lesson, Turn};
use goodbot_course::{CourseError, Homes, SimulatedTrainer, generator};

/// How many lessons there are.
pub const LESSONS: usize = exercise::LESSONS.len();
/// The seed of the run that the targets compare.
pub const SEED: u64 = 1;

/// A part of the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// Building the home.
    Build,
    /// Hearing a command: one call.
    Hear,
    /// Planning for all tasks from one state: one call.
    Plan,
    /// One action with its feedback: choosing it, and updating the belief.
    Act,
    /// Ending a session, so that it joins the training data: one call.
    Finish,
    /// Learning: one call.
    Learn,
}

impl Work {
    /// All parts, with the names that they have in output.
    pub const ALL: [(Self, &'static str); 6] = [
        (Self::Build, "build"),
        (Self::Hear, "hear"),
        (Self::Plan, "plan"),
        (Self::Act, "act"),
        (Self::Finish, "finish"),
        (Self::Learn, "learn"),
    ];
}

/// An observer of the run.
pub trait Watch {
    /// The work begins.
    fn begin(&mut self) {}

    /// The work that began last has ended; it was for the lesson or test of this number, the lessons first.
    fn end(&mut self, _work: Work, _number: usize) {}

    /// The work that began last has ended; it was to stop the robot.
    fn stopped(&mut self) {}

    /// A round of expectation maximisation is over.
    fn round(&mut self) {}

    /// A training is over: after its rounds, the kind of task was learned.
    fn trained(&mut self) {}
}

impl Watch for () {}

/// How much work one call may do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// Table cells of hearing a command.
    pub hear: u32,
    /// States of the search.
    pub plan: u32,
    /// Table cells of ending a session.
    pub finish: u32,
    /// Table cells of the training.
    pub learn: u32,
}

impl Budget {
    /// Everything in one call, except learning: it goes in parts of about a word of a pair, so that the end of every round is seen.
    pub const ROUNDS: Self = Self { hear: u32::MAX, plan: u32::MAX, finish: u32::MAX, learn: 64 };
}

/// How the run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// Tests whose command was understood.
    pub passed: u32,
    /// How many tests there are.
    pub tests: u32,
    /// Actions of all lessons together.
    pub steps: u32,
    /// All posteriors: on hearing every command, and after every feedback.
    pub digest: Digest,
}

/// Runs the whole course in this memory.
///
/// # Errors
/// [`CourseError`], mostly because the memory is too small.
pub fn run(
    mut rooms: impl HomeMemory,
    agent: impl AgentMemory,
    seed: u64,
    budget: Budget,
    watch: &mut impl Watch,
) -> Result<Outcome, CourseError> {
    let tasks = home::paper_tasks().map_err(|_| CourseError::NotPosed)?;
    // Borrow the `Result`: moving the value out would copy it on the stack.
    let mut made = Agent::new(agent, &tasks, Options::DEFAULT);
    let agent = made.as_mut().map_err(|error| *error)?;
    let mut outcome = Outcome { passed: 0, tests: TESTS.len() as u32, steps: 0, digest: Digest::EMPTY };
    let mut random = generator(seed);
    for (number, lesson) in exercise::LESSONS.iter().enumerate() {
        train(agent, &mut rooms, (number, lesson), &mut random, &mut outcome, budget, watch)?;
    }
    for (number, test) in TESTS.iter().enumerate() {
        let number = LESSONS.wrapping_add(number);
        watch.begin();
        let (home, start) = Homes::FIXED.test.build(&mut rooms)?;
        watch.end(Work::Build, number);
        hear(agent, &home, &start, (number, test), budget, watch)?;
        take(agent, &mut outcome.digest);
        let understood = test.intention.find(agent, &home) == agent.most_likely_with(&mut random);
        outcome.passed = outcome.passed.wrapping_add(u32::from(understood));
        agent.forget();
    }
    // The logarithm is the only function here that is not made of + - * / alone.
    for part in 0..=64_u8 {
        outcome.digest.take(binary_entropy(f32::from(part) / 64.0));
    }
    Ok(outcome)
}

#[inline(never)]
fn train<R: rand_core::Rng>(
    agent: &mut Agent<impl AgentMemory>,
    rooms: impl HomeMemory,
    (number, exercise): (usize, &Exercise),
    random: &mut R,
    outcome: &mut Outcome,
    budget: Budget,
    watch: &mut impl Watch,
) -> Result<(), CourseError> {
    let trainer = SimulatedTrainer { strategy: Strategy::BALANCED };
    let layout: &Layout = Homes::FIXED.layout(exercise.home);
    watch.begin();
    let (home, start) = layout.build(rooms)?;
    watch.end(Work::Build, number);
    hear(agent, &home, &start, (number, exercise), budget, watch)?;
    let mut lesson = Lesson::heard(agent, &home, &start, exercise)?;
    take(agent, &mut outcome.digest);
    loop {
        loop {
            watch.begin();
            let progress = agent.plan(&home, lesson.state(), budget.plan)?;
            watch.end(Work::Plan, number);
            if progress == Progress::Done {
                break;
            }
        }
        watch.begin();
        let turn = lesson.act(agent, &home, &trainer, random)?;
        watch.end(Work::Act, number);
        if let Turn::Ended(_) = turn {
            break;
        }
        outcome.steps = outcome.steps.wrapping_add(1);
        take(agent, &mut outcome.digest);
    }
    watch.begin();
    agent.begin_finishing(&home)?;
    watch.end(Work::Finish, number);
    loop {
        watch.begin();
        let finished = agent.finish_on(&home, budget.finish)?;
        watch.end(Work::Finish, number);
        if finished.is_some() {
            break;
        }
    }
    loop {
        let round = agent.language().training().round();
        watch.begin();
        let progress = agent.learn(budget.learn);
        watch.end(Work::Learn, number);
        if progress == Progress::Done {
            watch.trained();
            break;
        }
        if agent.language().training().round() != round {
            watch.round();
        }
    }
    Ok(())
}

fn hear<D: Domain>(
    agent: &mut Agent<impl AgentMemory>,
    domain: &D,
    start: &D::State,
    (number, exercise): (usize, &Exercise),
    budget: Budget,
    watch: &mut impl Watch,
) -> Result<(), CourseError> {
    watch.begin();
    agent.begin_hearing(domain, start, exercise.command)?;
    watch.end(Work::Hear, number);
    loop {
        watch.begin();
        let progress = agent.hear_on(domain, budget.hear)?;
        watch.end(Work::Hear, number);
        if progress == Progress::Done {
            return Ok(());
        }
    }
}

fn take(agent: &Agent<impl AgentMemory>, digest: &mut Digest) {
    for task in 0..agent.tasks().len() {
        digest.take(agent.belief().probability(task));
    }
}
