//! goodbot as it is used. It does not know its trainer: it expects the paper's balanced trainer, or real people.

use super::{Learner, Now};
use crate::study::course::{CAPACITIES, Place};
use crate::study::trial::StudyError;
use goodbot::asking::{Answer, Asking, Question};
use goodbot::feedback::{Feedback, population};
use goodbot::home::paper_tasks;
use goodbot::memory::AgentHeap;
use goodbot::oomdp::Action;
use goodbot::{Agent, Capacities, Options};
use goodbot_course::CourseError;
use rand_pcg::Pcg32;
use std::fmt;

/// Its options, the trainer that it expects, and when it asks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Its options.
    pub options: Options,
    /// Whether it expects real people; otherwise it expects the paper's balanced trainer.
    pub people: bool,
    /// When it asks.
    pub asking: Asking,
}

/// The default options.
pub const DEFAULT: Settings = Settings { options: Options::DEFAULT, people: false, asking: Asking::NEVER };
/// It expects real people.
pub const PEOPLE: Settings = Settings { options: Options::DEFAULT.for_people(), people: true, ..DEFAULT };
/// It expects real people, and asks.
pub const ASKING: Settings = Settings { asking: Asking::DEFAULT, ..PEOPLE };
/// The paper's options.
pub const PAPER: Settings = Settings { options: Options::PAPER, ..DEFAULT };

impl fmt::Display for Settings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.people { "expects people" } else { "expects a balanced trainer" })?;
        f.write_str(if self.options.telling { ", telling actions" } else { ", any action" })?;
        if self.asking.kappa.is_finite() { write!(f, ", asks at {} steps a question", self.asking.kappa) } else { Ok(()) }
    }
}

/// Capacities for the strategies of real people, and for the words of all courses.
pub const ROOM: Capacities = TWICE.plus(TWICE).plus(Capacities { strategies: 16, beliefs: 256, ..Capacities::NONE });
const TWICE: Capacities = CAPACITIES.plus(CAPACITIES);

/// The agent, with a generator for ties.
#[derive(Debug)]
pub struct Goodbot {
    agent: Agent<AgentHeap>,
    asking: Asking,
    random: Pcg32,
}

impl Goodbot {
    /// A robot without training.
    ///
    /// # Errors
    /// [`StudyError`] if an option is out of range.
    pub fn new(settings: Settings, random: Pcg32) -> Result<Self, StudyError> {
        let lifted = paper_tasks().map_err(|_| CourseError::NotPosed)?;
        let mut agent = Agent::new(AgentHeap::new(&ROOM), &lifted, settings.options)?;
        if settings.people {
            agent.set_strategies(&population::STRATEGIES)?;
        }
        Ok(Self { agent, asking: settings.asking, random })
    }
}

impl Learner for Goodbot {
    fn hear(&mut self, place: &Place) -> Result<(), StudyError> {
        Ok(self.agent.hear(&place.home, &place.start, &place.command)?)
    }

    fn act(&mut self, now: &Now<'_>) -> Result<Action, StudyError> {
        let home = &now.place.home;
        self.agent.plan_fully(home, now.state)?;
        let action = self.agent.decide_with(home, now.state, &mut self.random)?.action;
        self.agent.acted(home, now.state, action)?;
        Ok(action)
    }

    fn told(&mut self, word: Feedback) -> Result<(), StudyError> {
        let _ = self.agent.feedback(word)?;
        Ok(())
    }

    fn asks(&mut self, now: &Now<'_>) -> Result<Option<Question>, StudyError> {
        self.agent.plan_fully(&now.place.home, now.state)?;
        Ok(self.agent.question(&now.place.home, now.state, &self.asking)?)
    }

    fn answered(&mut self, answer: Answer) -> Result<(), StudyError> {
        let _ = self.agent.answer(answer)?;
        Ok(())
    }

    fn belief(&self) -> Vec<f32> {
        (0..self.agent.tasks().len()).map(|task| self.agent.belief().probability(task)).collect()
    }

    fn finish(&mut self, place: &Place) -> Result<(), StudyError> {
        let _ = self.agent.finish(&place.home)?;
        self.agent.learn_fully();
        Ok(())
    }
}
