//! What is meant in a lesson, from the words of the trainer.
//!
//! - [`model`]: goodbot's own, and SABL;
//! - [`tamer`], [`coach`], [`shaping`]: others, over the tasks of the command.
//!
//! The others choose among the tasks, where the originals choose among actions; a planner acts for the chosen one. Their belief begins with
//! what the language says, and a word judges every task: it speaks for those that would have done the same, and against the others. Most of
//! the originals have no such help; it makes them comparable.

pub mod coach;
pub mod model;
pub mod shaping;
pub mod tamer;

use super::{Now, pick};
use crate::study::place::{Outlook, Place};
use goodbot::feedback::Feedback;
use goodbot::oomdp::{Action, ActionSet};
use goodbot::random::below;
use goodbot_course::CourseError;
use rand_pcg::Pcg32;
use std::fmt;

/// Finds out what is meant.
pub trait Infer {
    /// A command was heard; its tasks are so probable.
    ///
    /// # Errors
    /// [`CourseError`].
    fn begin(&mut self, place: &Place, prior: &[f32]) -> Result<(), CourseError>;

    /// Decides what to do.
    ///
    /// # Errors
    /// [`CourseError`].
    fn act(&mut self, now: &Now<'_>) -> Result<Action, CourseError>;

    /// Hears what the trainer says, if anything, after the action.
    ///
    /// # Errors
    /// [`CourseError`].
    fn told(&mut self, word: Feedback) -> Result<(), CourseError>;

    /// How probable it holds each task.
    fn belief(&self) -> Vec<f32>;
}

/// Which inference, with its settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Inference {
    /// goodbot's own, as on the page: it expects people as they are.
    This,
    /// The paper's: it expects a balanced trainer.
    Sabl,
    /// TAMER.
    Tamer(tamer::Settings),
    /// COACH.
    Coach(coach::Settings),
    /// Policy shaping.
    Shaping(shaping::Settings),
    /// None: what the language says is believed, whatever the trainer says.
    Nothing,
}

impl Inference {
    /// One that has met no trainer yet.
    ///
    /// # Errors
    /// [`CourseError::Agent`] where it cannot be made.
    pub fn begin(self, random: Pcg32) -> Result<Box<dyn Infer>, CourseError> {
        let tasks = Tasks::new(random);
        Ok(match self {
            Self::This => Box::new(model::Model::people(tasks)?),
            Self::Sabl => Box::new(model::Model::balanced(tasks)?),
            Self::Tamer(settings) => Box::new(tamer::Tamer::new(settings, tasks)),
            Self::Coach(settings) => Box::new(coach::Coach::new(settings, tasks)),
            Self::Shaping(settings) => Box::new(shaping::Shaping::new(settings, tasks)),
            Self::Nothing => Box::new(Nothing(tasks)),
        })
    }

    /// All settings that are tried, itself included; none where there is nothing to choose.
    pub fn grid(self) -> Vec<Self> {
        match self {
            Self::This | Self::Sabl | Self::Nothing => Vec::new(),
            Self::Tamer(_) => tamer::grid().map(Self::Tamer).collect(),
            Self::Coach(_) => coach::grid().map(Self::Coach).collect(),
            Self::Shaping(_) => shaping::grid().map(Self::Shaping).collect(),
        }
    }

    /// Whose idea it is, and in what it is simpler here.
    pub const fn source(self) -> Option<(&'static str, &'static str, &'static str)> {
        match self {
            Self::Tamer(_) => Some(("TAMER", tamer::SOURCE, tamer::SIMPLER)),
            Self::Coach(_) => Some(("COACH", coach::SOURCE, coach::SIMPLER)),
            Self::Shaping(_) => Some(("policy shaping", shaping::SOURCE, shaping::SIMPLER)),
            Self::This | Self::Sabl | Self::Nothing => None,
        }
    }
}

impl fmt::Display for Inference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::This => f.write_str("expects people"),
            Self::Sabl => f.write_str("expects a balanced trainer"),
            Self::Tamer(settings) => settings.fmt(f),
            Self::Coach(settings) => settings.fmt(f),
            Self::Shaping(settings) => settings.fmt(f),
            Self::Nothing => f.write_str("words change nothing"),
        }
    }
}

/// The tasks of the command under way, and the one that is acted for.
#[derive(Debug)]
pub struct Tasks {
    /// The logarithms of what the language said of them.
    logs: Vec<f32>,
    followed: Option<usize>,
    last: Option<Action>,
    random: Pcg32,
}

impl Tasks {
    const fn new(random: Pcg32) -> Self {
        Self { logs: Vec::new(), followed: None, last: None, random }
    }

    fn begin(&mut self, prior: &[f32]) {
        self.logs = prior.iter().map(|&share| libm::logf(share)).collect();
        (self.followed, self.last) = (None, None);
    }

    /// How probable each task is by the logarithms.
    fn belief(&self) -> Vec<f32> {
        pick::softmax(&self.logs)
    }

    /// Adds a number to the logarithm of each task, `times` times.
    fn add(&mut self, times: f32, numbers: &[f32]) {
        for (log, number) in self.logs.iter_mut().zip(numbers) {
            *log += times * number;
        }
    }

    /// Acts by the logarithms alone.
    fn act_by_belief(&mut self, now: &Now<'_>, best: bool) -> Action {
        let scores = self.logs.clone();
        self.act(now, &scores, best)
    }

    /// Acts for the task with the highest score, or for one that is drawn by these as logarithms. It goes straight on where it can, so that
    /// a late word still judges the right kind of action.
    fn act(&mut self, now: &Now<'_>, scores: &[f32], best: bool) -> Action {
        let followed = if best || now.is_test {
            pick::best(scores, self.followed, &mut self.random)
        } else {
            pick::draw(&pick::softmax(scores), &mut self.random)
        };
        self.followed = Some(followed);
        let onward = now.outlook.optimal.get(followed).and_then(|set| set.onward()).unwrap_or(ActionSet::NOOP);
        let straight = self.last.filter(|&last| onward.contains(last));
        let action = straight.or_else(|| onward.iter().nth(below(onward.len(), &mut self.random))).unwrap_or(Action::NOOP);
        self.last = Some(action);
        action
    }
}

/// For each task 1 where it would have done the same, -1 where not, 0 where that is not known.
fn signs(outlook: &Outlook, action: Action) -> Vec<f32> {
    let sign = |task: usize| match outlook.right(task) {
        ActionSet::EMPTY => 0.0,
        right if right.contains(action) => 1.0,
        _ => -1.0,
    };
    (0..outlook.optimal.len()).map(sign).collect()
}

/// A word as a number; none for silence.
const fn label(word: Feedback) -> Option<f32> {
    match word {
        Feedback::Reward => Some(1.0),
        Feedback::Punish => Some(-1.0),
        Feedback::Neutral => None,
    }
}

/// Believes what the language says.
#[derive(Debug)]
struct Nothing(Tasks);

impl Infer for Nothing {
    fn begin(&mut self, _place: &Place, prior: &[f32]) -> Result<(), CourseError> {
        self.0.begin(prior);
        Ok(())
    }

    fn act(&mut self, now: &Now<'_>) -> Result<Action, CourseError> {
        Ok(self.0.act_by_belief(now, true))
    }

    fn told(&mut self, _word: Feedback) -> Result<(), CourseError> {
        Ok(())
    }

    fn belief(&self) -> Vec<f32> {
        self.0.belief()
    }
}
