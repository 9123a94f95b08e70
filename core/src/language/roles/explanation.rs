//! What each word of a command was taken for, given a task.

use super::forward::{Reader, Roles};
use super::layout::{Layout, cell};
use super::training::{Listener, WordRead, read};
use crate::symbols::Symbol;
use crate::task::role::Role;

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

/// Calls `tell` for each word, the last first, with the word's position and the probability of each of its meanings. An unknown word of
/// `sentence` is V; `trellis` holds two rows of memories more than words.
pub(crate) fn explain(
    layout: &Layout,
    translations: &[f32],
    parameters: &[f32],
    trellis: &mut [f32],
    sentence: &[Symbol],
    description: &[Symbol],
    tell: impl FnMut(usize, Meaning, f32),
) {
    let mut reader = Reader::new(layout, translations, parameters, description);
    reader.take_groups();
    let _ = read(&reader, sentence, trellis, &mut Explained { reader: &reader, sentence, of_background: 0.0, of_task: 0.0, tell });
}

/// Sums over the memories before a word, and tells its meanings.
struct Explained<'r, F> {
    reader: &'r Reader<'r, 'r>,
    sentence: &'r [Symbol],
    of_background: f32,
    of_task: f32,
    tell: F,
}

impl<F: FnMut(usize, Meaning, f32)> Listener for Explained<'_, F> {
    fn stop(&mut self, _memory: usize, _share: f32) {}

    fn word(&mut self, word: &WordRead<'_>) {
        self.of_background += word.background;
        self.of_task += word.task;
    }

    fn values(&mut self, position: usize, emissions: &Roles, roles: &[f32]) {
        (self.tell)(position, Meaning::Background, core::mem::take(&mut self.of_background));
        (self.tell)(position, Meaning::Task, core::mem::take(&mut self.of_task));
        let Some(word) = self.sentence.get(position) else { return };
        for group in &self.reader.groups {
            let (share, emission) = (cell(roles, group.present()), cell(emissions, group.present()));
            let Some(present) = self.reader.present.get(group.present()).filter(|_| emission > 0.0) else { continue };
            for &value in self.reader.values(group) {
                let share = share * group.share * self.reader.value(value, word.index()) / emission;
                (self.tell)(position, Meaning::Value(present.role, value), share);
            }
        }
    }
}
