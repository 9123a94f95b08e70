//! The paper's course on wheels: seven lessons acted out in the simulated world, then five commands that are only heard.

use super::World;
use crate::DriveError;
use core::fmt;
use goodbot::Agent;
use goodbot::feedback::Strategy;
use goodbot::memory::{AgentMemory, HomeMemory};
use goodbot_course::lesson::{Lesson, Turn};
use goodbot_course::{CourseError, CourseTrainer, Exercise, Homes, LESSONS, TESTS};
use rand_core::Rng;

/// The totals of courses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Lessons given.
    pub lessons: u32,
    /// Actions of all lessons.
    pub actions: u32,
    /// Actions after which the robot or a block was not in its planned cell.
    pub failed: u32,
    /// Turns of the control loop in which the robot touched a wall.
    pub walls_hit: u32,
    /// Tests with an understood command.
    pub right: u32,
}

/// Why a course on wheels could not continue.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SimulationError {
    /// The course failed.
    Course(CourseError),
    /// The robot could not be driven.
    Drive(DriveError),
}

impl<E: Into<CourseError>> From<E> for SimulationError {
    fn from(error: E) -> Self {
        Self::Course(error.into())
    }
}

impl fmt::Display for SimulationError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Course(error) => error.fmt(out),
            Self::Drive(error) => error.fmt(out),
        }
    }
}

impl core::error::Error for SimulationError {}

/// Runs seven lessons by the paper's balanced trainer, and five tests, and adds them to the tally.
///
/// # Errors
/// [`SimulationError`]: usually the memory is too small.
pub fn course<R: Rng>(
    agent: &mut Agent<impl AgentMemory>,
    rooms: &mut impl HomeMemory,
    random: &mut R,
    tally: &mut Tally,
) -> Result<(), SimulationError> {
    agent.set_strategies(&[(Strategy::BALANCED, 1.0)])?;
    for exercise in &LESSONS {
        lesson(agent, rooms, exercise, random, tally)?;
    }
    let (home, start) = Homes::FIXED.test.build(rooms)?;
    for exercise in &TESTS {
        agent.hear(&home, &start, exercise.command)?;
        let intended = exercise.intention.find(agent, &home);
        tally.right = tally.right.saturating_add(u32::from(intended.is_some() && agent.most_likely() == intended));
        agent.forget();
    }
    Ok(())
}

#[inline(never)]
fn lesson<R: Rng>(
    agent: &mut Agent<impl AgentMemory>,
    rooms: &mut impl HomeMemory,
    exercise: &Exercise,
    random: &mut R,
    tally: &mut Tally,
) -> Result<(), SimulationError> {
    let (home, start) = Homes::FIXED.layout(exercise.home).build(rooms)?;
    let mut world = World::new(&home, &start).map_err(SimulationError::Drive)?;
    let mut lesson = Lesson::begin(agent, &home, &start, exercise)?;
    loop {
        agent.plan_fully(&home, lesson.state())?;
        let before = *lesson.state();
        let mut driven = Ok(());
        let turn = lesson.act_in(agent, &home, &CourseTrainer::BALANCED, random, |agent, decision, expected, random| {
            if expected != before {
                driven = world.act(&home, decision.action, agent.belief().probability(decision.task), random);
            }
            // The state is sensed, not computed from the action.
            let sensed = world.sensed(&home, &before);
            tally.actions = tally.actions.saturating_add(1);
            tally.failed = tally.failed.saturating_add(u32::from(sensed != expected));
            sensed
        })?;
        driven.map_err(SimulationError::Drive)?;
        if let Turn::Ended(_) = turn {
            break;
        }
    }
    let _ = agent.finish(&home)?;
    agent.learn_fully();
    tally.lessons = tally.lessons.saturating_add(1);
    tally.walls_hit = tally.walls_hit.saturating_add(world.walls_hit);
    Ok(())
}
