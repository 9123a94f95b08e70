//! Who learns.
//!
//! - [`goodbot`]: this project's agent;
//! - [`tamer`], [`coach`], [`advise`], [`cobot`]: others that learn from a person's words, as people would build them for this course;
//! - [`choices`]: what these choose from, and the weights that they learn;
//! - [`pick`]: how they pick by a score.

pub mod choices;
pub mod goodbot;
pub mod pick;
pub mod tamer;

use crate::place::{Outlook, Place};
use ::goodbot::Options;
use ::goodbot::feedback::Feedback;
use ::goodbot::home::HomeState;
use ::goodbot::oomdp::Action;
use goodbot_course::CourseError;
use rand_pcg::Pcg32;
use std::fmt;

/// The state that an agent must act in.
#[derive(Clone, Copy, Debug)]
pub struct Now<'p, 'm, 'u> {
    /// The command, and where it was given.
    pub place: &'p Place<'m, 'u>,
    /// Where things stand.
    pub state: &'p HomeState,
    /// What is right here for each task. What is right for the one that is meant, it must not ask.
    pub outlook: &'p Outlook,
    /// Whether this is a test: no word will come, so nothing is gained by trying.
    pub is_test: bool,
}

/// Someone who learns.
pub trait Learner {
    /// Hears a command.
    ///
    /// # Errors
    /// [`CourseError`].
    fn hear(&mut self, place: &Place<'_, '_>) -> Result<(), CourseError>;

    /// Decides what to do.
    ///
    /// # Errors
    /// [`CourseError`].
    fn act(&mut self, now: &Now<'_, '_, '_>) -> Result<Action, CourseError>;

    /// Hears what the trainer says, if anything, after the action.
    ///
    /// # Errors
    /// [`CourseError`].
    fn told(&mut self, word: Feedback) -> Result<(), CourseError>;

    /// The most likely task, and how sure the agent is of it; `None` for one that has no such probability.
    fn belief(&self) -> Option<(usize, f32)>;

    /// The lesson is over.
    ///
    /// # Errors
    /// [`CourseError`].
    fn finish(&mut self, place: &Place<'_, '_>) -> Result<(), CourseError>;

    /// The test is over: nothing is learned from it.
    fn forget(&mut self);
}

/// Which algorithm, with its settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Learns {
    /// This project's agent.
    Goodbot(Options),
    /// TAMER.
    Tamer(tamer::Settings),
}

impl Learns {
    /// One that knows nothing yet, with a generator of its own.
    ///
    /// # Errors
    /// [`CourseError::Agent`] where it cannot be made.
    pub fn begin(&self, random: Pcg32) -> Result<Box<dyn Learner>, CourseError> {
        Ok(match *self {
            Self::Goodbot(options) => Box::new(goodbot::Goodbot::new(options, random)?),
            Self::Tamer(settings) => Box::new(tamer::Tamer::new(settings, random)),
        })
    }
}

impl fmt::Display for Learns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Goodbot(_) => f.write_str("as it is"),
            Self::Tamer(settings) => settings.fmt(f),
        }
    }
}

/// An agent of the study.
#[derive(Clone, Copy, Debug)]
pub struct Contestant {
    /// Its name, as it is typed.
    pub name: &'static str,
    /// What it is, in a few words.
    pub is: &'static str,
    /// How it learns.
    pub learns: Learns,
}

/// All agents, in the order of the tables.
pub const AGENTS: [Contestant; 4] = [
    Contestant { name: "goodbot", is: "goodbot as it comes", learns: Learns::Goodbot(Options::DEFAULT) },
    Contestant { name: "paper", is: "goodbot with the paper's settings: SABL and IBM Model 2", learns: Learns::Goodbot(Options::PAPER) },
    Contestant { name: "tamer-table", is: "TAMER, a table for each command", learns: Learns::Tamer(tamer::TABULAR) },
    Contestant { name: "tamer-shared", is: "TAMER over words and facts, with a planner", learns: Learns::Tamer(tamer::SHARED) },
];
