//! The lessons of the arm.

use crate::arm::Arm;
use crate::commands::{LESSONS, START, intended};
use goodbot::Agent;
use goodbot::feedback::Feedback;
use goodbot::memory::AgentMemory;
use goodbot_course::lesson::{Lesson, Turn};
use goodbot_course::{CourseError, Trainer, generator};

/// Judges every action, without mistakes.
struct Attentive;

impl Trainer for Attentive {
    fn feedback<R: rand_core::Rng + ?Sized>(&self, correct: bool, _: &mut R) -> Feedback {
        if correct { Feedback::Reward } else { Feedback::Punish }
    }
}

/// Teaches all lessons.
pub fn teach(agent: &mut Agent<impl AgentMemory>, arm: &Arm<'_>) -> Result<(), CourseError> {
    let mut random = generator(1);
    for (command, meaning) in LESSONS {
        agent.hear(arm, &START, command)?;
        let mut lesson = Lesson::meaning(&START, intended(agent, meaning).ok_or(CourseError::NotPosed)?);
        while let Turn::Acted(_) = lesson.step(agent, arm, &Attentive, &mut random)? {}
        let _ = agent.finish(arm)?;
        agent.learn_fully();
    }
    Ok(())
}
