//! The run: lessons, then tests.

use crate::digest::Digest;
use crate::lessons::{LESSONS, Lesson, TESTS, home};
use goodbot::capacity::CapacityError;
use goodbot::feedback::{SimulatedTrainer, Strategy};
use goodbot::home::{self, BLOCK, HomeError, HomeMemory, ROOM};
use goodbot::memory::Memory;
use goodbot::oomdp::objects::ObjectMemory;
use goodbot::oomdp::{Domain, ObjectId, apply};
use goodbot::planning::{OptimalSet, Progress};
use goodbot::task::TaskTextError;
use goodbot::{Agent, AgentError, Options};
use rand_pcg::Pcg32;

/// The most steps of a lesson.
const MOST_STEPS: u32 = 300;
/// The simulated trainer ends the lesson when the robot has stood still this often where it should be.
const STILL: u32 = 3;

/// A part of the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// Building the home.
    Build,
    /// Hearing a command.
    Hear,
    /// Planning for all tasks from one state, to the end.
    Plan,
    /// Choosing an action.
    Decide,
    /// Taking in the feedback.
    Feedback,
    /// Weighing the session's machine commands.
    Finish,
    /// One round of expectation maximisation.
    Round,
}

impl Work {
    /// All parts.
    pub const ALL: [Self; 7] = [Self::Build, Self::Hear, Self::Plan, Self::Decide, Self::Feedback, Self::Finish, Self::Round];
}

/// Looks on.
pub trait Watch {
    /// The work begins.
    fn begin(&mut self) {}

    /// The work that began last has ended; it was for the lesson or test of this number, the seven lessons first.
    fn end(&mut self, _work: Work, _lesson: usize) {}
}

/// Looks away.
impl Watch for () {}

/// How the run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// Tests of five whose command was understood.
    pub passed: u32,
    /// Actions of all lessons together.
    pub steps: u32,
    /// All posteriors, after every feedback and on hearing every command.
    pub digest: Digest,
}

/// Why a run could not go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunError {
    /// The agent refused.
    Agent(AgentError),
    /// The home refused.
    Home(HomeError),
    /// The tasks are not those of a home.
    Task(TaskTextError),
    /// The intended task is not among those of the session.
    Intention,
}

impl From<AgentError> for RunError {
    fn from(error: AgentError) -> Self {
        Self::Agent(error)
    }
}

impl From<CapacityError> for RunError {
    fn from(error: CapacityError) -> Self {
        Self::Agent(error.into())
    }
}

impl From<HomeError> for RunError {
    fn from(error: HomeError) -> Self {
        Self::Home(error)
    }
}

impl From<TaskTextError> for RunError {
    fn from(error: TaskTextError) -> Self {
        Self::Task(error)
    }
}

/// Runs the whole course in this memory.
///
/// # Errors
/// [`RunError`]: where the memory is too small, mostly.
pub fn run(memory: Memory<'_>, seed: u64, watch: &mut impl Watch) -> Result<Outcome, RunError> {
    let Memory { home: mut home_memory, agent } = memory;
    let mut agent = Agent::new(agent, &home::paper_tasks()?, Options::PAPER)?;
    let mut outcome = Outcome { passed: 0, steps: 0, digest: Digest::EMPTY };
    let mut random = Pcg32::new(seed, 0);
    for (number, lesson) in LESSONS.iter().enumerate() {
        outcome.steps = outcome.steps.wrapping_add(train(&mut agent, lent(&mut home_memory), lesson, number, &mut random, &mut outcome.digest, watch)?);
    }
    for (number, test) in TESTS.iter().enumerate() {
        let number = LESSONS.len().wrapping_add(number);
        watch.begin();
        let (home, start) = home(test, lent(&mut home_memory))?;
        watch.end(Work::Build, number);
        watch.begin();
        agent.hear(&home, &start, test.command)?;
        watch.end(Work::Hear, number);
        take(&agent, &mut outcome.digest);
        let intended = intention(&agent, &home, test)?;
        let best = (0..agent.tasks().len()).filter(|&task| task != intended);
        let right = agent.belief().probability(intended);
        let understood = best.map(|task| agent.belief().probability(task)).all(|other| other < right);
        outcome.passed = outcome.passed.wrapping_add(u32::from(understood));
        agent.forget();
    }
    Ok(outcome)
}

fn train(
    agent: &mut Agent<'_>,
    memory: HomeMemory<'_>,
    lesson: &Lesson,
    number: usize,
    random: &mut Pcg32,
    digest: &mut Digest,
    watch: &mut impl Watch,
) -> Result<u32, RunError> {
    let trainer = SimulatedTrainer { strategy: Strategy::BALANCED };
    watch.begin();
    let (home, start) = home(lesson, memory)?;
    watch.end(Work::Build, number);
    let mut state = start;
    watch.begin();
    agent.hear(&home, &start, lesson.command)?;
    watch.end(Work::Hear, number);
    take(agent, digest);
    let intended = intention(agent, &home, lesson)?;
    let (mut steps, mut still) = (0_u32, 0_u32);
    while steps < MOST_STEPS && still < STILL {
        watch.begin();
        agent.plan_fully(&home, &state)?;
        watch.end(Work::Plan, number);
        let plan = agent.search().optimal(intended);
        if matches!(plan, OptimalSet::DeadEnd(_)) {
            break;
        }
        watch.begin();
        let decision = agent.decide(Some(&mut *random))?;
        watch.end(Work::Decide, number);
        let correct = plan.actions().is_some_and(|actions| actions.contains(decision.action));
        let feedback = trainer.feedback(correct, random);
        watch.begin();
        agent.feedback(decision.action, feedback)?;
        watch.end(Work::Feedback, number);
        take(agent, digest);
        state = apply(&home, &state, decision.action).unwrap_or(state);
        still = if plan == OptimalSet::Goal && correct { still.wrapping_add(1) } else { 0 };
        steps = steps.wrapping_add(1);
    }
    watch.begin();
    agent.finish(&home)?;
    watch.end(Work::Finish, number);
    learn(agent, number, watch);
    Ok(steps)
}

/// Learns to the end, round by round.
fn learn(agent: &mut Agent<'_>, number: usize, watch: &mut impl Watch) {
    watch.begin();
    let mut round = agent.language().training().round();
    while agent.learn(1) == Progress::Working {
        if agent.language().training().round() != round {
            round = agent.language().training().round();
            watch.end(Work::Round, number);
            watch.begin();
        }
    }
    watch.end(Work::Round, number);
}

/// Which of the session's tasks the lesson means.
fn intention<D: Domain>(agent: &Agent<'_>, domain: &D, lesson: &Lesson) -> Result<usize, RunError> {
    let nth = |class, position: usize| domain.objects().of_class(class).nth(position);
    let room = nth(ROOM, lesson.room);
    let lifted = u8::from(lesson.block.is_some());
    let is_meant = |bindings: &[ObjectId]| {
        bindings.get(1).copied() == room && lesson.block.is_none_or(|block| bindings.first().copied() == nth(BLOCK, block))
    };
    agent.tasks().iter().position(|task| task.lifted == lifted && is_meant(&task.bindings)).ok_or(RunError::Intention)
}

fn take(agent: &Agent<'_>, digest: &mut Digest) {
    for task in 0..agent.tasks().len() {
        digest.take(agent.belief().probability(task));
    }
}

/// The same memory, for one home.
fn lent<'a>(memory: &'a mut HomeMemory<'_>) -> HomeMemory<'a> {
    HomeMemory {
        objects: ObjectMemory {
            objects: memory.objects.objects,
            name_bytes: memory.objects.name_bytes,
            name_ends: memory.objects.name_ends,
        },
        areas: memory.areas,
        places: memory.places,
    }
}
