//! "Stop": the trainer's voice, at many moments of a lesson.

use crate::digest::Digest;
use crate::run::{Budget, SEED, Watch};
use goodbot::feedback::Strategy;
use goodbot::home;
use goodbot::memory::{AgentMemory, HomeMemory};
use goodbot::oomdp::Domain;
use goodbot::planning::Progress;
use goodbot::{Agent, Options};
use goodbot_course::exercise::{Exercise, LESSONS};
use goodbot_course::lesson::{Lesson, Turn};
use goodbot_course::{CourseError, Homes, SimulatedTrainer, generator};

/// What came of the stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stops {
    /// How often the robot was stopped.
    pub count: u32,
    /// Whether each stop ended the session at once, nothing was learned, and the command means the same when it is said again.
    pub are_clean: bool,
}

/// Begins the first lesson again and again, and says "stop" after more and more calls: while the robot hears, plans, acts, and ends the lesson, until it
/// is too late, because the lesson joins the training data.
///
/// # Errors
/// [`CourseError`], mostly because the memory is too small.
pub fn stop(mut rooms: impl HomeMemory, agent: impl AgentMemory, budget: Budget, watch: &mut impl Watch) -> Result<Stops, CourseError> {
    let tasks = home::paper_tasks().map_err(|_| CourseError::NotPosed)?;
    // Borrow the `Result`: moving the value out would copy it on the stack.
    let mut made = Agent::new(agent, &tasks, Options::DEFAULT);
    let agent = made.as_mut().map_err(|error| *error)?;
    let exercise = LESSONS.first().ok_or(CourseError::NotPosed)?;
    let (home, start) = Homes::FIXED.layout(exercise.home).build(&mut rooms)?;
    let mut stops = Stops { count: 0, are_clean: true };
    let (mut meant, mut calls) = (None, 0_u32);
    loop {
        let mut now = None;
        if lead(agent, &home, &start, exercise, calls, budget, &mut now)? {
            return Ok(stops);
        }
        watch.begin();
        agent.forget();
        watch.stopped();
        let is_ended = agent.plan(&home, &start, 1).is_err() && agent.finish_on(&home, 1).is_err();
        let is_same = now.is_none() || now == *meant.get_or_insert(now);
        stops.are_clean &= is_ended && is_same && agent.language().bitext().sessions() == 0;
        stops.count = stops.count.wrapping_add(1);
        calls = calls.wrapping_add(calls / 4).wrapping_add(1);
    }
}

/// Leads the lesson for so many calls, at most until it joins the training data: then it is over. `meant` receives all posteriors, once the command
/// is heard.
#[inline(never)]
fn lead<D: Domain>(
    agent: &mut Agent<impl AgentMemory>,
    domain: &D,
    start: &D::State,
    exercise: &Exercise,
    mut calls: u32,
    budget: Budget,
    meant: &mut Option<Digest>,
) -> Result<bool, CourseError> {
    let mut is_time = || {
        calls = calls.wrapping_sub(1);
        calls == u32::MAX
    };
    agent.begin_hearing(domain, start, exercise.command)?;
    loop {
        if is_time() {
            return Ok(false);
        }
        if agent.hear_on(domain, budget.hear)? == Progress::Done {
            break;
        }
    }
    let mut digest = Digest::EMPTY;
    for task in 0..agent.tasks().len() {
        digest.take(agent.belief().probability(task));
    }
    *meant = Some(digest);
    let (trainer, mut random) = (SimulatedTrainer { strategy: Strategy::BALANCED }, generator(SEED));
    let mut lesson = Lesson::heard(agent, domain, start, exercise)?;
    loop {
        loop {
            if is_time() {
                return Ok(false);
            }
            if agent.plan(domain, lesson.state(), budget.plan)? == Progress::Done {
                break;
            }
        }
        if is_time() {
            return Ok(false);
        }
        if let Turn::Ended(_) = lesson.act(agent, domain, &trainer, &mut random)? {
            break;
        }
    }
    agent.begin_finishing(domain)?;
    while !is_time() {
        if agent.finish_on(domain, budget.finish)?.is_some() || agent.is_joining() {
            return Ok(true);
        }
    }
    Ok(false)
}
