//! A learner like Cobot: words are rewards of reinforcement learning, and values are linear in features, among them statistics of what the
//! person says.
//!
//! In the shared form values are of tasks, and all tasks that would have done the same learn from a step.

use super::choices::{Candidate, Choices, Feature, Form, Words};
use super::{Learner, Now, pick};
use crate::study::place::Place;
use goodbot::feedback::Feedback;
use goodbot::oomdp::Action;
use goodbot::random::{below, unit};
use goodbot_course::CourseError;
use rand_pcg::Pcg32;
use std::fmt;

/// How much of a running rate is new after a step.
const NEW: f32 = 0.1;

/// Whose idea it is.
pub const SOURCE: &str =
    "C. L. Isbell, C. R. Shelton, M. Kearns, S. Singh and P. Stone (2001), A social reinforcement learning agent, Autonomous Agents";
/// In what this is simpler.
pub const SIMPLER: &str = "One person instead of many; Q-learning instead of a policy gradient. The statistics of the person are running rates of rewards, punishments and silences, in place of a chat room's events.";

/// How it learns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// What it chooses from.
    pub form: Form,
    /// The step size.
    pub rate: f32,
    /// What a reward after the next one is worth.
    pub discount: f32,
    /// How often it tries something at random.
    pub tries: f32,
}

/// The settings that were chosen for the table.
pub const TABULAR: Settings = Settings { form: Form::Tabular, rate: 0.6, discount: 0.0, tries: 0.1 };
/// The settings that were chosen for shared features.
pub const SHARED: Settings = Settings { form: Form::Shared(Words::Neighbours), rate: 0.3, discount: 0.5, tries: 0.1 };

/// All settings that are tried for these forms.
pub fn grid(forms: &[Form]) -> Vec<Settings> {
    let mut grid = Vec::new();
    for &form in forms {
        for rate in [0.03, 0.1, 0.3, 0.6] {
            for discount in [0.0, 0.5, 0.9] {
                grid.extend([0.0, 0.1].map(|tries| Settings { form, rate, discount, tries }));
            }
        }
    }
    grid
}

impl fmt::Display for Settings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { form, rate, discount, tries } = self;
        write!(f, "{form}, rate {rate}, discount {discount}, tries {tries}")
    }
}

/// A step whose reward is known, but not yet what came after it.
#[derive(Debug)]
struct Last {
    /// The features of all candidates that would have done the same.
    features: Vec<Vec<Feature>>,
    reward: f32,
}

/// The learner.
#[derive(Debug)]
pub struct Cobot {
    settings: Settings,
    choices: Choices,
    followed: Option<usize>,
    last: Option<Last>,
    /// Running rates of rewards, punishments and silences.
    rates: [f32; 3],
    random: Pcg32,
}

impl Cobot {
    /// One that has learned nothing yet.
    pub fn new(settings: Settings, random: Pcg32) -> Self {
        Self { settings, choices: Choices::new(settings.form), followed: None, last: None, rates: [0.0; 3], random }
    }

    fn learn(&mut self, next: f32) {
        let Some(Last { features, reward }) = self.last.take() else { return };
        for features in features {
            let wrong = reward + self.settings.discount * next - self.choices.score(&features);
            // The statistics come on top of features whose squares sum to 1.
            let norm: f32 = features.iter().map(|(_, value)| value * value).sum();
            self.choices.learn(&features, self.settings.rate * wrong / norm.max(1.0));
        }
    }
}

impl Learner for Cobot {
    fn hear(&mut self, place: &Place<'_, '_>) -> Result<(), CourseError> {
        self.choices.hear(place);
        self.last = None;
        self.followed = None;
        Ok(())
    }

    fn act(&mut self, now: &Now<'_, '_, '_>) -> Result<Action, CourseError> {
        let mut candidates = self.choices.here(now.place, now.state, now.outlook);
        for candidate in &mut candidates {
            self.choices.with_statistics(candidate, &self.rates);
        }
        let values = self.choices.scores(&candidates);
        self.learn(values.iter().copied().fold(f32::NEG_INFINITY, f32::max));
        let tries = !now.is_test && unit(&mut self.random) < self.settings.tries;
        let before = self.followed.filter(|_| self.choices.are_tasks());
        let followed = if tries { below(values.len(), &mut self.random) } else { pick::best(&values, before, &mut self.random) };
        self.followed = Some(followed);
        let onward = candidates[followed].onward;
        let action = onward.iter().nth(below(onward.len(), &mut self.random)).unwrap_or(Action::NOOP);
        if !now.is_test {
            let same = |candidate: Candidate| candidate.right.contains(action).then_some(candidate.features);
            self.last = Some(Last { features: candidates.into_iter().filter_map(same).collect(), reward: 0.0 });
        }
        Ok(action)
    }

    fn told(&mut self, word: Feedback) -> Result<(), CourseError> {
        let said = [word == Feedback::Reward, word == Feedback::Punish, word == Feedback::Neutral];
        for (rate, said) in self.rates.iter_mut().zip(said) {
            *rate += NEW * (if said { 1.0 } else { 0.0 } - *rate);
        }
        if let Some(last) = &mut self.last {
            last.reward = match word {
                Feedback::Reward => 1.0,
                Feedback::Punish => -1.0,
                Feedback::Neutral => 0.0,
            };
        }
        Ok(())
    }

    fn belief(&self) -> Option<(usize, f32)> {
        None
    }

    fn finish(&mut self, _place: &Place<'_, '_>) -> Result<(), CourseError> {
        self.learn(0.0);
        Ok(())
    }

    fn forget(&mut self) {}
}
