//! The probability that a trainer ends a session, at the intended goal and elsewhere, by rests in a row and by the last feedback.

use crate::recorded::{Walk, WalkStep};
use goodbot::feedback::{Ending, Feedback, Hazard};

/// Each hazard is smoothed towards the overall hazard with the weight of this many steps.
const HOLD: f64 = 6.0;
/// The classes of rests in a row: none, one, more.
const RESTS: usize = 3;
/// The classes of the last feedback: none, reward, punish.
const WORDS: usize = 3;

/// Counts of steps, and of ends after them, by rests and by the last feedback.
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

    /// The hazard by the number of rests, times a factor for the last feedback.
    fn hazard(&self) -> Hazard {
        let sum = |(steps, ends): (f64, f64), &(more, more_ends): &(f64, f64)| (steps + more, ends + more_ends);
        let (steps, ends) = self.0.iter().flatten().fold((0.0, 0.0), sum);
        // Smoothed by ten more steps and half an end, so that no probability is 0.
        let all = (ends + 0.5) / (steps + 10.0);
        let held = |(steps, ends): (f64, f64)| (ends + HOLD * all) / (steps + HOLD);
        let by_rests = self.0.map(|words| held(words.iter().fold((0.0, 0.0), sum)));
        let by_word = [0, 1, 2].map(|word| held(self.0.iter().map(|words| &words[word]).fold((0.0, 0.0), sum)) / all);
        let round = |value: f64| ((value * 1_000.0).round() / 1_000.0) as f32;
        let [moved, rested, resting] = by_rests.map(|hazard| round(hazard * by_word[0]));
        Hazard { moved, rested, resting, praised: round(by_word[1] / by_word[0]), scolded: round(by_word[2] / by_word[0]) }
    }
}

/// Fits the ends of these sessions.
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
