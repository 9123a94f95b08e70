//! COACH: a policy that a person's words move; a word says how much better an action was than what the policy does on average.
//!
//! In the shared form the policy is a softmax over tasks, and the probability of an action is that of the tasks that would take it: the
//! gradient reaches every task, and not only the one that was followed.

use super::choices::{Candidate, Choices, Feature, Form, Words};
use super::{Learner, Now, pick};
use crate::study::place::Place;
use goodbot::feedback::Feedback;
use goodbot::oomdp::Action;
use goodbot::random::below;
use goodbot_course::CourseError;
use rand_pcg::Pcg32;
use std::collections::BTreeMap;
use std::fmt;

/// Parts of the trace that are smaller are forgotten.
const LEAST: f32 = 1e-4;

/// Whose idea it is.
pub const SOURCE: &str = "J. MacGlashan, M. K. Ho, R. Loftin, B. Peng, G. Wang, D. L. Roberts, M. E. Taylor and M. L. Littman (2017), Interactive learning from policy-dependent human feedback, ICML";
/// In what this is simpler.
pub const SIMPLER: &str = "A reward is 1, a punishment -1 and silence 0. There is one eligibility trace and no delay of reaction, because steps here take no time.";

/// How COACH learns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// What it chooses from.
    pub form: Form,
    /// The step size.
    pub rate: f32,
    /// How much of the trace is left after a step.
    pub trace: f32,
    /// Whether it does what its policy holds best, instead of drawing.
    pub best: bool,
}

/// The settings that were chosen for the table.
pub const TABULAR: Settings = Settings { form: Form::Tabular, rate: 1.0, trace: 0.0, best: false };
/// The settings that were chosen for shared features.
pub const SHARED: Settings = Settings { form: Form::Shared(Words::Single), rate: 3.0, trace: 0.0, best: false };

/// All settings that are tried for these forms.
pub fn grid(forms: &[Form]) -> Vec<Settings> {
    let mut grid = Vec::new();
    for &form in forms {
        for rate in [0.1, 0.3, 1.0, 3.0] {
            for trace in [0.0, 0.5, 0.8] {
                grid.extend([false, true].map(|best| Settings { form, rate, trace, best }));
            }
        }
    }
    grid
}

impl fmt::Display for Settings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { form, rate, trace, best } = self;
        write!(f, "{form}, rate {rate}, trace {trace}, {}", if *best { "best" } else { "drawn" })
    }
}

/// The learner.
#[derive(Debug)]
pub struct Coach {
    settings: Settings,
    choices: Choices,
    followed: Option<usize>,
    trace: BTreeMap<usize, f32>,
    random: Pcg32,
}

impl Coach {
    /// One that has learned nothing yet.
    pub fn new(settings: Settings, random: Pcg32) -> Self {
        Self { settings, choices: Choices::new(settings.form), followed: None, trace: BTreeMap::new(), random }
    }

    /// Adds the gradient of the logarithm of the probability of an action.
    fn eligible(&mut self, candidates: &[Candidate], policy: &[f32], action: Action) {
        let trace = self.settings.trace;
        self.trace.retain(|_, part| {
            *part *= trace;
            part.abs() > LEAST
        });
        let takes = |candidate: &Candidate| {
            if candidate.right.contains(action) { 1.0 / candidate.right.len() as f32 } else { 0.0 }
        };
        let taken: Vec<f32> = candidates.iter().zip(policy).map(|(candidate, share)| share * takes(candidate)).collect();
        let whole: f32 = taken.iter().sum();
        if whole <= 0.0 {
            return;
        }
        for ((candidate, taken), share) in candidates.iter().zip(&taken).zip(policy) {
            let step = taken / whole - share;
            for &(at, value) in &candidate.features {
                *self.trace.entry(at).or_insert(0.0) += step * value;
            }
        }
    }
}

impl Learner for Coach {
    fn hear(&mut self, place: &Place<'_, '_>) -> Result<(), CourseError> {
        self.choices.hear(place);
        self.trace.clear();
        self.followed = None;
        Ok(())
    }

    fn act(&mut self, now: &Now<'_, '_, '_>) -> Result<Action, CourseError> {
        let candidates = self.choices.here(now.place, now.state, now.outlook);
        let scores = self.choices.scores(&candidates);
        let policy = pick::softmax(&scores);
        let followed = if self.settings.best || now.is_test {
            pick::best(&scores, self.followed.filter(|_| self.choices.are_tasks()), &mut self.random)
        } else {
            pick::draw(&policy, &mut self.random)
        };
        self.followed = Some(followed);
        let onward = candidates[followed].onward;
        let action = onward.iter().nth(below(onward.len(), &mut self.random)).unwrap_or(Action::NOOP);
        self.eligible(&candidates, &policy, action);
        Ok(action)
    }

    fn told(&mut self, word: Feedback) -> Result<(), CourseError> {
        let label = match word {
            Feedback::Reward => 1.0,
            Feedback::Punish => -1.0,
            Feedback::Neutral => return Ok(()),
        };
        let trace: Vec<Feature> = self.trace.iter().map(|(&at, &part)| (at, part)).collect();
        self.choices.learn(&trace, self.settings.rate * label);
        Ok(())
    }

    fn belief(&self) -> Option<(usize, f32)> {
        let policy = pick::softmax(&self.choices.task_scores()?);
        let best = (0..policy.len()).max_by(|&a, &b| policy[a].total_cmp(&policy[b]))?;
        Some((best, policy[best]))
    }

    fn finish(&mut self, _place: &Place<'_, '_>) -> Result<(), CourseError> {
        Ok(())
    }

    fn forget(&mut self) {}
}
