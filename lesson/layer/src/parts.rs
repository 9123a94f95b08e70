//! The parts of a task: its kind, and each value of what it speaks of or of where that is at the start, with the role.

use crate::scenes;
use goodbot::symbols::Symbol;
use goodbot::task::RoleKind;
use goodbot::task::description::{Group, form, groups};
use std::collections::BTreeMap;

/// A part of a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// Its kind, by its token.
    Kind(Symbol),
    /// A value in a role, by the role's marker, and whether the role has alternatives: "the red or the blue room".
    Value(Symbol, Symbol, bool),
}

/// The parts of a task, by its description.
pub fn of_description(description: &[Symbol]) -> impl Iterator<Item = Part> {
    let speaks = |kind: RoleKind| kind.is_of_task() || kind == RoleKind::Start;
    let values = groups(description)
        .filter(move |group| speaks(group.marker.role.kind()))
        .flat_map(|group| group.values.iter().map(move |&value| Part::Value(group.marker.symbol(), value, has_alternatives(&group))));
    form(description).map(Part::Kind).into_iter().chain(values)
}

/// Whether a way may go through one of several.
fn has_alternatives(group: &Group<'_>) -> bool {
    group.marker.role.kind() == RoleKind::Through && group.values.len() > 1
}

/// The different parts of a session's tasks, with a number for each.
#[derive(Clone, Debug)]
pub struct Parts {
    all: Vec<Part>,
    numbers: Vec<f32>,
    /// The parts of one task after the other, by position in `all`, and the end of each task's parts.
    of_tasks: Vec<u32>,
    ends: Vec<usize>,
    /// The position of each task among those that were taught, if it was.
    themselves: Vec<Option<usize>>,
}

impl Parts {
    /// The parts of these tasks. `taught` are the tasks of scenes that were taught often.
    pub fn of<'d>(descriptions: impl Iterator<Item = &'d [Symbol]> + Clone, taught: &[u32]) -> Self {
        let mut parts = Self { all: Vec::new(), numbers: Vec::new(), of_tasks: Vec::new(), ends: Vec::new(), themselves: Vec::new() };
        let scene = if taught.is_empty() { 0 } else { scenes::of(descriptions.clone()) };
        let mut known: BTreeMap<Part, u32> = BTreeMap::new();
        for description in descriptions {
            for part in of_description(description) {
                let next = parts.all.len() as u32;
                let at = *known.entry(part).or_insert(next);
                if at == next {
                    parts.all.push(part);
                    parts.numbers.push(0.0);
                }
                parts.of_tasks.push(at);
            }
            parts.ends.push(parts.of_tasks.len());
            let itself = scenes::task(scene, description);
            parts.themselves.push(taught.binary_search(&itself).ok());
        }
        parts
    }

    /// Each part, with its number.
    pub fn each(&mut self) -> impl Iterator<Item = (Part, &mut f32)> {
        self.all.iter().copied().zip(&mut self.numbers)
    }

    fn of_task(&self, task: usize) -> std::ops::Range<usize> {
        let start = task.checked_sub(1).and_then(|before| self.ends.get(before)).copied().unwrap_or(0);
        start..self.ends.get(task).copied().unwrap_or(start)
    }

    /// The position of each task among those that were taught often in this scene, if it was.
    pub fn themselves(&self) -> impl Iterator<Item = Option<usize>> {
        self.themselves.iter().copied()
    }

    /// The sum of the numbers of a task's parts.
    pub fn sum(&self, task: usize) -> f32 {
        let parts = self.of_tasks.get(self.of_task(task)).unwrap_or(&[]);
        parts.iter().filter_map(|&at| self.numbers.get(at as usize)).sum()
    }

    /// Adds to the number of each of a task's parts.
    pub fn add(&mut self, task: usize, value: f32) {
        let range = self.of_task(task);
        for &at in self.of_tasks.get(range).unwrap_or(&[]) {
            if let Some(number) = self.numbers.get_mut(at as usize) {
                *number += value;
            }
        }
    }
}
