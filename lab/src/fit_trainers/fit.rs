//! Fits a population of trainer strategies to the feedback of real trainers.
//!
//! Each trainer follows one strategy of the population. Unknown are the strategy, the action that a feedback is about, and whether the
//! trainer took the action for right. Expectation maximisation finds the strategies and shares that make the feedback most probable. One
//! trainer has too little feedback to determine three probabilities and a lag, so every strategy is smoothed towards that of all trainers,
//! with the weight of a few words ([`Fit::hold`]). The weight is chosen inside the training data, by leaving one trainer out.

use crate::recorded::{Walk, WalkStep};
use goodbot::feedback::{Ending, Feedback, Hazard, Judged, LAGS, Strategy};
use std::collections::BTreeMap;

/// The most strategies: more would be similar, and a robot's beliefs take memory for each.
pub const MOST: usize = 6;
/// Rounds of expectation maximisation.
const ROUNDS: usize = 30;
/// The weights to choose from, in words of all trainers.
const HOLDS: [f64; 4] = [3.0, 10.0, 30.0, 100.0];
/// The prior of trainers, and its weight in words.
const BEFORE: (Manner, [f64; LAGS], f64) = (Manner { silence: [0.85, 0.85], mistake: 0.2 }, [0.7, 0.2, 0.1], 3.0);
/// A trainer with more mistakes than this would mean the opposite.
const MOST_MISTAKEN: f64 = 0.45;

/// A trainer's feedback to moves, or to rests.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Manner {
    /// The probabilities of silence to an action taken for right, and to one taken for wrong.
    silence: [f64; 2],
    mistake: f64,
}

/// The ways in which strategies may differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    /// Whether feedback may be late.
    pub lagging: bool,
    /// Whether feedback to rests differs from feedback to moves; a move inside the goal is then as right as a rest there.
    pub rests: bool,
}

/// The parameters of a strategy.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Parameters {
    /// For moves and for rests.
    manners: [Manner; 2],
    lags: [f64; LAGS],
    shape: Shape,
}

/// The feedback of one trainer: how often each feedback came after each history of actions, the last action first.
#[derive(Clone, Debug, Default)]
pub struct FeedbackCounts(BTreeMap<(Feedback, [Judged; LAGS]), f64>);

impl FeedbackCounts {
    /// Adds the feedback of a session with a known intended task.
    pub fn add(&mut self, walk: &Walk) {
        let Some(intended) = walk.intended else { return };
        let mut judged = [Judged::Unknown; LAGS];
        for step in &walk.steps {
            let now = step.judged.get(intended).copied().unwrap_or_default();
            let [last, before, _] = judged;
            judged = [now, last, before];
            *self.0.entry((step.feedback, judged)).or_default() += 1.0;
        }
    }
}

/// The feedback of all sessions, by trainer.
pub fn by_trainer(walks: &[Walk]) -> BTreeMap<&str, FeedbackCounts> {
    let mut trainers: BTreeMap<&str, FeedbackCounts> = BTreeMap::new();
    for walk in walks {
        trainers.entry(&walk.trainer).or_default().add(walk);
    }
    trainers.retain(|_, heard| !heard.0.is_empty());
    trainers
}

/// The expected values of the hidden parts of feedback, under a strategy.
#[derive(Clone, Copy, Debug, Default)]
struct Expected {
    /// For moves and for rests.
    manners: [ExpectedManner; 2],
    lags: [f64; LAGS],
}

#[derive(Clone, Copy, Debug, Default)]
struct ExpectedManner {
    /// How often an action was taken for right, and for wrong.
    taken: [f64; 2],
    /// How often silence followed.
    silent: [f64; 2],
    mistaken: f64,
}

/// One way in which a feedback may arise.
struct Part {
    lag: usize,
    manner: usize,
    /// Whether the action was taken for right (0) or wrong (1).
    taken: usize,
    mistaken: bool,
    probability: f64,
}

impl Shape {
    /// The positions of an action's kind (move or rest) and of its rightness; `None` if these are unknown.
    const fn read(self, judged: Judged) -> Option<(usize, usize)> {
        let rest = if self.rests { 1 } else { 0 };
        match judged {
            Judged::Nearer => Some((0, 0)),
            Judged::NotNearer => Some((0, 1)),
            Judged::RestsAtGoal => Some((rest, 0)),
            Judged::RestsElsewhere => Some((rest, 1)),
            Judged::MovesInside => Some((rest, 1 - rest)),
            Judged::Unknown => None,
        }
    }
}

impl Parameters {
    /// The probability of a feedback with each of its hidden parts: the lag, and whether the action was taken for right.
    fn parts(&self, feedback: Feedback, judged: [Judged; LAGS]) -> impl Iterator<Item = Part> + '_ {
        let read = judged.map(|judged| self.shape.read(judged));
        let known: f64 = self.lags.into_iter().zip(read).filter(|(_, read)| read.is_some()).map(|(lag, _)| lag).sum();
        let lags = self.lags.into_iter().zip(read).enumerate().filter(|&(_, (lag, _))| lag > 0.0);
        let lags = lags.filter_map(move |(at, (lag, read))| Some((at, lag / known, read?)));
        lags.flat_map(move |(lag, share, (manner, right))| {
            let Manner { silence, mistake } = self.manners[manner];
            [0, 1].map(|taken| {
                let seen = if taken == right { 1.0 - mistake } else { mistake };
                let said = match (feedback, taken) {
                    (Feedback::Neutral, _) => silence[taken],
                    (Feedback::Reward, 0) | (Feedback::Punish, 1) => 1.0 - silence[taken],
                    _ => 0.0,
                };
                Part { lag, manner, taken, mistaken: taken != right, probability: share * seen * said }
            })
        })
    }

    /// The log likelihood of a trainer's feedback.
    fn log_likelihood(&self, heard: &FeedbackCounts) -> f64 {
        let log = |(&(feedback, judged), count): (&(Feedback, [Judged; LAGS]), &f64)| {
            let mut parts = self.parts(feedback, judged).map(|part| part.probability).peekable();
            // No action that the feedback may be about is known.
            parts.peek()?;
            Some(count * parts.sum::<f64>().max(1e-12).ln())
        };
        heard.0.iter().filter_map(log).sum()
    }

    fn expect(&self, heard: &FeedbackCounts, share: f64, expected: &mut Expected) {
        for (&(feedback, judged), count) in &heard.0 {
            let whole: f64 = self.parts(feedback, judged).map(|part| part.probability).sum();
            if whole <= 0.0 {
                continue;
            }
            for Part { lag, manner, taken, mistaken, probability } in self.parts(feedback, judged) {
                let part = share * count * probability / whole;
                expected.lags[lag] += part;
                let manner = &mut expected.manners[manner];
                manner.taken[taken] += part;
                manner.silent[taken] += if feedback == Feedback::Neutral { part } else { 0.0 };
                manner.mistaken += if mistaken { part } else { 0.0 };
            }
        }
    }
}

impl Expected {
    /// The most probable strategy, smoothed towards another one with the weight of this many words.
    fn strategy(&self, to: &Parameters, hold: f64) -> Parameters {
        let share = |part: f64, whole: f64, before: f64| (part + hold * before) / (whole + hold);
        let manners = [0, 1].map(|at| {
            let (seen, before): (&ExpectedManner, &Manner) = (&self.manners[at], &to.manners[at]);
            let silence = [0, 1].map(|taken| share(seen.silent[taken], seen.taken[taken], before.silence[taken]));
            let mistake = share(seen.mistaken, seen.taken.iter().sum(), before.mistake).min(MOST_MISTAKEN);
            Manner { silence, mistake }
        });
        let all: f64 = self.lags.iter().sum();
        let lags = [0, 1, 2].map(|at| share(self.lags[at], all, to.lags[at]));
        Parameters { manners, lags: if to.shape.lagging { lags } else { to.lags }, ..*to }
    }
}

/// A fitted population.
#[derive(Clone, Debug)]
pub struct Fit {
    strategies: Vec<(Parameters, f64)>,
    /// The weight of all trainers' strategy, in words.
    pub hold: f64,
}

impl Fit {
    /// Fits a population to the feedback of trainers. One strategy is that of all together; each other one begins as one trainer's own.
    pub fn to(trainers: &[&FeedbackCounts], shape: Shape) -> Self {
        let held_out = |&hold: &f64| -> f64 {
            (0..trainers.len())
                .map(|out| {
                    let others: Vec<&FeedbackCounts> =
                        trainers.iter().enumerate().filter(|&(at, _)| at != out).map(|(_, &heard)| heard).collect();
                    Self::with_hold(&others, hold, shape).log_likelihood(trainers[out])
                })
                .sum()
        };
        let tried = HOLDS.into_iter().map(|hold| (hold, held_out(&hold)));
        let hold = tried.max_by(|(_, one), (_, other)| one.total_cmp(other)).map_or(HOLDS[0], |(hold, _)| hold);
        Self::with_hold(trainers, hold, shape)
    }

    fn with_hold(trainers: &[&FeedbackCounts], hold: f64, shape: Shape) -> Self {
        let (manner, lags, words) = BEFORE;
        let lags = if shape.lagging { lags } else { Strategy::NO_LAG.map(f64::from) };
        let before = Parameters { manners: [manner; 2], lags, shape };
        let fitted = |trainers: &[&FeedbackCounts], to: &Parameters, hold: f64| {
            (0..ROUNDS).fold(*to, |strategy, _| {
                let mut expected = Expected::default();
                trainers.iter().for_each(|heard| strategy.expect(heard, 1.0, &mut expected));
                expected.strategy(to, hold)
            })
        };
        let together = fitted(trainers, &before, words);
        let own = trainers.iter().map(|heard| fitted(&[heard], &together, hold));
        let start = most_different(trainers, together, own.collect(), MOST);
        let mut strategies: Vec<(Parameters, f64)> = start.into_iter().map(|strategy| (strategy, 1.0)).collect();
        let count = strategies.len() as f64;
        strategies.iter_mut().for_each(|(_, share)| *share = 1.0 / count);
        for _ in 0..ROUNDS {
            let shares: Vec<Vec<f64>> = trainers.iter().map(|heard| shares(&strategies, heard)).collect();
            let all: f64 = trainers.len() as f64 + count;
            for (at, (strategy, share)) in strategies.iter_mut().enumerate() {
                let mut expected = Expected::default();
                let mut sum = 1.0;
                for (heard, shares) in trainers.iter().zip(&shares) {
                    strategy.expect(heard, shares[at], &mut expected);
                    sum += shares[at];
                }
                // The first strategy stays that of all trainers together.
                if at > 0 {
                    *strategy = expected.strategy(&together, hold);
                }
                *share = sum / all;
            }
        }
        Self { strategies, hold }
    }

    /// The log likelihood of a trainer's feedback.
    pub fn log_likelihood(&self, heard: &FeedbackCounts) -> f64 {
        log_sum(&self.strategies.iter().map(|(strategy, share)| share.ln() + strategy.log_likelihood(heard)).collect::<Vec<f64>>())
    }

    /// The strategies with their shares, the largest first.
    pub fn strategies(&self) -> Vec<(Strategy, f32)> {
        let mut strategies = self.strategies.clone();
        strategies.sort_by(|one, other| other.1.total_cmp(&one.1));
        let round = |value: f64| ((value * 1_000.0).round() / 1_000.0) as f32;
        let strategy = |&(parameters, share): &(Parameters, f64)| {
            let [moves, rests] = parameters.manners.map(|Manner { silence: [plus, minus], mistake }| [plus, minus, mistake].map(round));
            let ([mu_plus, mu_minus, epsilon], [plus, minus, mistake]) = (moves, rests);
            let [_, before, earlier] = parameters.lags.map(round);
            let lags = [round(1.0 - f64::from(before) - f64::from(earlier)), before, earlier];
            let strategy = Strategy::new(mu_plus, mu_minus, epsilon).and_then(|strategy| strategy.with_lags(lags)).ok()?;
            let resting = strategy.with_rests([plus, minus, mistake, 1.0]).ok()?;
            Some((if parameters.shape.rests { resting } else { strategy }, round(share)))
        };
        strategies.iter().filter_map(strategy).collect()
    }
}

/// The strategy of all trainers together, and then those of single trainers, each chosen to raise the likelihood of all feedback most.
fn most_different(trainers: &[&FeedbackCounts], together: Parameters, mut own: Vec<Parameters>, most: usize) -> Vec<Parameters> {
    let mut chosen = vec![together];
    while chosen.len() < most && !own.is_empty() {
        let explained = |one: &Parameters| -> f64 {
            let among = |heard: &FeedbackCounts| {
                let logs = chosen.iter().chain([one]).map(|strategy| strategy.log_likelihood(heard));
                log_sum(&logs.collect::<Vec<f64>>())
            };
            trainers.iter().map(|heard| among(heard)).sum()
        };
        let worth: Vec<f64> = own.iter().map(explained).collect();
        let Some(best) = (0..own.len()).max_by(|&one, &other| worth[one].total_cmp(&worth[other])) else { break };
        chosen.push(own.swap_remove(best));
    }
    chosen
}

/// The logarithm of the sum of numbers that are given as logarithms.
fn log_sum(logs: &[f64]) -> f64 {
    let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    most + logs.iter().map(|log| (log - most).exp()).sum::<f64>().ln()
}

/// The probability of each strategy, given a trainer's feedback.
fn shares(strategies: &[(Parameters, f64)], heard: &FeedbackCounts) -> Vec<f64> {
    let logs: Vec<f64> = strategies.iter().map(|(strategy, share)| share.ln() + strategy.log_likelihood(heard)).collect();
    let whole = log_sum(&logs);
    logs.into_iter().map(|log| (log - whole).exp()).collect()
}

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
