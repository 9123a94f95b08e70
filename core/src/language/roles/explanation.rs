//! What each word of a command was taken for, given a task.

use super::forward::Reader;
use super::layout::Layout;
use super::training::{Event, read};
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
    mut tell: impl FnMut(usize, Meaning, f32),
) {
    let mut reader = Reader::new(layout, translations, parameters, description);
    reader.take_groups();
    let (mut of_background, mut of_task) = (0.0, 0.0);
    let _ = read(&reader, sentence, trellis, |event| match event {
        Event::Stop { .. } => {}
        Event::Word { background, task, .. } => {
            of_background += background;
            of_task += task;
        }
        Event::Values { position, emissions, roles } => {
            tell(position, Meaning::Background, core::mem::take(&mut of_background));
            tell(position, Meaning::Task, core::mem::take(&mut of_task));
            let Some(word) = sentence.get(position) else { return };
            for group in &reader.groups {
                let part = |all: &[f32]| super::layout::cell(all, group.present());
                let Some(present) = reader.present.get(group.present()).filter(|_| part(emissions) > 0.0) else { continue };
                for &value in reader.values(group) {
                    let share = part(roles) * group.share * reader.value(value, word.index()) / part(emissions);
                    tell(position, Meaning::Value(present.role, value), share);
                }
            }
        }
    });
}
