//! Trainers like real people: rates fitted to each of them, and other people drawn from the fit.
//!
//! A person is silent, rewards or punishes with probabilities of its own after right and after wrong actions. Feedback is about the last
//! action or one of the two before, with shares that are the same for all people. Both are fitted together by expectation maximisation. A
//! person with little feedback has uncertain rates, so they are smoothed towards those of all. The weight is the most probable one.

use super::{Habits, LATEST};
use goodbot::feedback::Feedback;
use goodbot::random::below;
use goodbot_course::generator;
use rand_core::Rng;
use rand_distr::{Distribution, Gamma};

/// Rounds of expectation maximisation.
const ROUNDS: usize = 200;
/// The weights to choose from, in observations: how much the rates of all count beside those of one person.
const STRENGTHS: [f64; 7] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];

/// Separates the generator of people from the others of a seed.
const PEOPLE: u64 = 0x7065_6f70_6c65;

/// One step of a recorded lesson.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Observed {
    /// Whether the action was right for the intended task.
    pub correct: bool,
    /// Whether the goal was reached before it.
    pub at_goal: bool,
    /// The feedback before the next action.
    pub said: Feedback,
}

/// The recorded lessons of one person.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// The steps of each lesson.
    pub lessons: Vec<Vec<Observed>>,
    /// Whether each lesson was the last with its command: it was not continued in the same home.
    pub ended: Vec<bool>,
}

/// Counts of one person's rewards, punishments and silences, and of steps after which it left or stayed. They need not be whole: feedback
/// that may be about two actions counts in part for each.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Counts {
    /// After right actions.
    pub right: [f64; 3],
    /// After wrong actions.
    pub wrong: [f64; 3],
    /// At the goal: left, stayed.
    pub at_goal: [f64; 2],
    /// Elsewhere: left, stayed.
    pub elsewhere: [f64; 2],
}

/// A fit to several people.
#[derive(Clone, Debug, PartialEq)]
pub struct Population {
    /// The counts of each person.
    pub people: Vec<Counts>,
    /// The shares of feedback that are about the last action, the one before, and the one before that.
    pub late: [f64; LATEST + 1],
}

const fn person(right: [f64; 3], wrong: [f64; 3], at_goal: [f64; 2], elsewhere: [f64; 2]) -> Counts {
    Counts { right, wrong, at_goal, elsewhere }
}

/// The result of `goodbot study --fit` for the recorded sessions.
#[rustfmt::skip]
const FITTED: [Counts; 12] = [
    person([0.0, 0.5, 22.1], [0.0, 2.5, 16.9], [0.0, 0.0], [6.0, 36.0]),
    person([0.7, 0.7, 20.6], [0.3, 0.3, 15.4], [1.0, 0.0], [3.0, 34.0]),
    person([0.0, 0.0, 13.1], [0.0, 0.0, 11.9], [0.0, 0.0], [4.0, 21.0]),
    person([0.0, 0.0, 4.5], [0.0, 0.0, 0.5], [0.0, 0.0], [2.0, 3.0]),
    person([0.0, 0.0, 6.7], [0.0, 0.0, 4.3], [0.0, 0.0], [6.0, 5.0]),
    person([0.0, 0.0, 4.0], [0.0, 0.0, 1.0], [0.0, 0.0], [4.0, 1.0]),
    person([5.5, 1.1, 50.8], [0.5, 6.9, 16.2], [3.0, 4.0], [1.0, 73.0]),
    person([19.6, 5.2, 261.4], [6.4, 18.8, 231.6], [8.0, 92.0], [3.0, 440.0]),
    person([3.7, 7.0, 224.6], [1.3, 13.0, 391.4], [1.0, 34.0], [6.0, 600.0]),
    person([5.6, 0.0, 72.5], [2.4, 5.0, 27.5], [4.0, 9.0], [3.0, 97.0]),
    person([7.0, 2.0, 24.6], [6.0, 1.0, 30.4], [1.0, 5.0], [3.0, 62.0]),
    person([5.8, 1.1, 67.5], [0.2, 5.9, 13.5], [4.0, 22.0], [0.0, 68.0]),
];
/// The same, for the delay of feedback.
const FITTED_LATE: [f64; LATEST + 1] = [0.659, 0.297, 0.043];

const fn column(said: Feedback) -> usize {
    match said {
        Feedback::Reward => 0,
        Feedback::Punish => 1,
        Feedback::Neutral => 2,
    }
}

/// The sums of all people's counts, as shares.
fn shares<const N: usize>(counts: impl Iterator<Item = [f64; N]>) -> [f64; N] {
    // One more of each, so that an unseen event is not impossible.
    let mut sums = [1.0; N];
    for one in counts {
        sums.iter_mut().zip(one).for_each(|(sum, count)| *sum += count);
    }
    let whole: f64 = sums.iter().sum();
    sums.map(|sum| sum / whole)
}

/// The log likelihood of counts, if rates have a Dirichlet distribution with this mean and strength; without terms that do not depend on
/// these.
fn likelihood<const N: usize>(counts: [f64; N], mean: [f64; N], strength: f64) -> f64 {
    let whole: f64 = counts.iter().sum();
    let parts = counts.into_iter().zip(mean).map(|(count, mean)| libm::lgamma(count + strength * mean) - libm::lgamma(strength * mean));
    libm::lgamma(strength) - libm::lgamma(strength + whole) + parts.sum::<f64>()
}

/// A draw from a Dirichlet distribution.
fn dirichlet<const N: usize, R: Rng + ?Sized>(weights: [f64; N], random: &mut R) -> [f64; N] {
    let draws = weights.map(|weight| Gamma::new(weight.max(1e-3), 1.0).map_or(0.0, |gamma| gamma.sample(random)));
    let whole: f64 = draws.iter().sum();
    if whole > 0.0 { draws.map(|draw| draw / whole) } else { shares([weights].into_iter()) }
}

/// One person's counts plus those of all, which count as `strength` observations.
fn with_all<const N: usize>(counts: [f64; N], mean: [f64; N], strength: f64) -> [f64; N] {
    std::array::from_fn(|at| counts[at] + strength * mean[at])
}

impl Population {
    /// The fit to the recorded sessions of twelve people whom the paper's first author paid to train his agent.
    pub fn fitted() -> Self {
        Self { people: FITTED.to_vec(), late: FITTED_LATE }
    }

    /// A fit to recorded lessons.
    pub fn fit(records: &[Record]) -> Self {
        let mut fit = Self { people: vec![Counts::default(); records.len()], late: [0.8, 0.15, 0.05] };
        for round in 0..ROUNDS {
            let rates: Vec<[[f64; 3]; 2]> = match round {
                0 => vec![[[0.3, 0.1, 0.6], [0.1, 0.3, 0.6]]; records.len()],
                _ => fit.people.iter().map(|person| [shares([person.right].into_iter()), shares([person.wrong].into_iter())]).collect(),
            };
            let mut late = [0.0; LATEST + 1];
            for ((record, rates), counts) in records.iter().zip(rates).zip(&mut fit.people) {
                *counts = Counts::default();
                for lesson in &record.lessons {
                    for (step, observed) in lesson.iter().enumerate() {
                        let column = column(observed.said);
                        let meant = |lag: usize| step.checked_sub(lag).map(|earlier| usize::from(!lesson[earlier].correct));
                        let part = |lag: usize| meant(lag).map_or(0.0, |situation| fit.late[lag] * rates[situation][column]);
                        let parts: [f64; LATEST + 1] = std::array::from_fn(part);
                        let whole: f64 = parts.iter().sum();
                        for (lag, part) in parts.into_iter().enumerate() {
                            let share = part / whole;
                            // The first actions tell nothing about delays: no earlier action could be meant.
                            if step >= LATEST {
                                late[lag] += share;
                            }
                            let Some(situation) = meant(lag) else { continue };
                            let side = if situation == 0 { &mut counts.right } else { &mut counts.wrong };
                            side[column] += share;
                        }
                    }
                }
            }
            let whole: f64 = late.iter().sum();
            fit.late = late.map(|share| if whole > 0.0 { share / whole } else { 0.0 });
        }
        for (record, counts) in records.iter().zip(&mut fit.people) {
            for (lesson, &ended) in record.lessons.iter().zip(&record.ended) {
                for (step, observed) in lesson.iter().enumerate() {
                    let side = if observed.at_goal { &mut counts.at_goal } else { &mut counts.elsewhere };
                    side[usize::from(!(ended && step + 1 == lesson.len()))] += 1.0;
                }
            }
        }
        fit
    }

    /// The most probable weight of all people's rates beside those of one person, in observations.
    fn strength<const N: usize>(&self, of: impl Fn(&Counts) -> [f64; N]) -> f64 {
        let mean = shares(self.people.iter().map(&of));
        let all = |strength: f64| self.people.iter().map(|person| likelihood(of(person), mean, strength)).sum::<f64>();
        STRENGTHS.into_iter().max_by(|&a, &b| all(a).total_cmp(&all(b))).unwrap_or(1.0)
    }

    fn draw<const N: usize>(&self, person: &Counts, of: impl Fn(&Counts) -> [f64; N], random: &mut (impl Rng + ?Sized)) -> [f64; N] {
        let mean = shares(self.people.iter().map(&of));
        dirichlet(with_all(of(person), mean, self.strength(of)), random)
    }

    /// The person of a seed, similar to a random one of the fitted people.
    pub fn person(&self, seed: u64) -> Habits {
        let mut random = generator(seed ^ PEOPLE);
        match self.people.get(below(self.people.len(), &mut random)) {
            Some(like) => self.another(like, &mut random),
            None => Habits::MUTE,
        }
    }

    /// A new person, similar to this one.
    pub fn another<R: Rng + ?Sized>(&self, like: &Counts, random: &mut R) -> Habits {
        let mut words = |of: fn(&Counts) -> [f64; 3]| {
            let [reward, punish, _] = self.draw(like, of, random);
            [reward as f32, punish as f32]
        };
        let (right, wrong) = (words(|counts| counts.right), words(|counts| counts.wrong));
        let mut leaves = |of: fn(&Counts) -> [f64; 2]| self.draw(like, of, random)[0] as f32;
        let leaves = [leaves(|counts| counts.at_goal), leaves(|counts| counts.elsewhere)];
        Habits { right, wrong, late: self.late.map(|share| share as f32), leaves }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::trainer::Listening;

    /// The lessons of a person with these habits.
    fn record(habits: Habits, seed: u64) -> Record {
        let mut random = generator(seed);
        let lesson = |_| {
            let mut trainer = Listening::new(habits);
            let observed = |_| {
                let correct = below(2, &mut random) == 0;
                Observed { correct, at_goal: false, said: trainer.says(correct, &mut random) }
            };
            (0..30).map(observed).collect()
        };
        Record { lessons: (0..20).map(lesson).collect(), ended: vec![true; 20] }
    }

    #[test]
    fn a_fit_finds_out_how_late_words_come_and_what_each_person_does() {
        let strict = Habits { right: [0.0, 0.02], wrong: [0.0, 0.5], late: [0.2, 0.8, 0.0], leaves: [0.0; 2] };
        let kind = Habits { right: [0.5, 0.0], wrong: [0.05, 0.0], ..strict };
        let fit = Population::fit(&[record(strict, 1), record(kind, 2)]);
        assert!((fit.late[1] - 0.8).abs() < 0.05, "{:?}", fit.late);
        let rate = |counts: [f64; 3], column: usize| counts[column] / counts.iter().sum::<f64>();
        assert!((rate(fit.people[0].wrong, 1) - 0.5).abs() < 0.08, "{:?}", fit.people[0]);
        assert!((rate(fit.people[1].right, 0) - 0.5).abs() < 0.08, "{:?}", fit.people[1]);
    }

    #[test]
    fn people_are_like_those_that_were_fitted_but_no_two_are_the_same() {
        let population = Population::fitted();
        let people: Vec<Habits> = (0..400).map(|seed| population.person(seed)).collect();
        assert_eq!(people[7], population.person(7));
        assert_ne!(people[7], people[8]);
        // Real trainers are silent after nine actions out of ten.
        let silent = people.iter().map(|person| 1.0 - f64::from(person.right[0] + person.right[1])).sum::<f64>() / 400.0;
        assert!((0.85..0.97).contains(&silent), "{silent}");
        assert!(people.iter().all(|person| person.right[0] + person.right[1] <= 1.0 && person.leaves[1] < 1.0));
    }
}
