//! This project's agent. It takes its trainer for the paper's balanced one, whoever that is.

use super::{Learner, Now};
use crate::place::{CAPACITIES, Place};
use goodbot::feedback::Feedback;
use goodbot::home::paper_tasks;
use goodbot::memory::AgentHeap;
use goodbot::oomdp::Action;
use goodbot::{Agent, Options};
use goodbot_course::CourseError;
use rand_pcg::Pcg32;

/// The agent, with a generator for ties.
#[derive(Debug)]
pub struct Goodbot {
    agent: Agent<AgentHeap>,
    random: Pcg32,
}

impl Goodbot {
    /// One that has learned nothing yet.
    ///
    /// # Errors
    /// [`CourseError::Agent`] where an option is out of range.
    pub fn new(options: Options, random: Pcg32) -> Result<Self, CourseError> {
        let lifted = paper_tasks().map_err(|_| CourseError::NotPosed)?;
        Ok(Self { agent: Agent::new(AgentHeap::new(&CAPACITIES), &lifted, options)?, random })
    }
}

impl Learner for Goodbot {
    fn hear(&mut self, place: &Place<'_, '_>) -> Result<(), CourseError> {
        Ok(self.agent.hear(&place.home, &place.start, place.exercise.command)?)
    }

    fn act(&mut self, now: &Now<'_, '_, '_>) -> Result<Action, CourseError> {
        let home = &now.place.home;
        self.agent.plan_fully(home, now.state)?;
        let action = self.agent.decide_by(home, now.state, &mut self.random)?.action;
        self.agent.acted(home, now.state, action)?;
        Ok(action)
    }

    fn told(&mut self, word: Feedback) -> Result<(), CourseError> {
        let _ = self.agent.feedback(word)?;
        Ok(())
    }

    fn belief(&self) -> Option<(usize, f32)> {
        let task = self.agent.most_likely()?;
        Some((task, self.agent.belief().probability(task)))
    }

    fn finish(&mut self, place: &Place<'_, '_>) -> Result<(), CourseError> {
        let _ = self.agent.finish(&place.home)?;
        self.agent.learn_fully();
        Ok(())
    }

    fn forget(&mut self) {
        self.agent.forget();
    }
}
