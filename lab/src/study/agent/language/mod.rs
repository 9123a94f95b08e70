//! Languages: they learn the meaning of words from the beliefs about earlier commands. goodbot's role model and the paper's Model 2 are here.
//!
//! - [`loglinear`]: a weight for each word and each fact of a task;
//! - [`program`]: a program of one's own.

pub mod loglinear;
pub mod program;

use super::whole::ROOM;
use crate::study::course::Place;
use crate::study::trial::StudyError;
use goodbot::home::paper_tasks;
use goodbot::memory::AgentHeap;
use goodbot::session::Weights;
use goodbot::{Agent, Options};
use goodbot_course::CourseError;
use std::fmt;

/// Understands commands, and learns words.
pub trait Speak {
    /// The probability of each task of a command.
    ///
    /// # Errors
    /// [`StudyError`].
    fn hear(&mut self, place: &Place) -> Result<Vec<f32>, StudyError>;

    /// Learns from a lesson, with the belief at its end.
    ///
    /// # Errors
    /// [`StudyError`].
    fn learn(&mut self, place: &Place, posterior: &[f32]) -> Result<(), StudyError>;
}

/// Precedes a program's command in descriptions.
pub const PROGRAM: &str = "program ";

/// A language with its settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Language {
    /// goodbot's role model.
    Roles,
    /// The paper's IBM Model 2.
    ModelTwo,
    /// A log-linear model.
    LogLinear(loglinear::Settings),
    /// A program.
    Program(program::Settings),
    /// None: every command is new.
    Nothing,
}

impl Language {
    /// A language without words.
    ///
    /// # Errors
    /// [`StudyError`] if it cannot be created.
    pub fn begin(self) -> Result<Box<dyn Speak>, StudyError> {
        Ok(match self {
            Self::Roles => Box::new(Core::new(Options::DEFAULT)?),
            Self::ModelTwo => Box::new(Core::new(Options::PAPER)?),
            Self::LogLinear(settings) => Box::new(loglinear::LogLinear::new(settings)),
            Self::Program(settings) => Box::new(program::Program::new(settings)?),
            Self::Nothing => Box::new(Nothing),
        })
    }
}

impl fmt::Display for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Roles => f.write_str("roles"),
            Self::ModelTwo => f.write_str("Model 2"),
            Self::LogLinear(settings) => settings.fmt(f),
            Self::Program(settings) => settings.fmt(f),
            Self::Nothing => f.write_str("no language"),
        }
    }
}

/// The prior of each task, without words.
fn wordless(place: &Place) -> Vec<f32> {
    place.tasks.iter().map(|task| task.prior).collect()
}

/// A language that never learns a word.
struct Nothing;

impl Speak for Nothing {
    fn hear(&mut self, place: &Place) -> Result<Vec<f32>, StudyError> {
        Ok(wordless(place))
    }

    fn learn(&mut self, _place: &Place, _posterior: &[f32]) -> Result<(), StudyError> {
        Ok(())
    }
}

/// An agent that hears and learns, and never acts.
#[derive(Debug)]
pub struct Core(Agent<AgentHeap>);

impl Core {
    /// An agent without words.
    ///
    /// # Errors
    /// [`StudyError`].
    pub fn new(options: Options) -> Result<Self, StudyError> {
        let lifted = paper_tasks().map_err(|_| CourseError::NotPosed)?;
        // With the paper's weights, a session would be weighed by its own evidence, and the given posterior would not count.
        Ok(Self(Agent::new(AgentHeap::new(&ROOM), &lifted, Options { weights: Weights::Belief, ..options })?))
    }
}

impl Speak for Core {
    fn hear(&mut self, place: &Place) -> Result<Vec<f32>, StudyError> {
        self.0.hear(&place.home, &place.start, &place.command)?;
        Ok((0..place.tasks.len()).map(|task| self.0.belief().probability(task)).collect())
    }

    fn learn(&mut self, place: &Place, posterior: &[f32]) -> Result<(), StudyError> {
        let share = |task: &_| place.position(task).map_or(0.0, |task| posterior[task]);
        self.0.hear_with_prior(&place.home, &place.start, &place.command, |task, _| share(task))?;
        let _ = self.0.finish(&place.home)?;
        self.0.learn_fully();
        Ok(())
    }
}
