//! The order of words in a scene that was taught often: a small recurrent network scores the tasks that were meant there.
//!
//! The network reads word by word. A word and the one before it move the state h of each unit, by a share z, towards c. With n words, w(0) the
//! beginning and t a task,
//!
//! ```text
//! h(0) = 0,   h(i) = h(i-1) + z (c - h(i-1)),   z = 1 / (1 + exp(3 - a[w(i)] - b[w(i-1)])),   c = d[w(i)] + f[w(i-1)]
//! Pr(t|e) proportional to exp(sum over the units of u[t] h(n))
//! ```
//!
//! So it knows which room was named last, and the effect of "then" or "back". In training, three words of ten are replaced by the unknown word.

use crate::weights::{Weights, hashed};
use goodbot::probability::exp;
use goodbot::symbols::Symbol;

const UNITS: usize = 16;
/// The tables of a word: a, d, b and f.
const TABLES: usize = 4;
/// The bias of the gate: before training, a state moves about a twentieth of the way.
const STILL: f32 = 3.0;
/// The numbers of an unknown word and of the beginning of a command.
const UNKNOWN: usize = 0;
const BEGINNING: usize = 1;
/// In training, this many words of ten are replaced by the unknown word.
const FORGOTTEN: usize = 3;
/// The step size relative to the layer's other weights, and the initial sum of squared slopes.
const STEPS: f32 = 1.33;
const SQUARES: f32 = 0.1;

/// The weights of the network, and for each the sum of its squared slopes (AdaGrad).
#[derive(Clone, Debug)]
pub struct Network {
    words: usize,
    values: Vec<f32>,
    squares: Vec<f32>,
}

/// A word and the one before it, by their numbers.
#[derive(Clone, Copy)]
struct WordPair {
    before: usize,
    word: usize,
}

impl WordPair {
    /// The positions of a unit's weights for these words: those of the gate z, and those of the target c.
    fn cells(self, unit: usize) -> ([usize; 2], [usize; 2]) {
        let at = |word: usize, table: usize| word.saturating_mul(TABLES).saturating_add(table).saturating_mul(UNITS).saturating_add(unit);
        ([at(self.word, 0), at(self.before, 2)], [at(self.word, 1), at(self.before, 3)])
    }
}

impl Network {
    /// No network.
    pub const NONE: Self = Self { words: 0, values: Vec::new(), squares: Vec::new() };

    /// An untrained network for this many words and tasks; none if there is no task.
    pub fn new(words: usize, tasks: usize) -> Self {
        if tasks == 0 {
            return Self::NONE;
        }
        let words = words.saturating_add(2);
        let count = words.saturating_mul(TABLES).saturating_add(tasks).saturating_mul(UNITS);
        let small = |at: usize| hashed(1 << 16, [at as u16, (at >> 16) as u16]) as f32 / 655_360.0 - 0.05;
        Self { words, values: (0..count).map(small).collect(), squares: vec![SQUARES; count] }
    }

    /// The numbers of a command's words, each after the one before it.
    fn heard(&self, words: impl Iterator<Item = Option<Symbol>>) -> Vec<WordPair> {
        let mut before = BEGINNING;
        words
            .map(|word| {
                let word = word.map_or(UNKNOWN, |word| word.index().saturating_add(2));
                let heard = WordPair { before, word: if word < self.words { word } else { UNKNOWN } };
                before = heard.word;
                heard
            })
            .collect()
    }

    fn value(&self, at: usize) -> f32 {
        self.values.get(at).copied().unwrap_or(0.0)
    }

    /// The gate z and the target c of a unit at a word.
    fn moves(&self, heard: WordPair, unit: usize) -> (f32, f32) {
        let ([gate, gate_before], [to, to_before]) = heard.cells(unit);
        (1.0 / (1.0 + exp(STILL - self.value(gate) - self.value(gate_before))), self.value(to) + self.value(to_before))
    }

    /// For each word, the gate z and the distance c - h(i-1) of a unit.
    fn read(&self, heard: &[WordPair], unit: usize) -> Vec<(f32, f32)> {
        let mut state = 0.0;
        let each = heard.iter().map(|&heard| {
            let (share, to) = self.moves(heard, unit);
            let way = to - state;
            state += share * way;
            (share, way)
        });
        each.collect()
    }

    /// The position of a unit's weight for a task.
    const fn of_task(&self, task: usize, unit: usize) -> usize {
        self.words.saturating_mul(TABLES).saturating_add(task).saturating_mul(UNITS).saturating_add(unit)
    }

    /// The score of a task after these moves of the units.
    fn score(&self, moves: &[Vec<(f32, f32)>], task: usize) -> f32 {
        moves.iter().enumerate().map(|(unit, moves)| state(moves) * self.value(self.of_task(task, unit))).sum()
    }

    /// The score of each task, given by its position among the tasks of scenes that were taught often.
    pub fn scores(&self, words: &[Option<Symbol>], tasks: impl Iterator<Item = Option<usize>>) -> Vec<Option<f32>> {
        let heard = self.heard(words.iter().copied());
        let moves: Vec<Vec<(f32, f32)>> = (0..UNITS).map(|unit| self.read(&heard, unit)).collect();
        tasks.map(|task| task.map(|task| self.score(&moves, task))).collect()
    }

    /// One step of a training pass towards the wanted share of each of these tasks. Returns the cost, in table cells.
    pub fn learn(&mut self, session: u16, pass: u8, words: &[Symbol], wanted: &[(usize, f32)], rate: f32) -> usize {
        if wanted.is_empty() {
            return 0;
        }
        let is_kept = |position: usize| hashed(10, [u16::from(pass), session, position as u16]) >= FORGOTTEN;
        let heard = self.heard(words.iter().enumerate().map(|(position, &word)| Some(word).filter(|_| is_kept(position))));
        let moves: Vec<Vec<(f32, f32)>> = (0..UNITS).map(|unit| self.read(&heard, unit)).collect();
        let scores: Vec<f32> = wanted.iter().map(|&(task, _)| self.score(&moves, task)).collect();
        let best = scores.iter().copied().fold(f32::MIN, f32::max);
        let shares: Vec<f32> = scores.iter().map(|score| exp(score - best)).collect();
        let (sum, whole) = (shares.iter().sum::<f32>(), wanted.iter().map(|(_, wanted)| wanted).sum::<f32>());
        for (unit, moves) in moves.iter().enumerate() {
            let (state, mut of_state) = (state(moves), 0.0);
            for (&(task, wanted), share) in wanted.iter().zip(&shares) {
                let (at, slope) = (self.of_task(task, unit), whole * share / sum - wanted);
                of_state += slope * self.value(at);
                self.step(at, slope * state, rate);
            }
            // Backpropagation, from the last word to the first.
            for (&heard, &(share, way)) in heard.iter().zip(moves).rev() {
                let (gates, ends) = heard.cells(unit);
                gates.into_iter().for_each(|at| self.step(at, of_state * way * share * (1.0 - share), rate));
                ends.into_iter().for_each(|at| self.step(at, of_state * share, rate));
                of_state *= 1.0 - share;
            }
        }
        heard.len().saturating_mul(UNITS * 2 * TABLES)
    }

    fn step(&mut self, at: usize, slope: f32, rate: f32) {
        Weights { values: &mut self.values, squares: &mut self.squares, rate: STEPS * rate }.step(at, slope);
    }
}

/// The state of a unit after these moves.
fn state(moves: &[(f32, f32)]) -> f32 {
    moves.iter().map(|(share, way)| share * way).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The number of pairs without a lesson for which the room named last scores best.
    fn right(passes: u8) -> usize {
        const ROOMS: u16 = 6;
        let said = |first: u16, second: u16| [first, ROOMS, second].map(Symbol::new);
        let pairs = || (0..ROOMS).flat_map(|first| (0..ROOMS).map(move |second| (first, second))).filter(|(first, second)| first != second);
        let is_lesson = |&(first, second): &(u16, u16)| (first + 2) % ROOMS != second;
        let mut network = Network::new(usize::from(ROOMS) + 1, usize::from(ROOMS));
        for pass in 0..passes {
            for (number, (first, second)) in pairs().filter(is_lesson).enumerate() {
                let wanted: Vec<(usize, f32)> = (0..ROOMS).map(|room| (usize::from(room), f32::from(u8::from(room == second)))).collect();
                network.learn(number as u16, pass, &said(first, second), &wanted, 0.15);
            }
        }
        let best = |(first, second): (u16, u16)| {
            let scores = network.scores(&said(first, second).map(Some), (0..usize::from(ROOMS)).map(Some));
            scores.iter().enumerate().max_by(|a, b| a.1.partial_cmp(b.1).unwrap()).map(|(room, _)| room) == Some(usize::from(second))
        };
        pairs().filter(|pair| !is_lesson(pair)).filter(|&pair| best(pair)).count()
    }

    #[test]
    fn the_room_that_is_named_last_is_known_from_other_pairs_of_rooms() {
        assert!(right(0) < 6);
        assert_eq!(right(120), 6);
    }

    #[test]
    fn words_that_no_lesson_had_are_one_unknown_word() {
        let network = Network::new(3, 2);
        let scores = |word| network.scores(&[word], vec![Some(0), None, Some(1)].into_iter());
        assert_eq!(scores(None), scores(Some(Symbol::new(3))));
        assert_ne!(scores(None), scores(Some(Symbol::new(2))));
        assert_eq!(scores(None)[1], None);
    }
}
