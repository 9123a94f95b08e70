//! The beliefs that a robot with certain expectations would have had in recorded sessions, and how right they were.

use crate::calibration;
use crate::calibration::{RANGES, Range, ranges};
use crate::recorded::Walk;
use goodbot::feedback::{Belief, BeliefCount, BeliefTables, Ending, Judged, LAGS, Strategy, population};
use goodbot::probability::Scaled;
use goodbot::random::{below, unit};
use goodbot_course::generator;
use serde_json::{Value, json};

/// The intended task counts as given up below this probability.
pub const GIVEN_UP: f64 = 0.05;
/// In the logarithm, a probability of 0 counts as this one.
const LEAST: f64 = 1e-12;
/// The number of draws of each simulation.
const DRAWS: usize = 1_000;

/// The expectation about trainers.
#[derive(Clone, Debug)]
pub struct Expectation {
    /// The strategies and their shares.
    pub strategies: Vec<(Strategy, f32)>,
    /// How far they drift back to their priors between sessions.
    pub drift: f32,
    /// The evidence in the end of a session.
    pub ending: Ending,
}

/// The rightness of beliefs at the end of sessions.
#[derive(Clone, Debug, Default)]
pub struct Rightness {
    /// The intended task's probability at the end of each session with feedback, and whether it was the only most likely task.
    ends: Vec<(f64, bool)>,
    /// The probability of each task, and whether it was the intended one.
    tasks: Vec<(f64, bool)>,
    /// The number of tasks of each session, and whether it continued the command of the one before.
    sessions: Vec<(usize, bool)>,
}

impl Rightness {
    /// Adds the belief at the end of a session, which may continue the command of the one before.
    pub fn add(&mut self, probabilities: &[f64], intended: usize, continues: bool) {
        let Some(&probability) = probabilities.get(intended) else { return };
        let others = probabilities.iter().enumerate().filter(|&(task, _)| task != intended);
        self.ends.push((probability, others.clone().all(|(_, &other)| probability > other)));
        self.tasks.extend(probabilities.iter().enumerate().map(|(task, &other)| (other, task == intended)));
        self.sessions.push((probabilities.len(), continues));
    }

    /// Adds the sessions of another.
    pub fn extend(&mut self, other: Self) {
        self.ends.extend(other.ends);
        self.tasks.extend(other.tasks);
        self.sessions.extend(other.sessions);
    }

    /// The number of sessions.
    pub fn sessions(&self) -> usize {
        self.sessions.len()
    }

    fn mean(&self, value: impl Fn(&(f64, bool)) -> f64) -> f64 {
        self.ends.iter().map(value).sum::<f64>() / self.ends.len().max(1) as f64
    }

    /// The share of sessions in which the intended task was the only most likely one.
    pub fn on_top(&self) -> f64 {
        self.mean(|&(_, alone)| f64::from(u8::from(alone)))
    }

    /// The mean of minus the natural logarithm of the intended task's probability.
    pub fn log_loss(&self) -> f64 {
        self.mean(|&(probability, _)| -probability.max(LEAST).ln())
    }

    /// The share of sessions in which the intended task had less than [`GIVEN_UP`].
    pub fn given_up(&self) -> f64 {
        self.mean(|&(probability, _)| f64::from(u8::from(probability < GIVEN_UP)))
    }

    /// All tasks of all sessions by their probability at the end, and how many of them were intended.
    pub fn reliability(&self) -> [Range; RANGES] {
        ranges(self.tasks.iter().copied())
    }

    /// The mean difference between the probabilities of tasks and the shares of intended tasks.
    pub fn calibration_error(&self) -> f64 {
        calibration::error(&self.reliability())
    }

    /// The calibration error that perfectly calibrated beliefs would have: its mean, and its 97.5 % quantile. Sessions with one command have
    /// one intended task, drawn from the belief at the end of the last one.
    pub fn calibration_error_of_chance(&self) -> (f64, f64) {
        let mut random = generator(1);
        let mut errors = [0.0; DRAWS].map(|_: f64| {
            let (mut left, mut meant, mut goes_on) = (self.tasks.as_slice(), 0, false);
            let mut drawn = Vec::with_capacity(left.len());
            for &(count, continues) in self.sessions.iter().rev() {
                let (before, tasks) = left.split_at(left.len() - count);
                left = before;
                if !goes_on {
                    let mut above = f64::from(unit(&mut random));
                    let passed = |&&(probability, _): &&(f64, bool)| {
                        above -= probability;
                        above > 0.0
                    };
                    meant = tasks.iter().take_while(passed).count();
                }
                goes_on = continues;
                drawn.extend(tasks.iter().enumerate().map(|(task, &(probability, _))| (probability, task == meant)));
            }
            calibration::error(&ranges(drawn.into_iter()))
        });
        errors.sort_by(f64::total_cmp);
        (errors.iter().sum::<f64>() / DRAWS as f64, errors[DRAWS - 1 - DRAWS / 40])
    }

    /// The figures as a line of JSON.
    pub fn json(&self) -> Value {
        let range = |range: &Range| json!({"count": range.count, "mean_probability": range.certainty(), "share_meant": range.accuracy()});
        json!({
            "episodes_with_feedback": self.sessions(),
            "intended_alone_on_top": self.on_top(),
            "mean_log_loss": self.log_loss(),
            "intended_below_5_percent": self.given_up(),
            "calibration_error": self.calibration_error(),
            "reliability": self.reliability().iter().map(range).collect::<Vec<_>>(),
        })
    }
}

/// 95 % intervals of the mean log loss and of the calibration error, by a bootstrap over the trainers.
pub fn intervals(trainers: &[Rightness]) -> [[f64; 2]; 2] {
    let mut random = generator(1);
    let drawn = (0..DRAWS).map(|_| {
        let mut all = Rightness::default();
        trainers.iter().for_each(|_| all.extend(trainers[below(trainers.len(), &mut random)].clone()));
        (all.log_loss(), all.calibration_error())
    });
    let (losses, errors): (Vec<f64>, Vec<f64>) = drawn.unzip();
    [losses, errors].map(|mut values| {
        values.sort_by(f64::total_cmp);
        [values[DRAWS / 40], values[DRAWS - 1 - DRAWS / 40]]
    })
}

/// Replays the sessions with a robot that has this expectation, and returns its beliefs at the end of each session with feedback.
pub fn replay<'a>(walks: impl Iterator<Item = &'a Walk>, expectation: &Expectation) -> Rightness {
    let (tasks, strategies) = (goodbot::Capacities::STANDARD.tasks, expectation.strategies.len());
    let (mut joint, mut settled) = (vec![Scaled::ZERO; tasks * strategies], vec![Scaled::ZERO; tasks * strategies]);
    let (mut priors, mut known) = (vec![Scaled::ZERO; tasks], vec![(Strategy::UNUSED, 0.0); strategies]);
    let (mut expected, mut count) = (vec![0.0; strategies], BeliefCount::NONE);
    let tables =
        BeliefTables { joint: &mut joint, settled: &mut settled, priors: &mut priors, strategies: &mut known, expected: &mut expected };
    let mut belief = Belief::new(tables, &mut count);
    let (mut rightness, mut trainer) = (Rightness::default(), None);
    // Whether the command of the last session in `rightness` goes on.
    let mut same = false;
    for walk in walks {
        if trainer != Some(&walk.trainer) {
            trainer = Some(&walk.trainer);
            // Both fit and are valid: they come from a fit, or were checked when typed.
            let _ = belief.set_strategies(&expectation.strategies);
        }
        if !walk.continues {
            let _ = belief.restart(walk.prior.iter().map(|&prior| Scaled::new(prior)), expectation.drift);
            same = false;
        }
        walk_through(&mut belief, walk, &expectation.ending);
        if let (Some(intended), true) = (walk.intended, walk.has_feedback()) {
            let probabilities: Vec<f64> = (0..walk.prior.len()).map(|task| f64::from(belief.read().probability(task))).collect();
            rightness.add(&probabilities, intended, same);
            same = true;
        }
    }
    rightness
}

fn walk_through(belief: &mut Belief<'_>, walk: &Walk, ending: &Ending) {
    let judgement = |position: Option<usize>, task: usize| {
        let step = position.and_then(|position| walk.steps.get(position));
        step.and_then(|step| step.judged.get(task)).copied().unwrap_or_default()
    };
    for (position, step) in walk.steps.iter().enumerate() {
        belief.settle();
        let judged = |task: usize| -> [Judged; LAGS] {
            [Some(position), position.checked_sub(1), position.checked_sub(2)].map(|position| judgement(position, task))
        };
        let _ = belief.observe_feedback(step.feedback, judged);
        belief.settle();
        if ending.is_evidence() {
            let ends = position + 1 == walk.steps.len();
            let _ = belief.observe(&|_, task| Some(ending.probability(ends, step.at_goal.get(task).copied().flatten()?, step.moment)));
            belief.settle();
        }
    }
}

// Trainers who judge every step rightly: none was recorded, but a careful player is one. With recorded trainers, their silence refutes the exact
// ones, so these cost almost nothing. Without them, a robot takes five right words in a row for the noise of a talkative trainer.

/// The shares of exact trainers to try: none of twelve recorded trainers was exact, so at most about one in ten.
const SHARES: [f32; 3] = [0.02, 0.05, 0.1];
/// The most log loss that they may cost recorded trainers.
const COST: f64 = 0.01;

/// The strategies with exact ones added, which get this share.
fn with_share(strategies: &[(Strategy, f32)], share: f32) -> Vec<(Strategy, f32)> {
    let thousandth = |share: f32| (share * 1_000.0).round() / 1_000.0;
    let fitted = strategies.iter().map(|&(strategy, part)| (strategy, thousandth(part * (1.0 - share))));
    fitted.chain(population::exact().map(|(strategy, part)| (strategy, thousandth(part * share)))).collect()
}

/// The strategies with exact ones added, with the largest share that costs the trainers of these sessions almost nothing.
pub fn added(expected: &Expectation, walks: &[&Walk]) -> Vec<(Strategy, f32)> {
    let loss = |strategies: Vec<(Strategy, f32)>| replay(walks.iter().copied(), &Expectation { strategies, ..expected.clone() }).log_loss();
    let without = loss(expected.strategies.clone());
    let share = SHARES.into_iter().rev().find(|&share| loss(with_share(&expected.strategies, share)) <= without + COST);
    share.map_or_else(|| expected.strategies.clone(), |share| with_share(&expected.strategies, share))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chance_draws_one_task_for_all_sessions_with_one_command() {
        let chance = |continues: bool| {
            let mut rightness = Rightness::default();
            (0..100).for_each(|session| rightness.add(&[0.7, 0.3], 0, continues && session > 0));
            rightness.calibration_error_of_chance()
        };
        let ((apart, _), (together, most)) = (chance(false), chance(true));
        assert!(apart < 0.05, "{apart}");
        // One draw: the whole difference is .3 seven times in ten, else .7.
        assert!((together - 0.42).abs() < 0.03 && (most - 0.7).abs() < 1e-6, "{together} {most}");
    }
}
