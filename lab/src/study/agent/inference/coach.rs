//! COACH: feedback changes a policy. Feedback measures how much better an action was than the policy's average.
//!
//! J. MacGlashan et al. (2017), Interactive learning from policy-dependent human feedback, ICML.
//! Simpler here: there is one eligibility trace and no delay of reaction.
//!
//! Here the policy is a softmax over tasks, and an action's probability is the sum over the tasks that would take it. So the gradient
//! reaches every task, not only the followed one.

use super::{Infer, Now, Tasks, label};
use crate::study::course::Place;
use crate::study::trial::StudyError;
use goodbot::feedback::Feedback;
use goodbot::oomdp::Action;
use std::fmt;

/// The settings of COACH.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// The step size.
    pub rate: f32,
    /// The share of the trace that is left after a step.
    pub trace: f32,
    /// Whether it acts for the best task, instead of drawing one.
    pub best: bool,
}

/// The chosen settings.
pub const CHOSEN: Settings = Settings { rate: 1.0, trace: 0.3, best: false };

/// The step sizes to try.
pub const RATES: [f32; 5] = [0.1, 0.3, 1.0, 3.0, 10.0];
/// The traces to try.
pub const TRACES: [f32; 4] = [0.0, 0.3, 0.6, 0.8];

/// All settings to try.
pub fn grid() -> impl Iterator<Item = Settings> {
    let traced = |rate| TRACES.into_iter().flat_map(move |trace| [false, true].map(|best| Settings { rate, trace, best }));
    RATES.into_iter().flat_map(traced)
}

impl fmt::Display for Settings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { rate, trace, best } = self;
        write!(f, "rate {rate}, trace {trace}, {}", if *best { "best" } else { "drawn" })
    }
}

/// The inference.
#[derive(Debug)]
pub struct Coach {
    settings: Settings,
    tasks: Tasks,
    trace: Vec<f32>,
}

impl Coach {
    /// An inference at the beginning, before any trainer.
    pub const fn new(settings: Settings, tasks: Tasks) -> Self {
        Self { settings, tasks, trace: Vec::new() }
    }
}

impl Infer for Coach {
    fn begin(&mut self, _place: &Place, prior: &[f32]) -> Result<(), StudyError> {
        self.tasks.begin(prior);
        self.trace = vec![0.0; prior.len()];
        Ok(())
    }

    fn act(&mut self, now: &Now<'_>) -> Result<Action, StudyError> {
        let policy = self.belief();
        let action = self.tasks.act_by_belief(now, self.settings.best);
        // The gradient of the action's log probability.
        let takes = |task: usize| {
            let right = now.outlook.right(task);
            if right.contains(action) { 1.0 / right.len() as f32 } else { 0.0 }
        };
        let taken: Vec<f32> = policy.iter().enumerate().map(|(task, share)| share * takes(task)).collect();
        let whole: f32 = taken.iter().sum();
        for ((trace, taken), share) in self.trace.iter_mut().zip(&taken).zip(&policy) {
            *trace = self.settings.trace * *trace + if whole > 0.0 { taken / whole - share } else { 0.0 };
        }
        Ok(action)
    }

    fn told(&mut self, word: Feedback) -> Result<(), StudyError> {
        let Some(label) = label(word) else { return Ok(()) };
        self.tasks.add(self.settings.rate * label, &self.trace);
        Ok(())
    }

    fn belief(&self) -> Vec<f32> {
        self.tasks.belief()
    }
}
