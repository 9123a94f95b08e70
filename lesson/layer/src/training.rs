//! Training of the weights: 30 passes over the sessions, with one step of `AdaGrad` per session.
//!
//! With p(t) the layer's present posterior of a session's tasks, q(t) the posterior that the session showed, and pi(t) the prior, a step
//! goes from p towards
//!
//! ```text
//! r(t) proportional to (q(t) + 0.1 pi(t)) p(t)
//! ```
//!
//! The words may decide what the trainer's actions leave open, and some sessions show another task than was meant; so a task that the
//! actions refute keeps a tenth of its prior. A session that shows one task alone, such as a labelled one, has nothing to decide, and its
//! target is that task: otherwise a task that the words do not show yet would be taught as wrong, by as much as the sessions before left
//! it improbable, and the order of the sessions would decide. After each pass one step pulls every weight towards 0, and a towards 1. The steps get
//! shorter with each pass.
//!
//! Before, the posteriors of each half of the sessions are stored, by a role model that has seen the other half alone.
//!
//! The network learns apart, session by session too: to share out what the tasks that were meant in the scene have together. The weights
//! learn as if there were none.

use crate::network::Network;
use crate::scenes;
use crate::speaking::{Found, Speaking};
use crate::weighed::{Group, Weighed, weigh};
use crate::weights::{PULLS, TRUST, Weights};
use crate::{Layered, tasks_of};
use goodbot::language::layer::{FOLDS, LeftOut, Step, View};

const PASSES: u8 = 30;
/// The share of a task's prior that the actions of a session cannot refute, if they leave more than one task.
const UNREFUTED: f32 = 0.1;
/// The smallest probability, so that no task is lost for good.
const LEAST: f32 = 1e-9;

/// The next part of a training.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Part {
    /// A role model was trained: find out which words it has heard.
    Hear,
    /// The posteriors of sessions by a role model that has not seen them, from this session on.
    Understand(u16),
    /// Clear the weights.
    Clear,
    /// A pass, from this session on.
    Pass(u8, u16),
    /// Done.
    Done,
}

impl Layered {
    /// Does one part.
    pub fn train(&mut self, view: View<'_>) -> Step {
        let View { tables, bitext, possible } = view;
        let (cells, next) = match self.next {
            Part::Hear => (self.hear(tables.words(), bitext), Part::Understand(self.left_out.first().unwrap_or(0))),
            Part::Understand(session) if usize::from(session) < bitext.sessions() => {
                (self.understand(view, session), Part::Understand(session.saturating_add(FOLDS as u16)))
            }
            Part::Understand(_) => {
                self.left_out = self.left_out.next();
                self.next = if self.left_out == LeftOut::NONE { Part::Clear } else { Part::Hear };
                return Step::RolesAnew;
            }
            Part::Clear => {
                let mut weights = Weights::of(&mut self.weights, 0.0);
                weights.clear();
                self.learned.begin(tables.layout(), bitext, possible);
                let is_told = tables.layout().has_names();
                self.taught = if is_told { Vec::new() } else { scenes::taught(possible, &self.shares) };
                self.network = Network::new(tables.words(), self.taught.len());
                self.found = Found::default();
                (self.weights.len(), Part::Pass(0, 0))
            }
            Part::Pass(pass, session) if usize::from(session) < bitext.sessions() => {
                (self.learn_session(view, session, pass), Part::Pass(pass, session.saturating_add(1)))
            }
            Part::Pass(pass, _) => {
                let cells = self.pull(pass);
                let pass = pass.saturating_add(1);
                self.learned.done = pass >= PASSES;
                if self.learned.done {
                    self.found = Found::default();
                }
                (cells, if self.learned.done { Part::Done } else { Part::Pass(pass, 0) })
            }
            Part::Done => return Step::Done,
        };
        self.next = next;
        Step::Working(cells)
    }

    /// One step towards the posterior that a session showed.
    #[inline(never)]
    fn learn_session(&mut self, View { tables, bitext, possible }: View<'_>, session: u16, pass: u8) -> usize {
        let count = tasks_of(possible, session);
        if count == 0 {
            return 1;
        }
        let (pairs, first) = (possible.pairs_of(session), possible.pairs().partition_point(|pair| pair.session < session));
        let of_session = first..first.saturating_add(count);
        let (understood, shown) = (self.understood.get(of_session.clone()), self.shares.get(of_session));
        let (understood, shown) = (understood.unwrap_or(&[]), shown.unwrap_or(&[]));
        let mut weights = Weights::of(&mut self.weights, rate(pass));
        let descriptions = || pairs.iter().map(|pair| possible.command(pair.command));
        let (found, places) = (self.found.take(session), &mut self.found.places);
        let mut speaking = found
            .unwrap_or_else(|| Speaking::of(tables, self.learned.said, bitext.sentence(session), descriptions(), &self.taught, places));
        speaking.score(&weights);
        let parts = &mut speaking.parts;
        let mut tasks: Vec<Weighed> = Vec::new();
        for (position, (&understood, pair)) in understood.iter().zip(pairs).enumerate() {
            let group = self.learned.group(possible.command(pair.command));
            tasks.push(Weighed { group, understood, parts: parts.sum(position), ..Weighed::default() });
        }
        weigh(&mut tasks, 1.0 + weights.value(TRUST));
        let priors = pairs.iter().map(|pair| pair.weight);
        let wanted = target(shown, priors, tasks.iter().map(|task| task.trusted));
        // The words cannot change the target of a whole group.
        let is_met = |task: &Weighed| task.group == Group::Met;
        let wanted_of =
            |met: bool| tasks.iter().zip(&wanted).filter(|(task, _)| is_met(task) == met).map(|(_, wanted)| wanted).sum::<f32>();
        let (of_met, of_others) = (wanted_of(true), wanted_of(false));
        let of_scene: Vec<(usize, f32)> = parts.themselves().zip(&wanted).filter_map(|(itself, &wanted)| Some((itself?, wanted))).collect();

        parts.each().for_each(|(_, number)| *number = 0.0);
        let mut of_trust = 0.0;
        for (position, (task, &wanted)) in tasks.iter().zip(&wanted).enumerate() {
            let slope = if is_met(task) { of_met } else { of_others } * task.within - wanted;
            parts.add(position, slope);
            of_trust += slope * task.logarithm;
        }
        speaking.learn(&mut weights);
        weights.step(TRUST, of_trust);
        let (sentence, rate) = (bitext.sentence(session), weights.rate);
        let of_network = self.network.learn(session, pass, sentence, &of_scene, rate);
        let cells = speaking.len().saturating_mul(3).saturating_add(of_network).saturating_add(1);
        self.found.keep(session, speaking);
        cells
    }

    /// One step that pulls all weights.
    fn pull(&mut self, pass: u8) -> usize {
        let mut weights = Weights::of(&mut self.weights, rate(pass));
        for (range, pull) in PULLS {
            for cell in range {
                let value = weights.value(cell);
                if value != 0.0 {
                    weights.step(cell, pull * value);
                }
            }
        }
        weights.values.len()
    }
}

/// r, what a session teaches of each of its tasks: by the posterior that it showed, the prior, and the layer's present posterior.
fn target(shown: &[f32], priors: impl Iterator<Item = f32>, trusted: impl Iterator<Item = f32>) -> Vec<f32> {
    let unrefuted = if shown.iter().any(|&share| share >= 1.0) { 0.0 } else { UNREFUTED };
    let wanted = shown.iter().zip(priors).zip(trusted).map(|((shown, prior), trusted)| (shown + unrefuted * prior) * (trusted + LEAST));
    let mut wanted: Vec<f32> = wanted.collect();
    let whole: f32 = wanted.iter().sum();
    if whole > 0.0 {
        wanted.iter_mut().for_each(|share| *share /= whole);
    }
    wanted
}

/// The step size of a pass. It shrinks, so that the last sessions count no more than the first.
fn rate(pass: u8) -> f32 {
    const FIRST: f32 = 0.15;
    FIRST * f32::from(PASSES.saturating_sub(pass)) / f32::from(PASSES)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taught(shown: [f32; 3], trusted: [f32; 3]) -> Vec<f32> {
        target(&shown, [1.0 / 3.0; 3].into_iter(), trusted.into_iter())
    }

    #[test]
    fn a_lesson_that_shows_one_task_teaches_it_however_improbable_the_lessons_before_it_made_it() {
        for trusted in [[0.98, 0.01, 0.01], [1e-6, 0.5, 0.5], [0.0, 1.0, 0.0]] {
            assert_eq!(taught([1.0, 0.0, 0.0], trusted), [1.0, 0.0, 0.0]);
        }
    }

    #[test]
    fn where_the_trainer_left_more_than_one_task_the_words_may_contradict_what_was_done() {
        let taught = taught([0.9, 0.1, 0.0], [0.001, 0.001, 0.998]);
        assert!(taught[2] > 0.9, "{taught:?}");
    }
}
