//! The results of a training besides the weights: the kinds of task that were meant, and the share of sessions with a new word.

use crate::weighed::Group;
use goodbot::capacity::LIFTED_TASKS;
use goodbot::language::BitextRef;
use goodbot::language::roles::Layout;
use goodbot::symbols::Symbol;
use goodbot::task::description::form;
use std::collections::{BTreeMap, BTreeSet};

/// A kind of task was meant if its weight in all sessions together is at least this.
const MET: f32 = 0.5;

/// The share of sessions with a word that no other has, with one pseudo-count each for sessions with and without.
fn new_words(bitext: BitextRef<'_>) -> f32 {
    let mut sessions_of: BTreeMap<Symbol, BTreeSet<u16>> = BTreeMap::new();
    for session in 0..bitext.sessions() as u16 {
        for &word in bitext.sentence(session) {
            sessions_of.entry(word).or_default().insert(session);
        }
    }
    let alone: BTreeSet<u16> = sessions_of.values().filter(|sessions| sessions.len() == 1).flatten().copied().collect();
    (alone.len() as f32 + 1.0) / (bitext.sessions() as f32 + 2.0)
}

/// The results of a training.
#[derive(Clone, Copy, Debug)]
pub struct Learned {
    /// Whether the weights are trained.
    pub done: bool,
    /// The number of words in the sessions trained on, repetitions included.
    pub said: f32,
    /// The share of sessions with a word that no other has.
    pub new_words: f32,
    /// Whether the words in names are values.
    is_told: bool,
    /// The kinds of task that were meant, by their tokens.
    met: [Option<Symbol>; LIFTED_TASKS],
    /// The kinds of task that some session could mean.
    possible: [Option<Symbol>; LIFTED_TASKS],
}

impl Learned {
    pub const NOTHING: Self =
        Self { done: false, said: 0.0, new_words: 0.0, is_told: false, met: [None; LIFTED_TASKS], possible: [None; LIFTED_TASKS] };

    /// Begins a training on these data. `possible` has the tasks of all sessions.
    pub fn begin(&mut self, layout: &Layout, bitext: BitextRef<'_>, possible: BitextRef<'_>) {
        *self = Self { said: layout.words_said(bitext), new_words: new_words(bitext), is_told: layout.has_names(), ..Self::NOTHING };
        let mut meant: heapless::Vec<(Symbol, f32), LIFTED_TASKS> = heapless::Vec::new();
        for pair in bitext.pairs() {
            let Some(form) = form(bitext.command(pair.command)) else { continue };
            match meant.iter_mut().find(|(other, _)| *other == form) {
                Some((_, times)) => *times += pair.weight,
                // No more than there are kinds.
                None => {
                    let _ = meant.push((form, pair.weight));
                }
            }
        }
        let met = meant.iter().filter(|(_, times)| *times >= MET).map(|(form, _)| *form);
        self.met.iter_mut().zip(met).for_each(|(slot, form)| *slot = Some(form));
        let possible: BTreeSet<Option<Symbol>> = (0..possible.commands() as u16).map(|task| form(possible.command(task))).collect();
        self.possible.iter_mut().zip(possible).for_each(|(slot, form)| *slot = form);
    }

    /// The group of a task. Words can speak for or against a kind that was meant before. If the words in names are values, a new kind may
    /// have known words.
    pub fn group(&self, description: &[Symbol]) -> Group {
        match form(description) {
            form if form.is_none() || self.met.contains(&form) => Group::Met,
            form if self.is_told || self.possible.contains(&form) => Group::Unmet,
            _ => Group::Impossible,
        }
    }
}
