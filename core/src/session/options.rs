//! How an agent understands and learns, and the memory it needs.

use crate::feedback::{Ending, population};
use crate::language::{SettingError, Settings};

/// How machine commands are weighted when a session ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Weights {
    /// By their likelihood of the command too (paper, Algorithm 1).
    #[default]
    Paper,
    /// By the tasks' posterior alone, shared evenly among each task's constraints (the authors' later program).
    Belief,
    /// By the trainer's evidence alone: the task prior without words times the likelihood of all evidence.
    Evidence,
}

/// How an agent understands and learns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// The language model's training.
    pub language: Settings,
    /// How machine commands are weighted.
    pub weights: Weights,
    /// Weights up to this threshold are dropped; less than 1.
    pub least_weight: f32,
    /// The share by which the belief about the trainer's strategies drifts back to its prior at each new command: from 0 (the paper: never)
    /// to 1.
    pub drift: f32,
    /// How the end of a session counts as evidence; [`Ending::NO_EVIDENCE`] in the paper.
    pub ending: Ending,
    /// Choose actions for clear feedback: repeat the last action if it leads towards the goal, so that a late word counts for the right
    /// one; otherwise take the action whose feedback has the highest expected information. The paper takes any, and so does an agent
    /// without the feature `asking`.
    pub telling: bool,
    /// The share of each kind of task that goes to tasks that hold already: from 0 (the paper: a command is about something to do) to less
    /// than 1. The robot rests for such a task, where with 0 it takes another one. [`Options::SELDOM_DONE`] is that of people's talk. A
    /// restored model keeps the robot's own, except that the paper's language model has 0. If the session has no room for these tasks,
    /// they are left out.
    pub done: f32,
}

impl Options {
    /// The paper's options.
    pub const PAPER: Self = Self {
        language: Settings::PAPER,
        weights: Weights::Paper,
        least_weight: 5e-5,
        drift: 0.0,
        ending: Ending::NO_EVIDENCE,
        telling: false,
        done: 0.0,
    };

    /// The share of tasks that hold already in people's commands.
    pub const SELDOM_DONE: f32 = 0.08;

    /// The options to use except for comparison with the paper: the paper's, with the language model that understands people best,
    /// [`Settings::DEFAULT`], fewer small weights, and actions chosen for clear feedback.
    pub const DEFAULT: Self = Self { language: Settings::DEFAULT, least_weight: 1e-3, telling: true, ..Self::PAPER };

    /// The paper's options, with Model 2 for short commands with few words: [`Settings::SMOOTHED`].
    pub const SMOOTHED: Self = Self { language: Settings::SMOOTHED, ..Self::PAPER };

    /// The same options for a robot that people train: its belief about the trainer drifts a little. People follow
    /// [`population::STRATEGIES`]. The end of a session is no evidence yet, because a robot may not know who ended it: see
    /// [`with_ends`](Self::with_ends).
    pub const fn for_people(self) -> Self {
        Self { drift: population::DRIFT, ..self }
    }

    /// The same options for a robot that knows when its trainer ends a session, and reports it with
    /// [`trainer_ended`](crate::Agent::trainer_ended). The end is evidence, with probabilities measured on recorded people
    /// ([`population::ENDING`]), and so is each step after which the trainer goes on.
    pub const fn with_ends(self) -> Self {
        Self { ending: population::ENDING, ..self }
    }

    /// Checks that every option is in its range. A robot without the feature `learning` has no use for the end of a session, and does not
    /// check it.
    ///
    /// # Errors
    /// A [`SettingError`] that names the first option out of range.
    pub fn check(&self) -> Result<(), SettingError> {
        self.language.check()?;
        let sound = |sound: bool, error| if sound { Ok(()) } else { Err(error) };
        sound((0.0..1.0).contains(&self.least_weight), SettingError::LeastWeight(self.least_weight))?;
        sound((0.0..=1.0).contains(&self.drift), SettingError::Drift(self.drift))?;
        sound((0.0..1.0).contains(&self.done), SettingError::Done(self.done))?;
        sound(!cfg!(feature = "learning") || self.ending.is_sound(), SettingError::Ending)
    }
}
