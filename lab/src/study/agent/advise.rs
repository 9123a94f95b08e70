//! Advise, or policy shaping: a word is a label that is right with a known probability; counted labels give the probability that an action
//! is right.
//!
//! In the shared form labels are counted for pairs of words and facts; a label speaks for the tasks that would have done the same, and
//! against the others.

use super::choices::{Choices, Claim, Form, Words};
use super::{Learner, Now, pick};
use crate::study::place::Place;
use goodbot::feedback::Feedback;
use goodbot::oomdp::Action;
use goodbot::random::below;
use goodbot_course::CourseError;
use rand_pcg::Pcg32;
use std::fmt;

/// Whose idea it is.
pub const SOURCE: &str = "S. Griffith, K. Subramanian, J. Scholz, C. L. Isbell and A. L. Thomaz (2013), Policy shaping: integrating human feedback with reinforcement learning, NIPS";
/// In what this is simpler.
pub const SIMPLER: &str =
    "The environment gives no reward here, so that the policy from the labels stands alone. As in the original, silence is no label.";

/// How Advise learns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// What it chooses from.
    pub form: Form,
    /// The probability that a label is right, more than 0.5.
    pub consistency: f32,
    /// Whether it does what is most probably right, instead of drawing.
    pub best: bool,
}

/// The settings that were chosen for the table.
pub const TABULAR: Settings = Settings { form: Form::Tabular, consistency: 0.8, best: false };
/// The settings that were chosen for shared features.
pub const SHARED: Settings = Settings { form: Form::Shared(Words::Neighbours), consistency: 0.55, best: true };

/// All settings that are tried for these forms.
pub fn grid(forms: &[Form]) -> Vec<Settings> {
    let mut grid = Vec::new();
    for &form in forms {
        for consistency in [0.55, 0.65, 0.8, 0.9, 0.97] {
            grid.extend([false, true].map(|best| Settings { form, consistency, best }));
        }
    }
    grid
}

impl fmt::Display for Settings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { form, consistency, best } = self;
        write!(f, "{form}, consistency {consistency}, {}", if *best { "best" } else { "drawn" })
    }
}

/// The learner.
#[derive(Debug)]
pub struct Advise {
    settings: Settings,
    choices: Choices,
    followed: Option<usize>,
    last: Vec<Claim>,
    random: Pcg32,
}

impl Advise {
    /// One that has learned nothing yet.
    pub fn new(settings: Settings, random: Pcg32) -> Self {
        Self { settings, choices: Choices::new(settings.form), followed: None, last: Vec::new(), random }
    }

    /// Pr(right) is proportional to C^labels (1 - C)^(labels of the others), so to (C / (1 - C))^labels.
    fn probabilities(&self, labels: &[f32]) -> Vec<f32> {
        let weight = libm::logf(self.settings.consistency / (1.0 - self.settings.consistency));
        pick::softmax(&labels.iter().map(|labels| weight * labels).collect::<Vec<_>>())
    }
}

impl Learner for Advise {
    fn hear(&mut self, place: &Place<'_, '_>) -> Result<(), CourseError> {
        self.choices.hear(place);
        self.last.clear();
        self.followed = None;
        Ok(())
    }

    fn act(&mut self, now: &Now<'_, '_, '_>) -> Result<Action, CourseError> {
        let candidates = self.choices.here(now.place, now.state, now.outlook);
        let labels = self.choices.scores(&candidates);
        let followed = if self.settings.best || now.is_test {
            pick::best(&labels, self.followed.filter(|_| self.choices.are_tasks()), &mut self.random)
        } else {
            pick::draw(&self.probabilities(&labels), &mut self.random)
        };
        self.followed = Some(followed);
        let onward = candidates[followed].onward;
        let action = onward.iter().nth(below(onward.len(), &mut self.random)).unwrap_or(Action::NOOP);
        self.last = self.choices.claims(&candidates, action);
        Ok(action)
    }

    fn told(&mut self, word: Feedback) -> Result<(), CourseError> {
        let label = match word {
            Feedback::Reward => 1.0,
            Feedback::Punish => -1.0,
            Feedback::Neutral => return Ok(()),
        };
        for claim in &self.last {
            self.choices.learn(&claim.features, label * claim.sign);
        }
        Ok(())
    }

    fn belief(&self) -> Option<(usize, f32)> {
        let probabilities = self.probabilities(&self.choices.task_scores()?);
        let best = (0..probabilities.len()).max_by(|&a, &b| probabilities[a].total_cmp(&probabilities[b]))?;
        Some((best, probabilities[best]))
    }

    fn finish(&mut self, _place: &Place<'_, '_>) -> Result<(), CourseError> {
        Ok(())
    }

    fn forget(&mut self) {}
}
