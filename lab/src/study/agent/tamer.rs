//! TAMER: a model of what the person will say of an action, by regression; the agent does what it expects to be praised for most.
//!
//! In the shared form a sample is one of every task: a word praises or blames the tasks that would have done the same, and the opposite of
//! the others. That is more than TAMER asks for, and uses the planner to the full.

use super::choices::{Choices, Claim, Form, Words};
use super::{Learner, Now, pick};
use crate::study::place::Place;
use goodbot::feedback::Feedback;
use goodbot::oomdp::Action;
use goodbot::random::below;
use goodbot_course::CourseError;
use rand_pcg::Pcg32;
use std::collections::VecDeque;
use std::fmt;

/// Whose idea it is.
pub const SOURCE: &str = "W. B. Knox and P. Stone (2009), Interactively shaping agents via human reinforcement: the TAMER framework, K-CAP";
/// In what this is simpler.
pub const SIMPLER: &str = "A reward is 1 and a punishment -1. Credit goes to the last three steps by fixed shares and not by a distribution of reaction times, because steps here take no time. As in the original, silence is no sample.";

/// How TAMER learns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// What it chooses from.
    pub form: Form,
    /// The step size of the regression.
    pub rate: f32,
    /// The share of a word that is meant for the last step, for the one before, and for the one before that.
    pub credit: [f32; 3],
    /// How often it goes through all samples again after each lesson, so that later ones do not make it forget.
    pub again: u32,
}

/// The settings that were chosen for the table.
pub const TABULAR: Settings = Settings { form: Form::Tabular, rate: 0.8, credit: [1.0, 0.0, 0.0], again: 0 };
/// The settings that were chosen for shared features.
pub const SHARED: Settings = Settings { form: Form::Shared(Words::Neighbours), rate: 0.3, credit: [1.0, 0.0, 0.0], again: 10 };

const RATES: [f32; 4] = [0.02, 0.1, 0.3, 0.8];
const CREDITS: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.7, 0.3, 0.0], [0.5, 0.3, 0.2]];

/// All settings that are tried for these forms.
pub fn grid(forms: &[Form]) -> Vec<Settings> {
    let mut grid = Vec::new();
    for &form in forms {
        for rate in RATES {
            for credit in CREDITS {
                // A table's samples of other commands say nothing of this one.
                let often: &[u32] = if form == Form::Tabular { &[0] } else { &[0, 10] };
                grid.extend(often.iter().map(|&again| Settings { form, rate, credit, again }));
            }
        }
    }
    grid
}

impl fmt::Display for Settings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { form, rate, credit: [now, before, earlier], again } = self;
        write!(f, "{form}, rate {rate}, credit {now} {before} {earlier}, again {again}")
    }
}

/// The learner.
#[derive(Debug)]
pub struct Tamer {
    settings: Settings,
    choices: Choices,
    followed: Option<usize>,
    /// What the last steps claimed, the last one first.
    recent: VecDeque<Vec<Claim>>,
    samples: Vec<Sample>,
    random: Pcg32,
}

/// What is to be expected of these claims, each with its share of the credit.
#[derive(Clone, Debug)]
struct Sample {
    parts: Vec<(Claim, f32)>,
    label: f32,
}

impl Tamer {
    /// One that has learned nothing yet.
    pub fn new(settings: Settings, random: Pcg32) -> Self {
        Self { settings, choices: Choices::new(settings.form), followed: None, recent: VecDeque::new(), samples: Vec::new(), random }
    }

    fn fit(&mut self, sample: &Sample) {
        let expected: f32 = sample.parts.iter().map(|(claim, share)| share * self.choices.score(&claim.features)).sum();
        let step = self.settings.rate * (sample.label - expected);
        for (claim, share) in &sample.parts {
            self.choices.learn(&claim.features, step * share);
        }
    }
}

impl Learner for Tamer {
    fn hear(&mut self, place: &Place<'_, '_>) -> Result<(), CourseError> {
        self.choices.hear(place);
        self.recent.clear();
        self.followed = None;
        Ok(())
    }

    fn act(&mut self, now: &Now<'_, '_, '_>) -> Result<Action, CourseError> {
        let candidates = self.choices.here(now.place, now.state, now.outlook);
        let scores = self.choices.scores(&candidates);
        let followed = pick::best(&scores, self.followed.filter(|_| self.choices.are_tasks()), &mut self.random);
        self.followed = Some(followed);
        let onward = candidates[followed].onward;
        let action = onward.iter().nth(below(onward.len(), &mut self.random)).unwrap_or(Action::NOOP);
        self.recent.truncate(self.settings.credit.len() - 1);
        self.recent.push_front(self.choices.claims(&candidates, action));
        Ok(action)
    }

    fn told(&mut self, word: Feedback) -> Result<(), CourseError> {
        let label = match word {
            Feedback::Reward => 1.0,
            Feedback::Punish => -1.0,
            Feedback::Neutral => return Ok(()),
        };
        let steps = || self.recent.iter().zip(self.settings.credit).filter(|(_, credit)| *credit > 0.0);
        // A word at the beginning is meant for the steps that there were.
        let whole: f32 = steps().map(|(_, credit)| credit).sum();
        let part = |claims: &Vec<Claim>, at: usize, credit: f32| {
            let claim = claims.get(at)?;
            Some((claim.clone(), credit / whole * claim.sign))
        };
        let sample = |at: usize| Sample { parts: steps().filter_map(|(claims, credit)| part(claims, at, credit)).collect(), label };
        let samples: Vec<Sample> = (0..self.recent.front().map_or(0, Vec::len)).map(sample).collect();
        for sample in samples {
            self.fit(&sample);
            if self.settings.again > 0 {
                self.samples.push(sample);
            }
        }
        Ok(())
    }

    fn belief(&self) -> Option<(usize, f32)> {
        None
    }

    fn finish(&mut self, _place: &Place<'_, '_>) -> Result<(), CourseError> {
        let samples = std::mem::take(&mut self.samples);
        for _ in 0..self.settings.again {
            samples.iter().for_each(|sample| self.fit(sample));
        }
        self.samples = samples;
        Ok(())
    }

    fn forget(&mut self) {}
}
