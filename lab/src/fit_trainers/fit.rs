//! A population of trainer strategies, fitted to what real trainers said.
//!
//! Each trainer follows one strategy of the population; which one is not known, and neither is which action a word was about nor what the
//! trainer took that action for. Expectation maximisation finds strategies and shares under which the words are most probable. There is
//! much less to be seen of one trainer than three probabilities and a lag take, so every strategy is held to what all trainers together do:
//! as if each had said so many words more, as they do on average ([`Fit::hold`]). How many is chosen inside the training data, by
//! leaving one trainer out.

use super::walk::Walk;
use goodbot::feedback::{Feedback, LAGS, Strategy};
use goodbot::planning::Judgement;
use std::collections::BTreeMap;

/// The most strategies of a population.
pub const MOST: usize = 16;
/// Rounds of expectation maximisation.
const ROUNDS: usize = 30;
/// From how many words of all trainers the hold is chosen.
const HOLDS: [f64; 4] = [3.0, 10.0, 30.0, 100.0];
/// What is thought of trainers before anything is seen, as if so many words had been.
const BEFORE: (Parameters, f64) = (Parameters { silence: [0.85, 0.85], mistake: 0.2, lags: [0.7, 0.2, 0.1] }, 3.0);
/// Who mistakes more than this means the opposite of what is said.
const MOST_MISTAKEN: f64 = 0.45;

/// What a strategy is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Parameters {
    /// Silence after what was taken for right, and for wrong.
    silence: [f64; 2],
    mistake: f64,
    lags: [f64; LAGS],
}

/// What one trainer said: how often each feedback came after each history of right and wrong actions, the last one first.
#[derive(Clone, Debug, Default)]
pub struct Heard(BTreeMap<(u8, [u8; LAGS]), f64>);

const UNKNOWN: u8 = 2;

impl Heard {
    /// Adds what was said in a session whose intended task is known.
    pub fn add(&mut self, walk: &Walk) {
        let Some(intended) = walk.intended else { return };
        let mut judged = [UNKNOWN; LAGS];
        for step in &walk.steps {
            let now = match step.judged.get(intended) {
                Some(Judgement::Correct) => 0,
                Some(Judgement::Incorrect) => 1,
                _ => UNKNOWN,
            };
            let [last, before, _] = judged;
            judged = [now, last, before];
            let feedback = match step.feedback {
                Feedback::Reward => 0,
                Feedback::Punish => 1,
                Feedback::Neutral => 2,
            };
            *self.0.entry((feedback, judged)).or_default() += 1.0;
        }
    }

    fn words(&self) -> f64 {
        self.0.iter().filter(|((feedback, _), _)| *feedback != 2).map(|(_, count)| count).sum::<f64>()
            / self.0.values().sum::<f64>().max(1.0)
    }
}

/// All sessions by trainer.
pub fn by_trainer(walks: &[Walk]) -> BTreeMap<&str, Heard> {
    let mut trainers: BTreeMap<&str, Heard> = BTreeMap::new();
    for walk in walks {
        trainers.entry(&walk.trainer).or_default().add(walk);
    }
    trainers.retain(|_, heard| !heard.0.is_empty());
    trainers
}

/// What is expected of the hidden parts of what was said, under a strategy.
#[derive(Clone, Copy, Debug, Default)]
struct Expected {
    /// How often an action was taken for right, and for wrong.
    taken: [f64; 2],
    /// How often silence followed.
    silent: [f64; 2],
    mistaken: f64,
    all: f64,
    lags: [f64; LAGS],
}

impl Parameters {
    /// The probability of each hidden part with a feedback: the lag, and what the action was taken for.
    fn parts(&self, feedback: u8, judged: [u8; LAGS]) -> impl Iterator<Item = (usize, usize, bool, f64)> + '_ {
        let lags = self.lags.into_iter().zip(judged).enumerate();
        let known: f64 = lags.clone().filter(|&(_, (_, judged))| judged != UNKNOWN).map(|(_, (lag, _))| lag).sum();
        let known = lags
            .filter(move |&(_, (lag, judged))| judged != UNKNOWN && lag > 0.0)
            .map(move |(at, (lag, judged))| (at, lag / known, judged));
        known.flat_map(move |(at, lag, judged)| {
            [0_u8, 1].into_iter().zip(self.silence).map(move |(taken, silence)| {
                let seen = if taken == judged { 1.0 - self.mistake } else { self.mistake };
                let said = match feedback {
                    2 => silence,
                    feedback if feedback == taken => 1.0 - silence,
                    _ => 0.0,
                };
                (at, usize::from(taken), taken != judged, lag * seen * said)
            })
        })
    }

    /// The logarithm of the probability of all that a trainer said.
    fn log_likelihood(&self, heard: &Heard) -> f64 {
        let log = |(&(feedback, judged), count): (&(u8, [u8; LAGS]), &f64)| {
            if judged.iter().zip(self.lags).all(|(&judged, lag)| judged == UNKNOWN || lag == 0.0) {
                return 0.0;
            }
            count * self.parts(feedback, judged).map(|(.., probability)| probability).sum::<f64>().max(1e-12).ln()
        };
        heard.0.iter().map(log).sum()
    }

    fn expect(&self, heard: &Heard, share: f64, expected: &mut Expected) {
        for (&(feedback, judged), count) in &heard.0 {
            let whole: f64 = self.parts(feedback, judged).map(|(.., probability)| probability).sum();
            if whole <= 0.0 {
                continue;
            }
            for (lag, taken, mistaken, probability) in self.parts(feedback, judged) {
                let part = share * count * probability / whole;
                expected.lags[lag] += part;
                expected.taken[taken] += part;
                expected.silent[taken] += if feedback == 2 { part } else { 0.0 };
                expected.mistaken += if mistaken { part } else { 0.0 };
                expected.all += part;
            }
        }
    }
}

impl Expected {
    /// The most probable strategy, held to another one as if that had been seen in so many words.
    fn strategy(&self, to: &Parameters, hold: f64, lagging: bool) -> Parameters {
        let share = |part: f64, whole: f64, before: f64| (part + hold * before) / (whole + hold);
        let silence = [0, 1].map(|taken| share(self.silent[taken], self.taken[taken], to.silence[taken]));
        let lag = |position: usize| share(self.lags[position], self.all, to.lags[position]);
        let lags = if lagging { [lag(0), lag(1), lag(2)] } else { Strategy::NO_LAG.map(f64::from) };
        Parameters { silence, mistake: share(self.mistaken, self.all, to.mistake).min(MOST_MISTAKEN), lags }
    }
}

/// A fitted population.
#[derive(Clone, Debug)]
pub struct Fit {
    strategies: Vec<(Parameters, f64)>,
    /// How many words of all trainers hold each strategy to them.
    pub hold: f64,
}

impl Fit {
    /// Fits a population to what trainers said. One strategy is what all do together, and each other one begins as one trainer's own; of
    /// more trainers than there can be strategies, those who say ever more words take turns.
    pub fn to(trainers: &[&Heard], lagging: bool) -> Self {
        let held_out = |&hold: &f64| -> f64 {
            (0..trainers.len())
                .map(|out| {
                    let others: Vec<&Heard> = trainers.iter().enumerate().filter(|&(at, _)| at != out).map(|(_, &heard)| heard).collect();
                    Self::with_hold(&others, hold, lagging).log_likelihood(trainers[out])
                })
                .sum()
        };
        let tried = HOLDS.into_iter().map(|hold| (hold, held_out(&hold)));
        let hold = tried.max_by(|(_, one), (_, other)| one.total_cmp(other)).map_or(HOLDS[0], |(hold, _)| hold);
        Self::with_hold(trainers, hold, lagging)
    }

    fn with_hold(trainers: &[&Heard], hold: f64, lagging: bool) -> Self {
        let mut together = BEFORE.0;
        if !lagging {
            together.lags = Strategy::NO_LAG.map(f64::from);
        }
        let fitted = |trainers: &[&Heard], from: Parameters, to: &Parameters, hold: f64, rounds: usize| {
            (0..rounds).fold(from, |strategy, _| {
                let mut expected = Expected::default();
                trainers.iter().for_each(|heard| strategy.expect(heard, 1.0, &mut expected));
                expected.strategy(to, hold, lagging)
            })
        };
        let before = together;
        together = fitted(trainers, together, &before, BEFORE.1, ROUNDS);
        let mut sorted = trainers.to_vec();
        sorted.sort_by(|one, other| one.words().total_cmp(&other.words()));
        let own = sorted.len().min(MOST - 1);
        let chosen = (0..own).filter_map(|at| sorted.get(at * sorted.len() / own.max(1)).copied());
        let start = chosen.map(|heard| fitted(&[heard], together, &together, hold, ROUNDS));
        let mut strategies: Vec<(Parameters, f64)> = std::iter::once(together).chain(start).map(|strategy| (strategy, 1.0)).collect();
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
                // The first is what all do together.
                if at > 0 {
                    *strategy = expected.strategy(&together, hold, lagging);
                }
                *share = sum / all;
            }
        }
        Self { strategies, hold }
    }

    /// The logarithm of the probability of all that a trainer said.
    pub fn log_likelihood(&self, heard: &Heard) -> f64 {
        let logs: Vec<f64> = self.strategies.iter().map(|(strategy, share)| share.ln() + strategy.log_likelihood(heard)).collect();
        let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        most + logs.iter().map(|log| (log - most).exp()).sum::<f64>().ln()
    }

    /// The strategies with their shares, the largest first.
    pub fn strategies(&self) -> Vec<(Strategy, f32)> {
        let mut strategies = self.strategies.clone();
        strategies.sort_by(|one, other| other.1.total_cmp(&one.1));
        let round = |value: f64| ((value * 1_000.0).round() / 1_000.0) as f32;
        let strategy = |&(parameters, share): &(Parameters, f64)| {
            let [mu_plus, mu_minus] = parameters.silence.map(round);
            let [_, before, earlier] = parameters.lags.map(round);
            let lags = [round(1.0 - f64::from(before) - f64::from(earlier)), before, earlier];
            let strategy = Strategy::new(mu_plus, mu_minus, round(parameters.mistake)).and_then(|strategy| strategy.with_lags(lags));
            Some((strategy.ok()?, round(share)))
        };
        strategies.iter().filter_map(strategy).collect()
    }
}

/// The probability of each strategy given what a trainer said.
fn shares(strategies: &[(Parameters, f64)], heard: &Heard) -> Vec<f64> {
    let logs: Vec<f64> = strategies.iter().map(|(strategy, share)| share.ln() + strategy.log_likelihood(heard)).collect();
    let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let parts: Vec<f64> = logs.iter().map(|log| (log - most).exp()).collect();
    let whole: f64 = parts.iter().sum();
    parts.into_iter().map(|part| part / whole).collect()
}
