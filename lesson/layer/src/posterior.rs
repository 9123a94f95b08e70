//! The layer's posterior over the tasks of a command.

use crate::Layered;
use crate::contexts::Command;
use crate::familiar;
use crate::parts::Parts;
use crate::unmet;
use crate::weighed::{Weighed, pool, weigh};
use crate::weights::TRUST;
use goodbot::language::layer::View;
use goodbot::probability::{Scaled, total};
use goodbot::symbols::Symbol;

impl Layered {
    /// See [`Layer::weigh`](goodbot::language::layer::Layer::weigh).
    pub fn weigh_tasks<'d>(
        &self,
        View { tables, bitext, possible }: View<'_>,
        sentence: &[Option<Symbol>],
        same: &dyn Fn(usize) -> usize,
        description: &dyn Fn(usize) -> &'d [Symbol],
        weights: &mut [Scaled],
    ) {
        let whole = total(weights.iter().copied());
        if !self.learned.done || whole.is_zero() {
            return;
        }
        // Tasks with the same description follow each other, in order.
        let mut alike: Vec<(usize, usize)> = (0..weights.len()).map(|task| (same(task), task)).collect();
        alike.sort_unstable();
        let groups = || alike.chunk_by(|a, b| a.0 == b.0).filter_map(|group| Some((group.first()?.0, group)));
        let mut parts = Parts::of(groups().map(|(first, _)| description(first)), &self.taught);
        let command = Command::new(tables, self.learned.said, sentence);
        for (part, number) in parts.each() {
            command.each_weight(part, |cell, times| *number += times * self.weight(cell));
        }
        let before = |weights: &[Scaled], group: &[(usize, usize)]| total(group.iter().filter_map(|&(_, task)| weights.get(task).copied()));
        let themselves = self.network.scores(sentence, parts.themselves());
        let mut tasks: Vec<Weighed> = Vec::new();
        for (position, ((first, group), itself)) in groups().zip(themselves).enumerate() {
            let understood = before(weights, group).over(whole);
            let group = self.learned.group(description(first));
            tasks.push(Weighed { group, understood, itself, parts: parts.sum(position), ..Weighed::default() });
        }
        let firsts: Vec<usize> = groups().map(|(first, _)| first).collect();
        let of_position = |position| firsts.get(position).map_or(&[][..], |&first| description(first));
        unmet::weigh_ways(tables, possible, sentence, &of_position, &mut tasks);
        unmet::weigh_impossible(tables, self.learned.new_words, sentence, &mut tasks);
        weigh(&mut tasks, 1.0 + self.weight(TRUST));
        unmet::share_ways(&of_position, &mut tasks);
        let sure = if tables.layout().has_names() {
            pool(&mut tasks);
            let familiar = familiar::to_command(bitext, sentence);
            let counts: Vec<usize> = groups().map(|(_, group)| group.len()).collect();
            let count = |position: usize| counts.get(position).copied().unwrap_or(1);
            familiar::surer(&tasks, |position| familiar.contains(of_position(position)), count)
        } else {
            tasks.iter().map(|task| Scaled::new(task.believed)).collect()
        };
        for (&after, (_, group)) in sure.iter().zip(groups()) {
            let before = before(weights, group);
            for &(_, task) in group {
                let Some(weight) = weights.get_mut(task) else { continue };
                let share = 1.0 / group.len() as f32;
                *weight = if before.is_zero() { after.scaled_by(share) } else { after.times(weight.divided_by(before)) };
            }
        }
    }

    fn weight(&self, cell: usize) -> f32 {
        self.weights.get(cell).copied().unwrap_or(0.0)
    }
}
