//! What the layer believes of a command.

use super::contexts::Command;
use super::parts::Parts;
use super::tables::LayerRef;
use super::weights::TRUST;
use crate::language::tables::TablesRef;
use crate::probability::{Scaled, exp, total};
use crate::symbols::Symbol;
use alloc::vec::Vec;

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
        // The tasks of one description follow each other, in order.
        let mut alike: Vec<(usize, usize)> = (0..weights.len()).map(|task| (same(task), task)).collect();
        alike.sort_unstable();
        let groups = || alike.chunk_by(|a, b| a.0 == b.0).filter_map(|group| Some((group.first()?.0, group)));
        let tasks = groups().count();
        let mut parts = Parts::of(groups().map(|(first, _)| description(first)));
        let command = Command::new(tables, self.learned.said, sentence);
        for (part, number) in parts.each() {
            command.each_weight(part, |cell, times| *number += times * self.weight(cell));
        }
        let trust = 1.0 + self.weight(TRUST);
        for (position, (_, group)) in groups().enumerate() {
            let before = total(group.iter().filter_map(|&(_, task)| weights.get(task).copied()));
            let score = trust * logarithm(before.over(whole), tasks) + parts.sum(position);
            let after = Scaled::new(exp(score));
            for &(_, task) in group {
                let Some(weight) = weights.get_mut(task) else { continue };
                let share = 1.0 / group.len() as f32;
                *weight = if before.is_zero() { after.scaled_by(share) } else { after.times(weight.divided_by(before)) };
            }
        }
    }

    fn weight(self, cell: usize) -> f32 {
        self.weights.get(cell).copied().unwrap_or(0.0)
    }
}
