//! The features of the parts of a session's tasks, computed once for all passes of a training.

use crate::contexts::Command;
use crate::parts::Parts;
use crate::weights::{CELLS, Weights};
use goodbot::language::TablesRef;
use goodbot::symbols::Symbol;

/// The most features kept for all sessions together: 32 MB. For sessions beyond, they are computed again in each pass.
const MOST_KEPT: usize = 1 << 22;

/// The parts of a session's tasks, and the features of each.
#[derive(Clone, Debug)]
pub struct Speaking {
    pub parts: Parts,
    /// The different cells of the features.
    cells: Vec<u32>,
    /// For each feature, the position of its cell in `cells`, and its value: part after part, and the end of each part's features.
    weights: Vec<(u32, f32)>,
    ends: Vec<usize>,
}

impl Speaking {
    /// The features of the parts of tasks with these descriptions, after a training on data with `said` words, repetitions included.
    /// `taught` are the tasks of scenes that were taught often, and `places` is empty or has a 0 for each cell, as afterwards.
    pub fn of<'d>(
        tables: TablesRef<'_>,
        said: f32,
        sentence: &[Symbol],
        descriptions: impl Iterator<Item = &'d [Symbol]> + Clone,
        taught: &[u32],
        places: &mut Vec<u32>,
    ) -> Self {
        let words: Vec<Option<Symbol>> = sentence.iter().copied().map(Some).collect();
        let command = Command::new(tables, said, &words);
        let mut parts = Parts::of(descriptions, taught);
        let (mut cells, mut weights, mut ends) = (Vec::new(), Vec::new(), Vec::new());
        places.resize(CELLS, 0);
        for (part, _) in parts.each() {
            command.each_weight(part, |cell, times| {
                let Some(place) = places.get_mut(cell) else { return };
                if *place == 0 {
                    cells.push(cell as u32);
                    *place = cells.len() as u32;
                }
                weights.push((place.saturating_sub(1), times));
            });
            ends.push(weights.len());
        }
        for &cell in &cells {
            if let Some(place) = places.get_mut(cell as usize) {
                *place = 0;
            }
        }
        Self { parts, cells, weights, ends }
    }

    /// The features of each part, with its number.
    fn each<'s>(
        parts: &'s mut Parts,
        weights: &'s [(u32, f32)],
        ends: &'s [usize],
    ) -> impl Iterator<Item = (&'s [(u32, f32)], &'s mut f32)> {
        let starts = std::iter::once(0).chain(ends.iter().copied());
        let of_parts = starts.zip(ends).map(move |(start, &end)| weights.get(start..end).unwrap_or(&[]));
        of_parts.zip(parts.each().map(|(_, number)| number))
    }

    /// Sets the number of each part to U, the sum of its features with these weights.
    pub fn score(&mut self, weights: &Weights<'_>) {
        let values: Vec<f32> = self.cells.iter().map(|&cell| weights.value(cell as usize)).collect();
        for (features, number) in Self::each(&mut self.parts, &self.weights, &self.ends) {
            let mut sum = 0.0;
            for &(at, times) in features {
                sum += times * values.get(at as usize).copied().unwrap_or(0.0);
            }
            *number = sum;
        }
    }

    /// One step of the weights; the number of each part is the slope of its U.
    pub fn learn(&mut self, weights: &mut Weights<'_>) {
        let mut slopes = vec![0.0_f32; self.cells.len()];
        for (features, &mut number) in Self::each(&mut self.parts, &self.weights, &self.ends) {
            for &(at, times) in features {
                if let Some(slope) = slopes.get_mut(at as usize) {
                    *slope += times * number;
                }
            }
        }
        weights.step_each(&self.cells, slopes);
    }

    /// The memory for the features, in numbers.
    pub const fn len(&self) -> usize {
        self.weights.len().saturating_add(self.cells.len())
    }
}

/// The features of each training session, by its position.
#[derive(Clone, Debug, Default)]
pub struct Found {
    sessions: Vec<Option<Speaking>>,
    weights: usize,
    /// For [`Speaking::of`].
    pub places: Vec<u32>,
}

impl Found {
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
