//! How often trainers end a session: at the intended goal and elsewhere, by rests in a row and by the last word.

use crate::recorded::{Walk, WalkStep};
use goodbot::feedback::{Ending, Feedback, Hazard};

/// The hazard of each moment is drawn to that of all moments by this many steps.
const HOLD: f64 = 6.0;
/// Rests in a row that are told apart: none, one, more.
const RESTS: usize = 3;
/// Last words that are told apart: none, reward, punish.
const WORDS: usize = 3;

/// Steps, and those after which the trainer ended the session, by rests and by the last word.
#[derive(Clone, Copy, Debug, Default)]
struct Counts([[(f64, f64); WORDS]; RESTS]);

impl Counts {
    fn add(&mut self, step: &WalkStep, ended: bool) {
        let word = match step.moment.said {
            Feedback::Neutral => 0,
            Feedback::Reward => 1,
            Feedback::Punish => 2,
        };
        let (steps, ends) = &mut self.0[usize::from(step.moment.rests).min(RESTS - 1)][word];
        *steps += 1.0;
        *ends += if ended { 1.0 } else { 0.0 };
    }

    /// The hazard for how often the robot rested, times a factor for the last word.
    fn hazard(&self) -> Hazard {
        let sum = |(steps, ends): (f64, f64), &(more, more_ends): &(f64, f64)| (steps + more, ends + more_ends);
        let (steps, ends) = self.0.iter().flatten().fold((0.0, 0.0), sum);
        // As if ten more steps had been seen, and half an end: no probability is 0.
        let all = (ends + 0.5) / (steps + 10.0);
        let held = |(steps, ends): (f64, f64)| (ends + HOLD * all) / (steps + HOLD);
        let by_rests = self.0.map(|words| held(words.iter().fold((0.0, 0.0), sum)));
        let by_word = [0, 1, 2].map(|word| held(self.0.iter().map(|words| &words[word]).fold((0.0, 0.0), sum)) / all);
        let round = |value: f64| ((value * 1_000.0).round() / 1_000.0) as f32;
        let [moved, rested, resting] = by_rests.map(|hazard| round(hazard * by_word[0]));
        Hazard { moved, rested, resting, praised: round(by_word[1] / by_word[0]), scolded: round(by_word[2] / by_word[0]) }
    }
}

/// How often the trainers of these sessions ended them.
pub fn fit<'a>(walks: impl Iterator<Item = &'a Walk>) -> Ending {
    let (mut at_goal, mut elsewhere) = (Counts::default(), Counts::default());
    for walk in walks {
        let Some(intended) = walk.intended else { continue };
        for (step, left) in walk.steps.iter().zip((0..walk.steps.len()).rev()) {
            match step.at_goal.get(intended).copied().flatten() {
                Some(true) => at_goal.add(step, left == 0),
                Some(false) => elsewhere.add(step, left == 0),
                None => {}
            }
        }
    }
    Ending { at_goal: at_goal.hazard(), elsewhere: elsewhere.hazard() }
}
