//! The agents. An [`inference`] turns the feedback of a lesson into a belief about the intended task. A [`language`] learns from that
//! belief the meaning of words. Each inference is combined with each language. [`whole`] has goodbot as it is used.

pub mod inference;
pub mod language;
pub mod whole;

use super::course::{Outlook, Place};
use super::trial::StudyError;
use goodbot::asking::{Answer, Question};
use goodbot::feedback::Feedback;
use goodbot::home::HomeState;
use goodbot::oomdp::Action;
use goodbot::random::{below, unit};
use inference::{Infer, Inference, coach, shaping, tamer};
use language::{Language, Speak, loglinear, program};
use rand_core::Rng;
use rand_pcg::Pcg32;
use std::fmt;

/// The least probability of a task when a command is heard, so that feedback can still raise it.
const LEAST: f32 = 1e-6;

/// The situation in which an agent must act.
#[derive(Clone, Copy, Debug)]
pub struct Now<'p> {
    /// The command in its home.
    pub place: &'p Place,
    /// The state.
    pub state: &'p HomeState,
    /// The right actions for each task. Reading those of the intended task would be cheating.
    pub outlook: &'p Outlook,
    /// Whether this is a test: no feedback will come, so exploring is useless.
    pub is_test: bool,
}

/// An agent that learns.
pub trait Learner {
    /// Hears a command.
    ///
    /// # Errors
    /// [`StudyError`].
    fn hear(&mut self, place: &Place) -> Result<(), StudyError>;

    /// Chooses an action.
    ///
    /// # Errors
    /// [`StudyError`].
    fn act(&mut self, now: &Now<'_>) -> Result<Action, StudyError>;

    /// Takes the trainer's feedback to the action.
    ///
    /// # Errors
    /// [`StudyError`].
    fn told(&mut self, word: Feedback) -> Result<(), StudyError>;

    /// The agent's question before it acts, if it has one. This is called again after each answer.
    ///
    /// # Errors
    /// [`StudyError`].
    fn asks(&mut self, _now: &Now<'_>) -> Result<Option<Question>, StudyError> {
        Ok(None)
    }

    /// Takes the answer to its question.
    ///
    /// # Errors
    /// [`StudyError`].
    fn answered(&mut self, _answer: Answer) -> Result<(), StudyError> {
        Ok(())
    }

    /// The probability of each task.
    fn belief(&self) -> Vec<f32>;

    /// Ends the lesson, and learns from it.
    ///
    /// # Errors
    /// [`StudyError`].
    fn finish(&mut self, place: &Place) -> Result<(), StudyError>;
}

/// How an agent learns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Learns {
    /// goodbot as it is used.
    Whole(whole::Settings),
    /// An inference and a language.
    Factors(Inference, Language),
}

impl Learns {
    /// An agent without training, with a generator of its own.
    ///
    /// # Errors
    /// [`StudyError`] if it cannot be created.
    pub fn begin(&self, random: Pcg32) -> Result<Box<dyn Learner>, StudyError> {
        Ok(match *self {
            Self::Whole(settings) => Box::new(whole::Goodbot::new(settings, random)?),
            Self::Factors(inference, language) => Box::new(Factors { infers: inference.begin(random)?, speaks: language.begin()? }),
        })
    }

    /// All settings to try for this inference or this language, including the chosen ones; empty if there is nothing to choose.
    pub fn grid(&self) -> Vec<Self> {
        match *self {
            Self::Whole(_) => Vec::new(),
            Self::Factors(inference, Language::LogLinear(_)) => {
                loglinear::grid().into_iter().map(|settings| Self::Factors(inference, Language::LogLinear(settings))).collect()
            }
            Self::Factors(inference, language) => {
                inference.grid().into_iter().map(|inference| Self::Factors(inference, language)).collect()
            }
        }
    }
}

impl fmt::Display for Learns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Whole(settings) => settings.fmt(f),
            Self::Factors(inference, language) => write!(f, "{inference}; {language}"),
        }
    }
}

/// An inference and a language together.
struct Factors {
    infers: Box<dyn Infer>,
    speaks: Box<dyn Speak>,
}

impl Learner for Factors {
    fn hear(&mut self, place: &Place) -> Result<(), StudyError> {
        let mut prior = self.speaks.hear(place)?;
        let whole: f32 = prior.iter().map(|share| share.max(LEAST)).sum();
        prior.iter_mut().for_each(|share| *share = share.max(LEAST) / whole);
        self.infers.begin(place, &prior)
    }

    fn act(&mut self, now: &Now<'_>) -> Result<Action, StudyError> {
        self.infers.act(now)
    }

    fn told(&mut self, word: Feedback) -> Result<(), StudyError> {
        self.infers.told(word)
    }

    fn belief(&self) -> Vec<f32> {
        self.infers.belief()
    }

    fn finish(&mut self, place: &Place) -> Result<(), StudyError> {
        self.speaks.learn(place, &self.infers.belief())
    }
}

/// An agent of the study.
#[derive(Clone, Copy, Debug)]
pub struct Contestant {
    /// Its name, as it is typed.
    pub name: &'static str,
    /// Its description, in a few words.
    pub is: &'static str,
    /// How it learns.
    pub learns: Learns,
}

impl Contestant {
    /// The same agent, with these settings if its language is a program.
    #[must_use]
    pub fn with_program(self, settings: program::Settings) -> Self {
        match self.learns {
            Learns::Factors(inference, Language::Program(_)) => {
                Self { learns: Learns::Factors(inference, Language::Program(settings)), ..self }
            }
            _ => self,
        }
    }

    /// The command of the program that is its language.
    pub const fn program(&self) -> Option<&'static str> {
        match self.learns {
            Learns::Factors(_, Language::Program(settings)) => Some(settings.command),
            _ => None,
        }
    }
}

macro_rules! agents {
    (whole: $($whole:literal $is:literal $settings:expr,)* factors: $($name:literal $what:literal $inference:expr,)*) => {
        /// The agents, in the order of the tables. Those whose language is a program have no command.
        pub const AGENTS: &[Contestant] = &[
            $(Contestant { name: $whole, is: $is, learns: Learns::Whole($settings) },)*
            $(
                Contestant { name: concat!($name, "+roles"), is: concat!($what, "; the role model"), learns: Learns::Factors($inference, Language::Roles) },
                Contestant { name: concat!($name, "+model2"), is: concat!($what, "; Model 2"), learns: Learns::Factors($inference, Language::ModelTwo) },
                Contestant { name: concat!($name, "+loglinear"), is: concat!($what, "; log-linear"), learns: Learns::Factors($inference, Language::LogLinear(loglinear::CHOSEN)) },
                Contestant { name: concat!($name, "+program"), is: concat!($what, "; a program of yours"), learns: Learns::Factors($inference, Language::Program(program::Settings { command: "", seconds: 0 })) },
                Contestant { name: concat!($name, "+none"), is: concat!($what, "; no language"), learns: Learns::Factors($inference, Language::Nothing) },
            )*
        ];
    };
}

agents! {
    whole:
    "goodbot" "goodbot as it comes" whole::DEFAULT,
    "people" "goodbot that expects people" whole::PEOPLE,
    "asking" "goodbot that expects people, and asks" whole::ASKING,
    "paper" "goodbot with the paper's settings" whole::PAPER,
    factors:
    "this" "goodbot's inference" Inference::This,
    "sabl" "the paper's inference, SABL" Inference::Sabl,
    "tamer" "TAMER" Inference::Tamer(tamer::CHOSEN),
    "coach" "COACH" Inference::Coach(coach::CHOSEN),
    "shaping" "policy shaping" Inference::Shaping(shaping::CHOSEN),
    "none" "no inference" Inference::Nothing,
}

/// The candidate with the highest score. In a tie the earlier choice stays; otherwise one is drawn.
pub fn best<R: Rng + ?Sized>(scores: &[f32], before: Option<usize>, random: &mut R) -> usize {
    let most = scores.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let tied: Vec<usize> = (0..scores.len()).filter(|&at| scores[at] >= most).collect();
    match before.filter(|before| tied.contains(before)) {
        Some(before) => before,
        None => tied.get(below(tied.len(), random)).copied().unwrap_or(0),
    }
}

/// Probabilities proportional to the exponentials of these scores.
pub fn softmax(scores: &[f32]) -> Vec<f32> {
    let most = scores.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let parts: Vec<f32> = scores.iter().map(|score| libm::expf(score - most)).collect();
    let sum: f32 = parts.iter().sum();
    parts.into_iter().map(|part| part / sum).collect()
}

/// A random candidate, with these probabilities.
pub fn draw<R: Rng + ?Sized>(probabilities: &[f32], random: &mut R) -> usize {
    let mut left = unit(random);
    let found = probabilities.iter().position(|&probability| {
        left -= probability;
        left < 0.0
    });
    found.unwrap_or(probabilities.len().saturating_sub(1))
}
