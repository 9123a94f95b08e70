//! The joint belief over tasks and trainer strategies (SABL with one strategy, I-SABL with several; paper, section 3 and footnote 1).
//!
//! For each task and strategy the belief has the strategy's probability at the start times the likelihood of all evidence so far. The
//! task's prior, from the language model, is stored separately: the posterior is their product, renormalised. Both are [`Scaled`], so a
//! task that looked hopeless for a thousand steps can still recover.

use super::judged::Judged;
use super::strategy::{Feedback, LAGS, Strategy};
use crate::capacity::{Capacity, CapacityError};
use crate::decimal::Decimal;
use crate::memory::{BeliefTables, BeliefTablesRef};
use crate::probability::{Scaled, total};

/// The numbers of tasks and strategies of a belief.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BeliefCount {
    tasks: usize,
    strategies: usize,
}

impl BeliefCount {
    /// A belief without tasks and strategies.
    pub const NONE: Self = Self { tasks: 0, strategies: 0 };
}

/// The joint belief over tasks and trainer strategies.
#[derive(Debug)]
pub struct Belief<'t> {
    memory: BeliefTables<'t>,
    count: &'t mut BeliefCount,
}

/// The joint belief over tasks and trainer strategies, read-only.
#[derive(Clone, Copy, Debug)]
pub struct BeliefRef<'t> {
    memory: BeliefTablesRef<'t>,
    count: BeliefCount,
}

impl<'t> BeliefRef<'t> {
    /// The belief in these tables.
    pub const fn new(memory: BeliefTablesRef<'t>, count: BeliefCount) -> Self {
        Self { memory, count }
    }

    /// The most strategies that there is room for.
    pub(crate) fn most_strategies(self) -> usize {
        self.memory.strategies.len().min(self.memory.expected.len())
    }

    /// The number of tasks.
    pub const fn tasks(self) -> usize {
        self.count.tasks
    }

    /// The strategies, each with its probability at the start of this session.
    pub fn strategies(self) -> &'t [(Strategy, f32)] {
        self.memory.strategies.get(..self.count.strategies).unwrap_or(&[])
    }

    /// The probability of a strategy before this trainer was met.
    pub fn expected(self, strategy: usize) -> f32 {
        self.memory.expected.get(..self.count.strategies).and_then(|expected| expected.get(strategy)).copied().unwrap_or(0.0)
    }

    #[inline(never)]
    fn row(self, task: usize) -> &'t [Scaled] {
        let start = task.saturating_mul(self.count.strategies);
        self.memory.joint.get(start..start.saturating_add(self.count.strategies)).filter(|_| task < self.count.tasks).unwrap_or(&[])
    }

    /// The unnormalised prior of a task.
    pub fn prior(self, task: usize) -> Scaled {
        self.memory.priors.get(task).copied().filter(|_| task < self.count.tasks).unwrap_or(Scaled::ZERO)
    }

    /// Pr(evidence | task), summed over the strategies.
    pub fn evidence(self, task: usize) -> Scaled {
        total(self.row(task).iter().copied())
    }

    /// Pr(evidence | task) times the task's prior: its posterior before renormalisation.
    pub fn weight(self, task: usize) -> Scaled {
        self.prior(task).times(self.evidence(task))
    }

    /// The sum of all tasks' weights.
    pub fn whole(self) -> Scaled {
        total((0..self.count.tasks).map(|task| self.weight(task)))
    }

    /// The posterior probability of a task.
    pub fn probability(self, task: usize) -> f32 {
        self.weight(task).over(self.whole()).clamp(0.0, 1.0)
    }

    /// The posterior probability of a strategy.
    pub fn strategy_probability(self, strategy: usize) -> f32 {
        self.strategy_among(strategy, self.whole())
    }

    /// The same, with the sum of all tasks' weights, so that it is added up once for all strategies.
    pub(crate) fn strategy_among(self, strategy: usize, whole: Scaled) -> f32 {
        if whole.is_zero() {
            return self.begun_with(strategy);
        }
        total((0..self.count.tasks).map(|task| self.weight_with(task, strategy))).over(whole).clamp(0.0, 1.0)
    }

    /// The sum of all tasks' weights if there is evidence. Otherwise it is 0: the strategies' probabilities are then unchanged, to the bit.
    pub(crate) fn evident_whole(self) -> Scaled {
        if self.has_evidence() { self.whole() } else { Scaled::ZERO }
    }

    /// The probability of a strategy at the start of this session.
    fn begun_with(self, strategy: usize) -> f32 {
        self.strategies().get(strategy).map_or(0.0, |&(_, probability)| probability)
    }

    /// Whether any evidence since the start distinguishes tasks or strategies. Before that, the probabilities are exactly those of
    /// [`strategies`](Self::strategies), and those of [`strategy_probability`](Self::strategy_probability) up to rounding.
    pub fn has_evidence(self) -> bool {
        self.strategies().iter().enumerate().any(|(strategy, &(_, probability))| {
            let begun = Scaled::new(probability);
            (0..self.count.tasks).any(|task| self.row(task).get(strategy).is_some_and(|&joint| joint != begun))
        })
    }

    fn weight_with(self, task: usize, strategy: usize) -> Scaled {
        self.row(task).get(strategy).map_or(Scaled::ZERO, |joint| joint.times(self.prior(task)))
    }
}

impl<'t> Belief<'t> {
    /// The belief in these tables.
    pub const fn new(memory: BeliefTables<'t>, count: &'t mut BeliefCount) -> Self {
        Self { memory, count }
    }

    /// The belief, read-only.
    pub const fn read(&self) -> BeliefRef<'_> {
        BeliefRef { memory: self.memory.read(), count: *self.count }
    }

    /// Replaces the strategies and their probabilities, which are renormalised.
    ///
    /// # Errors
    /// A [`BeliefError`]; the belief is then unchanged.
    pub fn set_strategies(&mut self, strategies: &[(Strategy, f32)]) -> Result<(), BeliefError> {
        let limit = self.read().most_strategies();
        Capacity::Strategies.fits(strategies.len(), limit)?;
        let mut sum = 0.0;
        for (position, &(_, prior)) in strategies.iter().enumerate() {
            if !(0.0..=1.0).contains(&prior) {
                return Err(BeliefError::Prior { strategy: position as u8, value: prior });
            }
            sum += prior;
        }
        if sum <= 0.0 {
            return Err(BeliefError::NoPrior);
        }
        let slots = self.memory.strategies.iter_mut().zip(self.memory.expected.iter_mut());
        for ((slot, expected), &(strategy, prior)) in slots.zip(strategies) {
            (*slot, *expected) = ((strategy, prior / sum), prior / sum);
        }
        self.count.strategies = strategies.len();
        self.count.tasks = 0;
        Ok(())
    }

    /// Replaces the strategies and their probabilities, present and prior, without renormalising. The caller has checked that they are
    /// sound and fit. An empty list keeps the current strategies. The belief then has no tasks.
    pub(crate) fn take_over(&mut self, strategies: impl Iterator<Item = ((Strategy, f32), f32)>) {
        let mut count = 0_usize;
        let slots = self.memory.strategies.iter_mut().zip(self.memory.expected.iter_mut());
        for ((slot, expected), (strategy, before)) in slots.zip(strategies) {
            (*slot, *expected) = (strategy, before);
            count += 1;
        }
        if count > 0 {
            self.count.strategies = count;
        }
        self.count.tasks = 0;
    }

    /// Starts again with these task priors. The strategies keep their marginal probabilities so far, but drift back by the share `drift`,
    /// from 0 to 1, to their probabilities before the trainer was met.
    ///
    /// # Errors
    /// A [`CapacityError`] if the tasks and strategies do not fit; the belief then has no tasks.
    pub fn restart(&mut self, priors: impl ExactSizeIterator<Item = Scaled>, drift: f32) -> Result<(), CapacityError> {
        // A robot that only obeys hears no feedback.
        if cfg!(feature = "learning") && self.count.tasks > 0 {
            let whole = self.read().evident_whole();
            for strategy in 0..self.count.strategies {
                let marginal = self.read().strategy_among(strategy, whole);
                let expected = self.read().expected(strategy);
                if let Some(slot) = self.memory.strategies.get_mut(strategy) {
                    slot.1 = (1.0 - drift) * marginal + drift * expected;
                }
            }
        }
        self.count.tasks = 0;
        let count = priors.len();
        let wanted = count.saturating_mul(self.count.strategies);
        let limit = self.memory.joint.len().min(self.memory.settled.len());
        Capacity::Beliefs.fits(wanted, limit)?;
        Capacity::Tasks.fits(count, self.memory.priors.len())?;
        for (slot, prior) in self.memory.priors.iter_mut().zip(priors) {
            *slot = prior;
        }
        let strategies = self.memory.strategies.get(..self.count.strategies).unwrap_or(&[]);
        for (strategy, &(_, probability)) in strategies.iter().enumerate() {
            let begun = Scaled::new(probability);
            // The compiler sees that the step is not 0, and leaves out its panic.
            for slot in self.memory.joint.iter_mut().skip(strategy).step_by(strategies.len().max(1)).take(count) {
                *slot = begun;
            }
        }
        self.count.tasks = count;
        self.settle();
        Ok(())
    }

    /// Forgets all evidence since the last start: the belief has no tasks, and the strategies have their probabilities at that start.
    pub(crate) fn forget(&mut self) {
        self.count.tasks = 0;
    }

    /// Settles the last piece of evidence: the next one is added, and no longer replaces it.
    pub fn settle(&mut self) {
        let used = self.count.tasks.saturating_mul(self.count.strategies);
        self.memory.settled.iter_mut().zip(self.memory.joint.iter()).take(used).for_each(|(settled, joint)| *settled = *joint);
    }

    /// Replaces the prior of one task; does nothing if there is no such task.
    pub fn set_prior(&mut self, task: usize, prior: Scaled) {
        if let Some(slot) = self.memory.priors.get_mut(..self.count.tasks).and_then(|priors| priors.get_mut(task)) {
            *slot = prior;
        }
    }

    /// The unnormalised priors of all tasks.
    pub(crate) fn priors_mut(&mut self) -> &mut [Scaled] {
        self.memory.priors.get_mut(..self.count.tasks).unwrap_or(&mut [])
    }

    /// Observes the feedback to one action. `judged` judges the last action and the two before it for each task, the last one first: see
    /// [`Strategy::likelihood`]. A task without any known judgement gets the posterior-weighted mean likelihood of the others: no evidence
    /// for or against it. Evidence that is impossible under every task and strategy is ignored, and the result is `false`.
    pub fn observe_feedback(&mut self, feedback: Feedback, judged: impl Fn(usize) -> [Judged; LAGS]) -> bool {
        self.observe(&|strategy, task| strategy.likelihood(feedback, judged(task)))
    }

    /// Observes one piece of evidence by its likelihood for each strategy and task, `None` if unknown. It replaces the evidence since
    /// [`settle`](Self::settle). Evidence that is impossible under every task and strategy is ignored, and the result is `false`.
    pub fn observe(&mut self, likelihood: &dyn Fn(&Strategy, usize) -> Option<f32>) -> bool {
        let likely = |belief: &Self, task: usize, column: usize| {
            let (strategy, _) = belief.read().strategies().get(column)?;
            likelihood(strategy, task)
        };
        let settled = |belief: &Self, task: usize, column: usize| {
            let at = task.saturating_mul(belief.count.strategies).saturating_add(column);
            belief.memory.settled.get(at).copied().unwrap_or(Scaled::ZERO)
        };
        let possible = (0..self.count.tasks).any(|task| {
            (0..self.count.strategies).any(|column| {
                likely(self, task, column).is_some_and(|value| value > 0.0)
                    && !settled(self, task, column).times(self.read().prior(task)).is_zero()
            })
        });
        if !possible {
            return false;
        }
        let used = self.count.tasks.saturating_mul(self.count.strategies);
        self.memory.joint.iter_mut().zip(self.memory.settled.iter()).take(used).for_each(|(joint, settled)| *joint = *settled);
        for column in 0..self.count.strategies {
            let (mut known, mut explained) = (Scaled::ZERO, Scaled::ZERO);
            for task in 0..self.count.tasks {
                if let Some(value) = likely(self, task, column) {
                    let weight = self.read().weight_with(task, column);
                    known = known.plus(weight);
                    explained = explained.plus(weight.scaled_by(value));
                }
            }
            let mean = if known.is_zero() { 1.0 } else { explained.over(known) };
            for task in 0..self.count.tasks {
                let value = likely(self, task, column).unwrap_or(mean);
                let at = task.saturating_mul(self.count.strategies).saturating_add(column);
                if let Some(joint) = self.memory.joint.get_mut(at) {
                    *joint = joint.scaled_by(value);
                }
            }
        }
        true
    }
}

#[cfg(feature = "asking")]
impl Belief<'_> {
    /// Observes evidence unrelated to the last action, by its likelihood for each task. It stays if a later word replaces an earlier one
    /// about the action. Evidence that is impossible under every task is ignored, and the result is `false`.
    pub(crate) fn observe_unrelated(&mut self, likelihood: impl Fn(usize) -> f32) -> bool {
        if (0..self.count.tasks).all(|task| self.read().weight(task).scaled_by(likelihood(task)).is_zero()) {
            return false;
        }
        let (tasks, strategies) = (self.count.tasks, self.count.strategies.max(1));
        // Not zipped: if that is not inlined, it has a division that could panic.
        let mut settled = self.memory.settled.chunks_mut(strategies);
        for (task, joint) in self.memory.joint.chunks_mut(strategies).take(tasks).enumerate() {
            let value = likelihood(task);
            joint.iter_mut().chain(settled.next().unwrap_or_default()).for_each(|weight| *weight = weight.scaled_by(value));
        }
        true
    }
}

/// The reason why a belief refused its strategies.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BeliefError {
    /// The probability of a strategy is outside [0, 1] or not a number.
    #[error("the probability of strategy {strategy} is {}; it must be from 0 to 1", Decimal(*.value))]
    Prior {
        /// The strategy, by its position in the list.
        strategy: u8,
        /// Its probability.
        value: f32,
    },
    /// No strategy has a probability above 0.
    #[error("no trainer strategy is probable; give one of them more than 0")]
    NoPrior,
    /// A table was full.
    #[error(transparent)]
    Capacity(#[from] CapacityError),
}
