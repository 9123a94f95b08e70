//! Policy shaping, or Advise: feedback is a label that is right with a known probability. Counted labels give the probability of each task.
//!
//! S. Griffith et al. (2013), Policy shaping: integrating human feedback with reinforcement learning, NIPS.
//! Simpler here: the environment gives no reward.

use super::{Infer, Now, Tasks, label, signs};
use crate::study::course::Place;
use crate::study::trial::StudyError;
use goodbot::feedback::Feedback;
use goodbot::oomdp::Action;
use std::fmt;

/// Its settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// The probability that a label is right, more than 0.5.
    pub consistency: f32,
    /// Whether it acts for the most probable task, instead of drawing one.
    pub best: bool,
}

/// The chosen settings.
pub const CHOSEN: Settings = Settings { consistency: 0.9, best: false };

/// The probabilities to try.
pub const CONSISTENCIES: [f32; 8] = [0.52, 0.55, 0.6, 0.7, 0.8, 0.9, 0.97, 0.99];

/// All settings to try.
pub fn grid() -> impl Iterator<Item = Settings> {
    CONSISTENCIES.into_iter().flat_map(|consistency| [false, true].map(|best| Settings { consistency, best }))
}

impl fmt::Display for Settings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { consistency, best } = self;
        write!(f, "consistency {consistency}, {}", if *best { "best" } else { "drawn" })
    }
}

/// The inference.
#[derive(Debug)]
pub struct Shaping {
    settings: Settings,
    tasks: Tasks,
    last: Vec<f32>,
}

impl Shaping {
    /// An inference at the beginning, before any trainer.
    pub const fn new(settings: Settings, tasks: Tasks) -> Self {
        Self { settings, tasks, last: Vec::new() }
    }
}

impl Infer for Shaping {
    fn begin(&mut self, _place: &Place, prior: &[f32]) -> Result<(), StudyError> {
        self.tasks.begin(prior);
        self.last.clear();
        Ok(())
    }

    fn act(&mut self, now: &Now<'_>) -> Result<Action, StudyError> {
        let action = self.tasks.act_by_belief(now, self.settings.best);
        self.last = signs(now.outlook, action);
        Ok(action)
    }

    fn told(&mut self, word: Feedback) -> Result<(), StudyError> {
        let Some(label) = label(word) else { return Ok(()) };
        // C^labels (1 - C)^(labels of the others), so (C / (1 - C))^labels.
        let weight = libm::logf(self.settings.consistency / (1.0 - self.settings.consistency));
        self.tasks.add(weight * label, &self.last);
        Ok(())
    }

    fn belief(&self) -> Vec<f32> {
        self.tasks.belief()
    }
}
