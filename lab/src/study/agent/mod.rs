//! Who learns.
//!
//! - [`goodbot`]: this project's agent;
//! - [`tamer`], [`coach`], [`advise`], [`cobot`]: others that learn from a person's words, as people would build them for this course;
//! - [`choices`]: what these choose from, and the weights that they learn;
//! - [`pick`]: how they pick by a score.

pub mod advise;
pub mod choices;
pub mod coach;
pub mod cobot;
pub mod goodbot;
pub mod pick;
pub mod tamer;

use crate::study::place::{Outlook, Place};
use ::goodbot::asking::{Answer, Question};
use ::goodbot::feedback::Feedback;
use ::goodbot::home::HomeState;
use ::goodbot::oomdp::Action;
use choices::Form;
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

    /// What it asks before it acts, if anything. It is asked again after each answer.
    ///
    /// # Errors
    /// [`CourseError`].
    fn asks(&mut self, _now: &Now<'_, '_, '_>) -> Result<Option<Question>, CourseError> {
        Ok(None)
    }

    /// Takes the answer to what it asked.
    ///
    /// # Errors
    /// [`CourseError`].
    fn answered(&mut self, _answer: Answer) -> Result<(), CourseError> {
        Ok(())
    }

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
    Goodbot(goodbot::Settings),
    /// TAMER.
    Tamer(tamer::Settings),
    /// COACH.
    Coach(coach::Settings),
    /// Advise.
    Advise(advise::Settings),
    /// A learner like Cobot.
    Cobot(cobot::Settings),
}

impl Learns {
    /// One that knows nothing yet, with a generator of its own.
    ///
    /// # Errors
    /// [`CourseError::Agent`] where it cannot be made.
    pub fn begin(&self, random: Pcg32) -> Result<Box<dyn Learner>, CourseError> {
        Ok(match *self {
            Self::Goodbot(settings) => Box::new(goodbot::Goodbot::new(settings, random)?),
            Self::Tamer(settings) => Box::new(tamer::Tamer::new(settings, random)),
            Self::Coach(settings) => Box::new(coach::Coach::new(settings, random)),
            Self::Advise(settings) => Box::new(advise::Advise::new(settings, random)),
            Self::Cobot(settings) => Box::new(cobot::Cobot::new(settings, random)),
        })
    }
}

impl Learns {
    /// Whose idea it is, and in what it is simpler here.
    pub const fn source(&self) -> (&'static str, &'static str) {
        match self {
            Self::Goodbot(_) => (goodbot::SOURCE, ""),
            Self::Tamer(_) => (tamer::SOURCE, tamer::SIMPLER),
            Self::Coach(_) => (coach::SOURCE, coach::SIMPLER),
            Self::Advise(_) => (advise::SOURCE, advise::SIMPLER),
            Self::Cobot(_) => (cobot::SOURCE, cobot::SIMPLER),
        }
    }
}

impl fmt::Display for Learns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Goodbot(settings) => settings.fmt(f),
            Self::Tamer(settings) => settings.fmt(f),
            Self::Coach(settings) => settings.fmt(f),
            Self::Advise(settings) => settings.fmt(f),
            Self::Cobot(settings) => settings.fmt(f),
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

impl Learns {
    /// All settings that are tried for this algorithm in this form, itself included; none for goodbot, which is as it is.
    pub fn grid(&self) -> Vec<Self> {
        let forms = |form: Form| if form == Form::Tabular { &Form::TABLES[..] } else { &Form::SHARED[..] };
        match self {
            Self::Goodbot(_) => Vec::new(),
            Self::Tamer(settings) => tamer::grid(forms(settings.form)).into_iter().map(Self::Tamer).collect(),
            Self::Coach(settings) => coach::grid(forms(settings.form)).into_iter().map(Self::Coach).collect(),
            Self::Advise(settings) => advise::grid(forms(settings.form)).into_iter().map(Self::Advise).collect(),
            Self::Cobot(settings) => cobot::grid(forms(settings.form)).into_iter().map(Self::Cobot).collect(),
        }
    }
}

/// All agents, in the order of the tables.
pub const AGENTS: [Contestant; 13] = [
    Contestant { name: "goodbot", is: "goodbot as it comes", learns: Learns::Goodbot(goodbot::DEFAULT) },
    Contestant { name: "any-action", is: "goodbot that takes any action that leads on", learns: Learns::Goodbot(goodbot::ANY_ACTION) },
    Contestant { name: "people", is: "goodbot that expects trainers as people are", learns: Learns::Goodbot(goodbot::PEOPLE) },
    Contestant { name: "asking", is: "goodbot that expects people, and asks", learns: Learns::Goodbot(goodbot::ASKING) },
    Contestant { name: "paper", is: "goodbot with the paper's settings: SABL and IBM Model 2", learns: Learns::Goodbot(goodbot::PAPER) },
    Contestant { name: "tamer-table", is: "TAMER, a table for each command", learns: Learns::Tamer(tamer::TABULAR) },
    Contestant { name: "coach-table", is: "COACH, a table for each command", learns: Learns::Coach(coach::TABULAR) },
    Contestant { name: "advise-table", is: "Advise, a table for each command", learns: Learns::Advise(advise::TABULAR) },
    Contestant { name: "cobot-table", is: "like Cobot, a table for each command", learns: Learns::Cobot(cobot::TABULAR) },
    Contestant { name: "tamer-shared", is: "TAMER over words and facts, with a planner", learns: Learns::Tamer(tamer::SHARED) },
    Contestant { name: "coach-shared", is: "COACH over words and facts, with a planner", learns: Learns::Coach(coach::SHARED) },
    Contestant { name: "advise-shared", is: "Advise over words and facts, with a planner", learns: Learns::Advise(advise::SHARED) },
    Contestant { name: "cobot-shared", is: "like Cobot over words and facts, with a planner", learns: Learns::Cobot(cobot::SHARED) },
];
