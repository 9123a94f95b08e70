//! A domain in which the robot and one block stay in some regions.
//!
//! Only the robot and that block can change, and only within the regions of a window, as if there were a wall around it: an action that
//! would lead out, or move another block, does nothing. States are numbered by the places of the window alone, so that a search needs no
//! memory for the rest of the home. What is asked of a state is only whether one variable is where it should go.

use super::goals::GoalTable;
use crate::oomdp::{Action, ActionKind, Domain, GroundProposition, ObjectSet, Schema};

/// A set of regions, one bit each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct RegionSet(pub(super) u32);

impl RegionSet {
    pub(super) const fn of(region: usize) -> Self {
        Self(if region < 32 { 1 << region } else { 0 })
    }

    pub(super) const fn has(self, region: usize) -> bool {
        self.0 & Self::of(region).0 != 0
    }

    pub(super) const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    pub(super) fn iter(self) -> impl Iterator<Item = usize> {
        (0..32).filter(move |&region| self.has(region))
    }
}

/// What is planned: which variable goes where, and in which regions.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Leg {
    /// The variable that is to go: 0, the robot, or a block.
    pub(super) subject: usize,
    /// The regions in which the robot and the subject stay.
    pub(super) window: RegionSet,
    /// The task.
    pub(super) task: usize,
    /// The place on the way to which the subject is to go; `None` for wherever the task asks it to be.
    pub(super) place: Option<usize>,
}

/// A domain cut down to a window of regions.
#[derive(Debug)]
pub(super) struct Confined<'d, 'g, D: Domain + ?Sized> {
    pub(super) domain: &'d D,
    pub(super) goals: &'d GoalTable<'g>,
    pub(super) now: &'d D::State,
    pub(super) leg: Leg,
}

impl<D: Domain + ?Sized> Confined<'_, '_, D> {
    /// Places of the window.
    #[inline(never)]
    fn places(&self) -> u64 {
        self.leg.window.iter().fold(0, |sum, region| sum.saturating_add(self.domain.region_size(region) as u64))
    }

    /// The position of a place in the window.
    #[inline(never)]
    fn position(&self, place: usize) -> Option<u64> {
        let (region, within) = self.domain.region_of(place).filter(|&(region, _)| self.leg.window.has(region))?;
        let before = RegionSet(self.leg.window.0 & (RegionSet::of(region).0.wrapping_sub(1)));
        Some(before.iter().fold(within as u64, |sum, region| sum.saturating_add(self.domain.region_size(region) as u64)))
    }

    #[inline(never)]
    fn place(&self, position: u64) -> usize {
        let mut rest = position;
        for region in self.leg.window.iter() {
            let size = self.domain.region_size(region) as u64;
            if rest < size {
                return self.domain.place_in(region, rest as usize).unwrap_or(0);
            }
            rest = rest.wrapping_sub(size);
        }
        0
    }

    fn moves(&self, variable: usize) -> bool {
        variable == 0 || variable == self.leg.subject
    }

    fn is_inside(&self, place: usize) -> bool {
        self.domain.region_of(place).is_some_and(|(region, _)| self.leg.window.has(region))
    }
}

impl<D: Domain + ?Sized> Domain for Confined<'_, '_, D> {
    type State = D::State;

    fn schema(&self) -> Schema<'_> {
        self.domain.schema()
    }

    fn objects(&self) -> &ObjectSet<'_> {
        self.domain.objects()
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        self.domain.actions()
    }

    #[inline(never)]
    fn step(&self, state: &Self::State, action: Action) -> Option<Self::State> {
        let next = self.domain.step(state, action)?;
        let leaves = (0..self.domain.variables()).any(|variable| {
            let (before, after) = (self.domain.value(state, variable), self.domain.value(&next, variable));
            before != after && !(self.moves(variable) && self.is_inside(after))
        });
        Some(if leaves { *state } else { next })
    }

    /// Whether the subject is where it is to go, whatever is asked.
    #[inline(never)]
    fn holds(&self, _proposition: &GroundProposition, state: &Self::State) -> bool {
        let Leg { subject, task, place, .. } = self.leg;
        place.map_or_else(
            || self.goals.not_ruled_out(self.domain, state, subject).contains(task),
            |place| self.domain.value(state, subject) == place,
        )
    }

    fn state_count(&self) -> u64 {
        let places = self.places();
        if self.leg.subject == 0 { places } else { places.saturating_mul(places) }
    }

    #[inline(never)]
    fn number(&self, state: &Self::State) -> u64 {
        let position = |variable: usize| self.position(self.domain.value(state, variable)).unwrap_or(u64::MAX);
        if self.leg.subject == 0 {
            return position(0);
        }
        position(self.leg.subject).saturating_mul(self.places()).saturating_add(position(0))
    }

    #[inline(never)]
    fn numbered(&self, number: u64) -> Self::State {
        let places = self.places().max(1);
        let state = self.domain.with_value(self.now, 0, self.place(number % places));
        if self.leg.subject == 0 {
            return state;
        }
        self.domain.with_value(&state, self.leg.subject, self.place(number / places))
    }
}
