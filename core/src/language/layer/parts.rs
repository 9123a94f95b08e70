//! The parts of a task: its kind, and each value of what it speaks of or of where that is at the start, with the role. If tasks have ways,
//! its goals and its way are parts, too, so that what was learned of a way holds for every goal, also in a kind that was never meant.

use super::scenes;
use crate::symbols::Symbol;
use crate::task::description::{Group, form, groups};
use crate::task::role::RoleKind;
use alloc::collections::BTreeMap;
use alloc::vec::Vec;

/// A part of a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Part {
    /// Its kind, by its token.
    Kind(Symbol),
    /// If tasks have ways: the roles of its goals, and those of its way, each by a hash.
    Goals(u16),
    Way(u16),
    /// A value in a role, by the role's marker, and whether the role has alternatives: "the red or the blue room".
    Value(Symbol, Symbol, bool),
}

/// The parts of a task, by its description. `has_ways` tells whether tasks have ways.
pub(super) fn of_description(description: &[Symbol], has_ways: bool) -> impl Iterator<Item = Part> {
    let speaks = |kind: RoleKind| kind.is_of_task() || kind == RoleKind::Start;
    let values = groups(description)
        .filter(move |group| speaks(group.marker.role.kind()))
        .flat_map(|group| group.values.iter().map(move |&value| Part::Value(group.marker.symbol(), value, has_alternatives(&group))));
    let of_ways = has_ways.then(|| goals_and_way(description)).into_iter().flatten();
    form(description).map(Part::Kind).into_iter().chain(of_ways).chain(values)
}

/// Whether a way may go through one of several.
fn has_alternatives(group: &Group<'_>) -> bool {
    group.marker.role.kind() == RoleKind::Through && group.values.len() > 1
}

/// The goals and the way of a task. The robot's way and that of a thing it pushes are the same.
fn goals_and_way(description: &[Symbol]) -> [Part; 2] {
    const NONE: u16 = 0x9dc5;
    let (mut goals, mut way) = (NONE, NONE);
    for group in groups(description).filter(|group| group.marker.role.kind().is_of_task()) {
        let kind = group.marker.role.kind();
        let is_of_way = kind.index() >= RoleKind::WITHOUT_WAYS;
        let (hash, code) = if is_of_way { (&mut way, kind.index() as u16) } else { (&mut goals, group.marker.symbol().0) };
        *hash = (*hash ^ code).wrapping_mul(0x0193) ^ u16::from(has_alternatives(&group));
    }
    [Part::Goals(goals), Part::Way(way)]
}

/// The different parts of a session's tasks, with a number for each.
#[derive(Clone, Debug)]
pub(super) struct Parts {
    all: Vec<Part>,
    numbers: Vec<f32>,
    /// The parts of one task after the other, by position in `all`, and the end of each task's parts.
    of_tasks: Vec<u32>,
    ends: Vec<usize>,
    /// The position of each task among those that were taught, if it was.
    themselves: Vec<Option<usize>>,
}

impl Parts {
    /// The parts of these tasks. `taught` are the tasks of scenes that were taught often, and `has_ways` tells whether tasks have ways.
    pub fn of<'d>(descriptions: impl Iterator<Item = &'d [Symbol]> + Clone, taught: &[u32], has_ways: bool) -> Self {
        let mut parts = Self { all: Vec::new(), numbers: Vec::new(), of_tasks: Vec::new(), ends: Vec::new(), themselves: Vec::new() };
        let scene = if taught.is_empty() { 0 } else { scenes::of(descriptions.clone()) };
        let mut known: BTreeMap<Part, u32> = BTreeMap::new();
        for description in descriptions {
            for part in of_description(description, has_ways) {
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

    fn of_task(&self, task: usize) -> core::ops::Range<usize> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oomdp::PropositionId;
    use crate::task::role::{Marker, Role};
    use std::vec;

    /// A task that has these roles, with a value for each, after the token of its kind.
    fn task(kind: u16, roles: &[(RoleKind, u8, &[u16])]) -> Vec<Symbol> {
        let mut description = vec![Symbol(kind)];
        for &(role, proposition, values) in roles {
            let role = Role::of_argument(role, PropositionId(proposition), 1);
            description.push(Marker { role, sort: 0 }.symbol());
            description.extend(values.iter().map(|&value| Symbol(value)));
        }
        description
    }

    fn goals_and_ways(description: &[Symbol]) -> (Vec<Part>, Vec<Part>) {
        let parts = || of_description(description, true);
        (parts().filter(|part| matches!(part, Part::Goals(_))).collect(), parts().filter(|part| matches!(part, Part::Way(_))).collect())
    }

    #[test]
    fn what_is_learned_of_a_way_holds_for_other_goals_and_of_goals_for_other_ways() {
        let through = goals_and_ways(&task(1, &[(RoleKind::Goal, 0, &[7]), (RoleKind::Through, 0, &[8])]));
        let thing_through = goals_and_ways(&task(2, &[(RoleKind::Goal, 1, &[7]), (RoleKind::Through, 0, &[8])]));
        let avoiding = goals_and_ways(&task(3, &[(RoleKind::Goal, 0, &[7]), (RoleKind::Avoiding, 0, &[8])]));
        let either = goals_and_ways(&task(4, &[(RoleKind::Goal, 0, &[7]), (RoleKind::Through, 0, &[8, 9])]));
        assert_eq!((through.0.len(), through.1.len()), (1, 1));
        assert!(through.1 == thing_through.1 && through.0 != thing_through.0);
        assert!(through.0 == avoiding.0 && through.1 != avoiding.1);
        assert!(through.0 == either.0 && through.1 != either.1);
    }

    #[test]
    fn without_ways_a_task_has_no_parts_for_them() {
        let description = task(1, &[(RoleKind::Goal, 0, &[7])]);
        let parts: Vec<Part> = of_description(&description, false).collect();
        assert_eq!(parts.len(), 2);
        assert!(matches!(parts[..], [Part::Kind(Symbol(1)), Part::Value(_, Symbol(7), false)]));
    }
}
