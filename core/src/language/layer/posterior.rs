//! What the layer believes of a command.

use super::contexts::Command;
use super::parts::Parts;
use super::tables::LayerRef;
use super::weights::TRUST;
use crate::language::tables::TablesRef;
use crate::probability::{Scaled, exp, total};
use crate::symbols::Symbol;

/// So much probability, in equal parts, is as good as any that the role model gives.
const FLOOR: f32 = 0.03;

/// The logarithm of the role model's posterior of a task among so many, with the floor.
pub(super) fn logarithm(understood: f32, tasks: usize) -> f32 {
    libm::logf(understood + FLOOR / tasks.max(1) as f32)
}

impl LayerRef<'_> {
    /// Makes of the role model's weights of tasks those of the layer. `same` gives the first task of the same description, and `description`
    /// that one's. A layer that has not learned leaves the weights as they are.
    pub fn weigh<'d>(
        self,
        tables: TablesRef<'_>,
        sentence: &[Option<Symbol>],
        same: impl Fn(usize) -> usize,
        description: impl Fn(usize) -> &'d [Symbol],
        weights: &mut [Scaled],
    ) {
        let whole = total(weights.iter().copied());
        if !self.learned.done || whole.is_zero() {
            return;
        }
        let firsts = || (0..weights.len()).filter(|&task| same(task) == task);
        let (count, tasks) = (weights.len(), firsts().count());
        let mut parts = Parts::of(firsts().map(&description));
        let command = Command::new(tables, self.learned.said, sentence);
        for (part, number) in parts.each() {
            command.each_weight(part, |cell, times| *number += times * self.weight(cell));
        }
        let trust = 1.0 + self.weight(TRUST);
        for first in 0..count {
            if same(first) != first {
                continue;
            }
            let alike = || (0..count).filter(|&task| same(task) == first);
            let before = total(alike().filter_map(|task| weights.get(task).copied()));
            let score = trust * logarithm(before.over(whole), tasks) + parts.sum(description(first));
            let after = Scaled::new(exp(score));
            let (members, nothing) = (alike().count(), before.is_zero());
            for (_, weight) in weights.iter_mut().enumerate().skip(first).filter(|&(task, _)| same(task) == first) {
                *weight = if nothing { after.scaled_by(1.0 / members as f32) } else { after.times(weight.divided_by(before)) };
            }
        }
    }

    fn weight(self, cell: usize) -> f32 {
        self.weights.get(cell).copied().unwrap_or(0.0)
    }
}
