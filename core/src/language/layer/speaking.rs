//! The features of the parts of a session's tasks, computed once for all passes of a training.

use super::contexts::Command;
use super::parts::Parts;
use crate::language::tables::TablesRef;
use crate::symbols::Symbol;
use alloc::vec::Vec;

/// The most features kept for all sessions together: 32 MB. For sessions beyond, they are computed again in each pass.
const MOST_KEPT: usize = 1 << 22;

/// The parts of a session's tasks, and the features of each.
#[derive(Clone, Debug)]
pub(super) struct Speaking {
    pub parts: Parts,
    /// The weight cell and the value of each feature, part after part, and the end of each part's features.
    weights: Vec<(u32, f32)>,
    ends: Vec<usize>,
}

impl Speaking {
    /// The features of the parts of tasks with these descriptions, after a training on data with `said` words, repetitions included.
    /// `taught` are the tasks of scenes that were taught often.
    pub fn of<'d>(
        tables: TablesRef<'_>,
        said: f32,
        sentence: &[Symbol],
        descriptions: impl Iterator<Item = &'d [Symbol]> + Clone,
        taught: &[u32],
    ) -> Self {
        let words: Vec<Option<Symbol>> = sentence.iter().copied().map(Some).collect();
        let command = Command::new(tables, said, &words);
        let mut parts = Parts::of(descriptions, taught);
        let (mut weights, mut ends) = (Vec::new(), Vec::new());
        for (part, _) in parts.each() {
            command.each_weight(part, |cell, times| weights.push((cell as u32, times)));
            ends.push(weights.len());
        }
        Self { parts, weights, ends }
    }

    /// The features of each part, with its number.
    pub fn each(&mut self) -> impl Iterator<Item = (&[(u32, f32)], &mut f32)> {
        let Self { parts, weights, ends } = self;
        let starts = core::iter::once(0).chain(ends.iter().copied());
        let of_parts = starts.zip(&*ends).map(|(start, &end)| weights.get(start..end).unwrap_or(&[]));
        of_parts.zip(parts.each().map(|(_, number)| number))
    }

    /// The number of features.
    pub const fn len(&self) -> usize {
        self.weights.len()
    }
}

/// The features of each training session, by its position.
#[derive(Clone, Debug, Default)]
pub(super) struct Found {
    sessions: Vec<Option<Speaking>>,
    weights: usize,
}

impl Found {
    /// No features.
    pub const NONE: Self = Self { sessions: Vec::new(), weights: 0 };

    /// Takes out a session's features.
    pub fn take(&mut self, session: u16) -> Option<Speaking> {
        let found = self.sessions.get_mut(usize::from(session))?.take()?;
        self.weights = self.weights.saturating_sub(found.len());
        Some(found)
    }

    /// Keeps a session's features if there is room.
    pub fn keep(&mut self, session: u16, found: Speaking) {
        let weights = self.weights.saturating_add(found.len());
        if weights > MOST_KEPT {
            return;
        }
        let at = usize::from(session);
        if self.sessions.len() <= at {
            self.sessions.resize_with(at.saturating_add(1), || None);
        }
        if let Some(slot) = self.sessions.get_mut(at) {
            (*slot, self.weights) = (Some(found), weights);
        }
    }
}
