//! Inferences: they find the intended task of a lesson from the trainer's feedback.
//!
//! - [`model`]: goodbot's own inference, and SABL;
//! - [`tamer`], [`coach`], [`shaping`]: other methods, over the tasks of the command.
//!
//! The other methods choose among tasks, and a planner acts for the chosen one; the original methods choose among actions. Their belief
//! begins with that of the language. Feedback judges every task: it supports those that would have taken the same action, and speaks
//! against the others. Most of the original methods have no such help; it makes them comparable.

pub mod coach;
pub mod model;
pub mod shaping;
pub mod tamer;

use super::Now;
use crate::study::agent;
use crate::study::course::{Outlook, Place};
use crate::study::trial::StudyError;
use goodbot::feedback::Feedback;
use goodbot::oomdp::{Action, ActionSet};
use goodbot::random::below;
use rand_pcg::Pcg32;
use std::fmt;

/// Finds the intended task.
pub trait Infer {
    /// Begins a command, with the prior of its tasks.
    ///
    /// # Errors
    /// [`StudyError`].
    fn begin(&mut self, place: &Place, prior: &[f32]) -> Result<(), StudyError>;

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

    /// The probability of each task.
    fn belief(&self) -> Vec<f32>;
}

/// An inference with its settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Inference {
    /// goodbot's own, as on the page: it expects the strategies of real people.
    This,
    /// The paper's: it expects a balanced trainer.
    Sabl,
    /// TAMER.
    Tamer(tamer::Settings),
    /// COACH.
    Coach(coach::Settings),
    /// Policy shaping.
    Shaping(shaping::Settings),
    /// None: the language's belief stays, whatever the feedback.
    Nothing,
}

impl Inference {
    /// An inference at the beginning, before any trainer.
    ///
    /// # Errors
    /// [`StudyError`] if it cannot be created.
    pub fn begin(self, random: Pcg32) -> Result<Box<dyn Infer>, StudyError> {
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

    /// All settings to try, including the chosen ones; empty if there is nothing to choose.
    pub fn grid(self) -> Vec<Self> {
        match self {
            Self::This | Self::Sabl | Self::Nothing => Vec::new(),
            Self::Tamer(_) => tamer::grid().map(Self::Tamer).collect(),
            Self::Coach(_) => coach::grid().map(Self::Coach).collect(),
            Self::Shaping(_) => shaping::grid().map(Self::Shaping).collect(),
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

/// The tasks of the present command, and the followed one.
#[derive(Debug)]
pub struct Tasks {
    /// The language's log probabilities.
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

    /// The probability of each task, by the logarithms.
    fn belief(&self) -> Vec<f32> {
        agent::softmax(&self.logs)
    }

    /// Adds a number to each task's logarithm, multiplied by `times`.
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

    /// Acts for the task with the highest score, or for one that is drawn with the scores as logarithms. It keeps its direction if it can,
    /// so that late feedback still judges the right kind of action.
    fn act(&mut self, now: &Now<'_>, scores: &[f32], best: bool) -> Action {
        let followed = if best || now.is_test {
            agent::best(scores, self.followed, &mut self.random)
        } else {
            agent::draw(&agent::softmax(scores), &mut self.random)
        };
        self.followed = Some(followed);
        let onward = now.outlook.optimal.get(followed).and_then(|set| set.onward()).unwrap_or(ActionSet::NOOP);
        let straight = self.last.filter(|&last| onward.contains(last));
        let action = straight.or_else(|| onward.iter().nth(below(onward.len(), &mut self.random))).unwrap_or(Action::NOOP);
        self.last = Some(action);
        action
    }
}

/// For each task, 1 if it would have taken the same action, -1 if not, 0 if that is unknown.
fn signs(outlook: &Outlook, action: Action) -> Vec<f32> {
    let sign = |task: usize| match outlook.right(task) {
        ActionSet::EMPTY => 0.0,
        right if right.contains(action) => 1.0,
        _ => -1.0,
    };
    (0..outlook.optimal.len()).map(sign).collect()
}

/// Feedback as a number; `None` for silence.
const fn label(word: Feedback) -> Option<f32> {
    match word {
        Feedback::Reward => Some(1.0),
        Feedback::Punish => Some(-1.0),
        Feedback::Neutral => None,
    }
}

/// Keeps the language's belief.
#[derive(Debug)]
struct Nothing(Tasks);

impl Infer for Nothing {
    fn begin(&mut self, _place: &Place, prior: &[f32]) -> Result<(), StudyError> {
        self.0.begin(prior);
        Ok(())
    }

    fn act(&mut self, now: &Now<'_>) -> Result<Action, StudyError> {
        Ok(self.0.act_by_belief(now, true))
    }

    fn told(&mut self, _word: Feedback) -> Result<(), StudyError> {
        Ok(())
    }

    fn belief(&self) -> Vec<f32> {
        self.0.belief()
    }
}
