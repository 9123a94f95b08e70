//! TAMER: a regression model of the person's feedback.
//!
//! W. B. Knox and P. Stone (2009), Interactively shaping agents via human reinforcement: the TAMER framework, K-CAP.
//! Simpler here: credit goes to the last three steps by fixed shares, because steps take no time here.
//!
//! Here it predicts, for each task, whether the feedback agrees with it: a number from -1 to 1. This number, times a sharpness, is added to
//! the language's log probability.

use super::{Infer, Now, Tasks, label, signs};
use crate::study::agent;
use crate::study::course::Place;
use crate::study::trial::StudyError;
use goodbot::feedback::Feedback;
use goodbot::oomdp::Action;
use std::collections::VecDeque;
use std::fmt;

/// The settings of TAMER.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// The step size of the regression.
    pub rate: f32,
    /// The increase of a task's log probability by a prediction of 1.
    pub sharpness: f32,
    /// The shares of feedback that are about the last step, the one before, and the one before that.
    pub credit: [f32; 3],
}

/// The chosen settings.
pub const CHOSEN: Settings = Settings { rate: 0.2, sharpness: 30.0, credit: [1.0, 0.0, 0.0] };

/// The step sizes to try.
pub const RATES: [f32; 6] = [0.02, 0.05, 0.1, 0.2, 0.4, 0.8];
/// The sharpnesses to try.
pub const SHARPNESSES: [f32; 6] = [1.0, 3.0, 10.0, 30.0, 100.0, 300.0];
const CREDITS: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.7, 0.3, 0.0], [0.5, 0.3, 0.2]];

/// All settings to try.
pub fn grid() -> impl Iterator<Item = Settings> {
    let sharper = |rate| SHARPNESSES.into_iter().flat_map(move |sharpness| CREDITS.map(|credit| Settings { rate, sharpness, credit }));
    RATES.into_iter().flat_map(sharper)
}

impl fmt::Display for Settings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { rate, sharpness, credit: [now, before, earlier] } = self;
        write!(f, "rate {rate}, sharpness {sharpness}, credit {now} {before} {earlier}")
    }
}

/// The inference.
#[derive(Debug)]
pub struct Tamer {
    settings: Settings,
    tasks: Tasks,
    predicted: Vec<f32>,
    /// The tasks that would have taken the same actions in the last steps, the last step first.
    recent: VecDeque<Vec<f32>>,
}

impl Tamer {
    /// An inference at the beginning, before any trainer.
    pub const fn new(settings: Settings, tasks: Tasks) -> Self {
        Self { settings, tasks, predicted: Vec::new(), recent: VecDeque::new() }
    }

    fn scores(&self) -> Vec<f32> {
        self.tasks.logs.iter().zip(&self.predicted).map(|(log, predicted)| log + self.settings.sharpness * predicted).collect()
    }
}

impl Infer for Tamer {
    fn begin(&mut self, _place: &Place, prior: &[f32]) -> Result<(), StudyError> {
        self.tasks.begin(prior);
        self.predicted = vec![0.0; prior.len()];
        self.recent.clear();
        Ok(())
    }

    fn act(&mut self, now: &Now<'_>) -> Result<Action, StudyError> {
        let scores = self.scores();
        let action = self.tasks.act(now, &scores, true);
        self.recent.truncate(self.settings.credit.len() - 1);
        self.recent.push_front(signs(now.outlook, action));
        Ok(action)
    }

    fn told(&mut self, word: Feedback) -> Result<(), StudyError> {
        let Some(label) = label(word) else { return Ok(()) };
        let steps = || self.recent.iter().zip(self.settings.credit).filter(|(_, credit)| *credit > 0.0);
        // At the beginning, feedback is about the steps so far.
        let whole: f32 = steps().map(|(_, credit)| credit).sum();
        for (task, predicted) in self.predicted.iter_mut().enumerate() {
            let claim: f32 = steps().map(|(signs, credit)| signs[task] * credit / whole).sum();
            *predicted += self.settings.rate * claim * (label - claim * *predicted);
        }
        Ok(())
    }

    fn belief(&self) -> Vec<f32> {
        agent::softmax(&self.scores())
    }
}
