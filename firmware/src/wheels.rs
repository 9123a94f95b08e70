//! The paper's lessons on two wheels that slip, on a microcontroller: odometry to cells, actions to wheel speeds, and what sensors tell as
//! the truth. Exits with 0 where no wall was touched, the world was no kind one, and the tests pass.

#![no_std]
#![no_main]

#[allow(dead_code, reason = "nothing is counted here")]
mod board;
mod fault;
mod memory;
#[allow(dead_code, reason = "only the course reports its stack")]
mod stack;

use board::report;
use goodbot::feedback::{Feedback, Strategy};
use goodbot::memory::{AgentMemory, HomeMemory};
use goodbot::oomdp::Action;
use goodbot::planning::{OptimalSet, Progress};
use goodbot::{Agent, Options, home};
use goodbot_course::{CourseTrainer, Exercise, Homes, LESSONS, TESTS, Trainer, generator};
use goodbot_drill::SEED;
use goodbot_drive::simulation::World;
use rand_core::Rng;

static mut MEMORY: memory::RobotMemory = memory::RobotMemory::new();

/// The most actions of one lesson, and how often the robot rests at the goal before it counts as there.
const MOST_ACTIONS: u32 = 300;
const RESTS: u32 = 3;
/// One action in so many fails, at least: otherwise nothing is tried.
const FAIL: u32 = 30;

/// What the lessons came to.
#[derive(Default)]
struct Tally {
    actions: u32,
    /// Actions after which the robot stood elsewhere than planned.
    failed: u32,
    walls_hit: u32,
    right: u32,
}

#[cortex_m_rt::entry]
fn main() -> ! {
    // SAFETY: this function runs once, and nothing else touches the static.
    let memory = unsafe { &mut *(&raw mut MEMORY) };
    let mut tally = Tally::default();
    let done = course(&mut memory.home, &mut memory.agent, &mut tally).is_some();
    for (name, number) in [
        ("actions", tally.actions),
        ("failed", tally.failed),
        ("walls-hit", tally.walls_hit),
        ("right", tally.right),
        ("tests", TESTS.len() as u32),
    ] {
        report(name, number);
    }
    let tried = tally.failed > tally.actions / FAIL;
    board::exit(if done && tried && tally.walls_hit == 0 && tally.right == TESTS.len() as u32 { 0 } else { 1 })
}

/// All lessons and tests; nothing where a call was refused.
fn course(rooms: &mut impl HomeMemory, agent: impl AgentMemory, tally: &mut Tally) -> Option<()> {
    let mut made = Agent::new(agent, &home::paper_tasks().ok()?, Options::DEFAULT);
    let agent = made.as_mut().ok()?;
    agent.set_strategies(&[(Strategy::BALANCED, 1.0)]).ok()?;
    let mut random = generator(SEED);
    for exercise in &LESSONS {
        lesson(agent, rooms, exercise, &mut random, tally)?;
    }
    let (home, start) = Homes::FIXED.test.build(rooms).ok()?;
    for exercise in &TESTS {
        agent.hear(&home, &start, exercise.command).ok()?;
        let intended = exercise.intention.find(agent, &home);
        tally.right = tally.right.saturating_add(u32::from(intended.is_some() && agent.most_likely() == intended));
        agent.forget();
    }
    Some(())
}

#[inline(never)]
fn lesson<R: Rng>(
    agent: &mut Agent<impl AgentMemory>,
    rooms: &mut impl HomeMemory,
    exercise: &Exercise,
    random: &mut R,
    tally: &mut Tally,
) -> Option<()> {
    let (home, mut state) = Homes::FIXED.layout(exercise.home).build(rooms).ok()?;
    agent.hear(&home, &state, exercise.command).ok()?;
    let intended = exercise.intention.find(agent, &home)?;
    let mut world = World::new(&home, &state).ok()?;
    let mut rests = 0;
    for _ in 0..MOST_ACTIONS {
        while agent.plan(&home, &state, u32::MAX).ok()? == Progress::Working {}
        let right = agent.planned().optimal(intended);
        if rests == RESTS || matches!(right, OptimalSet::DeadEnd(_)) {
            break;
        }
        let decision = agent.decide_by(&home, &state, random).ok()?;
        let correct = right.exact().or(right.onward()).is_some_and(|actions| actions.contains(decision.action));
        rests = if right == OptimalSet::Goal && decision.action == Action::NOOP { rests.saturating_add(1) } else { 0 };
        let expected = agent.acted(&home, &state, decision.action).ok()?;
        if expected != state {
            world.act(&home, decision.action, agent.belief().probability(decision.task), random).ok()?;
        }
        let feedback: Feedback = CourseTrainer::BALANCED.feedback(correct, random);
        let _ = agent.feedback(feedback).ok()?;
        // Where things are is sensed, and not taken from what the action should have done.
        state = world.sensed(&home, &state);
        tally.actions = tally.actions.saturating_add(1);
        tally.failed = tally.failed.saturating_add(u32::from(state != expected));
    }
    let _ = agent.finish(&home).ok()?;
    while agent.learn(u32::MAX) == Progress::Working {}
    tally.walls_hit = tally.walls_hit.saturating_add(world.walls_hit);
    Some(())
}
