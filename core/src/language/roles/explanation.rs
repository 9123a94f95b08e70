//! What each word of a command was taken for, given a task.
//!
//! A command is read forward and back as in training, in parts. What was read stays in the trellis: after a word is done, the row after it
//! has the probability of each role, then of background and of the task.

use super::forward::{Reader, Roles, Scratch};
use super::layout::{Layout, cell, get, get_mut};
use super::training::{Listener, Pass, WordRead, read_on, row_of};
use crate::capacity::WORDS_PER_COMMAND;
use crate::symbols::{Symbol, listed};
use crate::task::role::Role;
use heapless::Vec;

/// What a word can mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// Nothing in particular.
    Background,
    /// The kind of task.
    Task,
    /// A value of something in this role; the value by its machine token.
    Value(Role, Symbol),
}

/// The words of a command; one that training has not seen is V.
pub(crate) fn heard(layout: &Layout, sentence: &[Option<Symbol>]) -> Vec<Symbol, WORDS_PER_COMMAND> {
    listed(super::forward::heard(layout, sentence).map(|word| Symbol(word as u16)))
}

/// A command that is read to be explained.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Explained {
    /// The next step, and the probability of background and of the task so far, of the word under way.
    Reading(Pass, [f32; 2]),
    /// Each word is in the trellis.
    Read,
    /// No task explains the command.
    Impossible,
}

impl Explained {
    /// Nothing is read yet.
    pub const START: Self = Self::Reading(Pass::Forward(0), [0.0; 2]);
}

/// The command to explain, and the parameters.
#[derive(Clone, Copy)]
pub(crate) struct Explaining<'a> {
    pub layout: &'a Layout,
    pub translations: &'a [f32],
    pub parameters: &'a [f32],
    pub sentence: &'a [Symbol],
    pub description: &'a [Symbol],
}

impl Explaining<'_> {
    /// Reads on, with at most about `left` table cells of work. `trellis` holds two rows of memories more than words, and is kept between
    /// calls.
    #[inline(never)]
    pub fn read_on(&self, explained: &mut Explained, trellis: &mut [f32], mut left: usize) {
        let mut reader = Reader::new(self.layout, self.translations, self.parameters, self.description);
        reader.take_groups();
        let mut scratch = Scratch::NEW;
        while let Explained::Reading(pass, sums) = *explained {
            if left == 0 {
                return;
            }
            let mut listener = Sums(sums);
            let (cells, next) = read_on(&reader, self.sentence, trellis, pass, left, &mut scratch, &mut listener);
            left = left.saturating_sub(cells.max(1));
            let done = match (pass, next) {
                (Pass::Backward { word, .. }, Some(Pass::Backward { word: after, .. })) if word != after => Some(word),
                (Pass::Backward { word, .. }, None) => Some(word),
                _ => None,
            };
            if let Some(word) = done {
                let after = get_mut(trellis, row_of(&reader, usize::from(word).saturating_add(1)));
                after.iter_mut().skip(reader.present.len()).zip(core::mem::take(&mut listener.0)).for_each(|(slot, sum)| *slot = sum);
            }
            *explained = match next {
                Some(next) => Explained::Reading(next, listener.0),
                None if done.is_some() => Explained::Read,
                None => Explained::Impossible,
            };
        }
    }

    /// Calls `tell` with the probability of each meaning of a word that was read.
    #[inline(never)]
    pub fn tell(&self, trellis: &[f32], position: usize, mut tell: impl FnMut(Meaning, f32)) {
        let mut reader = Reader::new(self.layout, self.translations, self.parameters, self.description);
        reader.take_groups();
        let (roles, count) = (get(trellis, row_of(&reader, position.saturating_add(1))), reader.present.len());
        let Some(word) = self.sentence.get(position) else { return };
        tell(Meaning::Background, cell(roles, count));
        tell(Meaning::Task, cell(roles, count.saturating_add(1)));
        let mut emissions: Roles = Scratch::NEW.emissions;
        reader.emissions(word.index(), &mut emissions);
        for group in &reader.groups {
            let (share, emission) = (cell(roles, group.present()), cell(&emissions, group.present()));
            let Some(present) = reader.present.get(group.present()).filter(|_| emission > 0.0) else { continue };
            for &value in reader.values(group) {
                let share = share * group.share * reader.value(value, word.index()) / emission;
                tell(Meaning::Value(present.role, value), share);
            }
        }
    }
}

/// Sums over the memories before a word: background, and words of the task.
struct Sums([f32; 2]);

impl Listener for Sums {
    fn stop(&mut self, _memory: usize, _share: f32) {}

    fn word(&mut self, word: &WordRead<'_>) {
        let Self([background, task]) = self;
        *background += word.background;
        *task += word.task;
    }

    fn values(&mut self, _position: usize, _emissions: &Roles, _roles: &[f32]) {}
}
