//! The joint belief over tasks and trainer strategies (SABL with one strategy, I-SABL with several; paper, section 3 and footnote 1).
//!
//! What is kept for each task and strategy is the strategy's probability at the start times the probability of all evidence so far.
//! The task's prior, which the language model gives, stands beside it: the posterior is their product, renormalised. Both are
//! [`Scaled`], so a task that looked hopeless for a thousand steps can still come back.

use super::Judgement;
use super::strategy::{Feedback, Strategy, StrategyError};
use crate::capacity::{Capacity, CapacityError};
use crate::probability::{Scaled, total};

/// Memory for a [`Belief`].
#[derive(Debug)]
pub struct BeliefMemory<'m> {
    /// One entry for each task and strategy.
    pub joint: &'m mut [Scaled],
    /// The same, as it was before the last piece of evidence.
    pub settled: &'m mut [Scaled],
    /// One entry a task: its prior.
    pub priors: &'m mut [Scaled],
    /// One entry a strategy, with its probability.
    pub strategies: &'m mut [(Strategy, f32)],
}

/// The joint belief over tasks and trainer strategies.
#[derive(Debug)]
pub struct Belief<'m> {
    memory: BeliefMemory<'m>,
    tasks: usize,
    strategies: usize,
}

impl<'m> Belief<'m> {
    /// A belief about no tasks, in a trainer of the paper's balanced strategy.
    pub fn new(memory: BeliefMemory<'m>) -> Self {
        let mut belief = Self { memory, tasks: 0, strategies: 0 };
        let _ = belief.set_strategies(&[(Strategy::BALANCED, 1.0)]);
        belief
    }

    /// Replaces the strategies and their probabilities, which are renormalised.
    ///
    /// # Errors
    /// A [`BeliefError`]; the belief is then as before.
    pub fn set_strategies(&mut self, strategies: &[(Strategy, f32)]) -> Result<(), BeliefError> {
        let limit = self.memory.strategies.len();
        if strategies.len() > limit {
            return Err(CapacityError::new(Capacity::Strategies, limit, strategies.len()).into());
        }
        let mut sum = 0.0;
        for &(_, prior) in strategies {
            if !(0.0..=1.0).contains(&prior) {
                return Err(StrategyError::Prior.into());
            }
            sum += prior;
        }
        if sum <= 0.0 {
            return Err(StrategyError::Prior.into());
        }
        for (slot, &(strategy, prior)) in self.memory.strategies.iter_mut().zip(strategies) {
            *slot = (strategy, prior / sum);
        }
        self.strategies = strategies.len();
        self.tasks = 0;
        Ok(())
    }

    /// How many strategies there is room for.
    pub(crate) fn most_strategies(&self) -> usize {
        self.memory.strategies.len()
    }

    /// Takes strategies with exactly these probabilities, which were checked and fit; none leaves those that are. The belief is then about
    /// no tasks.
    pub(crate) fn take_over(&mut self, strategies: impl Iterator<Item = (Strategy, f32)>) {
        let mut count = 0_usize;
        for (slot, strategy) in self.memory.strategies.iter_mut().zip(strategies) {
            *slot = strategy;
            count = count.saturating_add(1);
        }
        if count > 0 {
            self.strategies = count;
        }
        self.tasks = 0;
    }

    /// Starts again with these task priors; the strategies' marginals so far are kept.
    ///
    /// # Errors
    /// A [`CapacityError`] where there is no room for so many tasks and strategies; the belief is then about no tasks.
    pub fn restart(&mut self, priors: impl ExactSizeIterator<Item = Scaled>) -> Result<(), CapacityError> {
        if self.tasks > 0 {
            for strategy in 0..self.strategies {
                let marginal = self.strategy_probability(strategy);
                if let Some(slot) = self.memory.strategies.get_mut(strategy) {
                    slot.1 = marginal;
                }
            }
        }
        self.tasks = 0;
        let count = priors.len();
        let wanted = count.saturating_mul(self.strategies);
        let limit = self.memory.joint.len().min(self.memory.settled.len());
        if wanted > limit {
            return Err(CapacityError::new(Capacity::Beliefs, limit, wanted));
        }
        if count > self.memory.priors.len() {
            return Err(CapacityError::new(Capacity::Tasks, self.memory.priors.len(), count));
        }
        for (slot, prior) in self.memory.priors.iter_mut().zip(priors) {
            *slot = prior;
        }
        let strategies = self.memory.strategies.get(..self.strategies).unwrap_or(&[]);
        for row in self.memory.joint.chunks_mut(self.strategies.max(1)).take(count) {
            for (slot, &(_, probability)) in row.iter_mut().zip(strategies) {
                *slot = Scaled::new(probability);
            }
        }
        self.tasks = count;
        self.settle();
        Ok(())
    }

    /// Settles the last piece of evidence: the next one counts beside it, and no longer replaces it.
    pub fn settle(&mut self) {
        self.memory.settled.iter_mut().zip(self.memory.joint.iter()).for_each(|(settled, joint)| *settled = *joint);
    }

    /// Replaces the prior of one task; nothing for a task that there is not.
    pub fn set_prior(&mut self, task: usize, prior: Scaled) {
        if let Some(slot) = self.memory.priors.get_mut(..self.tasks).and_then(|priors| priors.get_mut(task)) {
            *slot = prior;
        }
    }

    /// How many tasks.
    pub fn tasks(&self) -> usize {
        self.tasks
    }

    /// The strategies, with the probability that each had when this session began.
    pub fn strategies(&self) -> &[(Strategy, f32)] {
        self.memory.strategies.get(..self.strategies).unwrap_or(&[])
    }

    fn row(&self, task: usize) -> &[Scaled] {
        let start = task.saturating_mul(self.strategies);
        self.memory.joint.get(start..start.saturating_add(self.strategies)).filter(|_| task < self.tasks).unwrap_or(&[])
    }

    fn prior(&self, task: usize) -> Scaled {
        self.memory.priors.get(task).copied().filter(|_| task < self.tasks).unwrap_or(Scaled::ZERO)
    }

    /// Pr(evidence | task), all strategies together.
    pub fn evidence(&self, task: usize) -> Scaled {
        total(self.row(task).iter().copied())
    }

    /// Pr(evidence | task) times the task's prior: its posterior before renormalisation.
    pub fn weight(&self, task: usize) -> Scaled {
        self.prior(task).times(self.evidence(task))
    }

    /// All tasks' weights together.
    pub fn whole(&self) -> Scaled {
        total((0..self.tasks).map(|task| self.weight(task)))
    }

    /// The posterior probability of a task.
    pub fn probability(&self, task: usize) -> f32 {
        self.weight(task).over(self.whole()).clamp(0.0, 1.0)
    }

    /// The posterior probability of a strategy.
    pub fn strategy_probability(&self, strategy: usize) -> f32 {
        let whole = self.whole();
        if whole.is_zero() {
            return self.strategies().get(strategy).map_or(0.0, |&(_, probability)| probability);
        }
        total((0..self.tasks).map(|task| self.weight_with(task, strategy))).over(whole).clamp(0.0, 1.0)
    }

    fn weight_with(&self, task: usize, strategy: usize) -> Scaled {
        self.row(task).get(strategy).map_or(Scaled::ZERO, |joint| joint.times(self.prior(task)))
    }

    /// Takes in the feedback to one action. `judgement` says how the action relates to each task. A task whose judgement is unknown gets
    /// the posterior-weighted mean likelihood of the others: no evidence for or against it. Evidence that every task and strategy holds
    /// impossible is ignored, and `false` given.
    pub fn observe_feedback(&mut self, feedback: Feedback, judgement: impl Fn(usize) -> Judgement) -> bool {
        self.observe(|strategy, task| match judgement(task) {
            Judgement::Correct => Some(strategy.probability(feedback, true)),
            Judgement::Incorrect => Some(strategy.probability(feedback, false)),
            Judgement::Unknown => None,
        })
    }

    /// Takes in one piece of evidence by its likelihood for each strategy and task, `None` where that is unknown. It replaces the evidence
    /// since [`settle`](Self::settle). Evidence that every task and strategy holds impossible is ignored, and `false` given.
    pub fn observe(&mut self, likelihood: impl Fn(&Strategy, usize) -> Option<f32>) -> bool {
        let likely = |belief: &Self, task: usize, column: usize| {
            let (strategy, _) = belief.strategies().get(column)?;
            likelihood(strategy, task)
        };
        let settled = |belief: &Self, task: usize, column: usize| {
            let at = task.saturating_mul(belief.strategies).saturating_add(column);
            belief.memory.settled.get(at).copied().unwrap_or(Scaled::ZERO)
        };
        let possible = (0..self.tasks).any(|task| {
            (0..self.strategies).any(|column| {
                likely(self, task, column).is_some_and(|value| value > 0.0)
                    && !settled(self, task, column).times(self.prior(task)).is_zero()
            })
        });
        if !possible {
            return false;
        }
        self.memory.joint.iter_mut().zip(self.memory.settled.iter()).for_each(|(joint, settled)| *joint = *settled);
        for column in 0..self.strategies {
            let (mut known, mut explained) = (Scaled::ZERO, Scaled::ZERO);
            for task in 0..self.tasks {
                if let Some(value) = likely(self, task, column) {
                    let weight = self.weight_with(task, column);
                    known = known.plus(weight);
                    explained = explained.plus(weight.scaled_by(value));
                }
            }
            let mean = if known.is_zero() { 1.0 } else { explained.over(known) };
            for task in 0..self.tasks {
                let value = likely(self, task, column).unwrap_or(mean);
                let at = task.saturating_mul(self.strategies).saturating_add(column);
                if let Some(joint) = self.memory.joint.get_mut(at) {
                    *joint = joint.scaled_by(value);
                }
            }
        }
        true
    }
}

/// Why a belief refused its strategies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BeliefError {
    /// A strategy's probability is none.
    Strategy(StrategyError),
    /// Something was full.
    Capacity(CapacityError),
}

impl From<StrategyError> for BeliefError {
    fn from(error: StrategyError) -> Self {
        Self::Strategy(error)
    }
}

impl From<CapacityError> for BeliefError {
    fn from(error: CapacityError) -> Self {
        Self::Capacity(error)
    }
}
