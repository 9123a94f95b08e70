//! The parts of a task: its kind, and each value of what it speaks of or of where that is at the start, with the role.

use crate::symbols::Symbol;
use crate::task::description::{form, groups};
use crate::task::role::RoleKind;
use heapless::Vec;

/// A role's marker and a value. For the kind of task, its token twice.
pub(super) type Part = (Symbol, Symbol);

/// The parts of a task, by its description.
pub(super) fn of_description(description: &[Symbol]) -> impl Iterator<Item = Part> {
    let speaks = |kind: RoleKind| kind.is_of_task() || kind == RoleKind::Start;
    let values = groups(description)
        .filter(move |group| speaks(group.marker.role.kind()))
        .flat_map(|group| group.values.iter().map(move |&value| (group.marker.symbol(), value)));
    form(description).map(|form| (form, form)).into_iter().chain(values)
}

/// The different parts of a session's tasks that count: those of the first tasks, where there are more.
const MOST_PARTS: usize = 256;

/// The different parts of a session's tasks, and a number for each.
pub(super) struct Parts {
    all: Vec<Part, MOST_PARTS>,
    numbers: [f32; MOST_PARTS],
}

impl Parts {
    /// The parts of these tasks.
    pub fn of<'d>(descriptions: impl Iterator<Item = &'d [Symbol]>) -> Self {
        let mut parts = Self { all: Vec::new(), numbers: [0.0; MOST_PARTS] };
        for part in descriptions.flat_map(of_description) {
            if !parts.all.contains(&part) {
                // Those that find no room count as nothing for all tasks.
                let _ = parts.all.push(part);
            }
        }
        parts
    }

    /// Each part, with its number.
    pub fn each(&mut self) -> impl Iterator<Item = (Part, &mut f32)> {
        self.all.iter().copied().zip(&mut self.numbers)
    }

    /// The sum of the numbers of a task's parts.
    pub fn sum(&self, description: &[Symbol]) -> f32 {
        let number = |part: Part| self.all.iter().position(|&other| other == part).and_then(|at| self.numbers.get(at));
        of_description(description).filter_map(number).sum()
    }

    /// Adds to the number of each of a task's parts.
    pub fn add(&mut self, description: &[Symbol], value: f32) {
        for part in of_description(description) {
            let at = self.all.iter().position(|&other| other == part);
            if let Some(number) = at.and_then(|at| self.numbers.get_mut(at)) {
                *number += value;
            }
        }
    }
}
