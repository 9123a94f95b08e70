//! A domain in which some blocks stand still.
//!
//! With four blocks in six rooms the joint state space has a million million states. A task that speaks of one block hardly depends on
//! where the others are, as long as they are not in the way. In a [`Standing`] domain only some variables can change: the robot's own and
//! those that matter to a task. Every other block is as a wall: an action that would move it does nothing.

use crate::oomdp::{Action, ActionKind, Domain, Grid, GroundProposition, ObjectSet, Schema};

/// The variables that can change, one bit each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Moving(pub(super) u32);

impl Moving {
    pub(super) const fn contains(self, variable: usize) -> bool {
        variable < 32 && self.0 >> variable & 1 == 1
    }

    pub(super) const fn with(self, variable: usize) -> Self {
        if variable < 32 { Self(self.0 | 1 << variable) } else { self }
    }

    /// The robot's own variables.
    pub(super) fn own<D: Domain + ?Sized>(domain: &D) -> Self {
        (0..domain.variables()).filter(|&variable| !domain.stands_still(variable)).fold(Self(0), Self::with)
    }
}

/// A domain in which the variables not in `moving` stay as they are in `now`.
#[derive(Debug)]
pub(super) struct Standing<'d, D: Domain + ?Sized> {
    pub(super) domain: &'d D,
    pub(super) moving: Moving,
    pub(super) now: &'d D::State,
}

impl<D: Domain + ?Sized> Domain for Standing<'_, D> {
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

    #[inline]
    fn step(&self, state: &Self::State, action: Action) -> Option<Self::State> {
        let next = self.domain.step(state, action)?;
        let touched = (0..self.domain.variables())
            .any(|variable| !self.moving.contains(variable) && self.domain.value(&next, variable) != self.domain.value(state, variable));
        Some(if touched { *state } else { next })
    }

    fn holds(&self, proposition: &GroundProposition, state: &Self::State) -> bool {
        self.domain.holds(proposition, state)
    }

    fn state_count(&self) -> u64 {
        let values = (0..self.domain.variables()).filter(|&variable| self.moving.contains(variable));
        values.fold(1, |count, variable| count.saturating_mul(self.domain.values(variable) as u64))
    }

    #[inline]
    fn number(&self, state: &Self::State) -> u64 {
        let variables = (0..self.domain.variables()).rev().filter(|&variable| self.moving.contains(variable));
        variables.fold(0, |number, variable| {
            number.wrapping_mul(self.domain.values(variable) as u64).wrapping_add(self.domain.value(state, variable) as u64)
        })
    }

    #[inline]
    fn numbered(&self, number: u64) -> Self::State {
        let variables = (0..self.domain.variables()).filter(|&variable| self.moving.contains(variable));
        let (mut state, mut rest) = (*self.now, number);
        for variable in variables {
            let values = (self.domain.values(variable) as u64).max(1);
            state = self.domain.with_value(&state, variable, (rest % values) as usize);
            rest /= values;
        }
        state
    }

    fn variables(&self) -> usize {
        self.domain.variables()
    }

    fn values(&self, variable: usize) -> usize {
        self.domain.values(variable)
    }

    #[inline]
    fn value(&self, state: &Self::State, variable: usize) -> usize {
        self.domain.value(state, variable)
    }

    fn with_value(&self, state: &Self::State, variable: usize, value: usize) -> Self::State {
        self.domain.with_value(state, variable, value)
    }

    fn reads(&self, proposition: &GroundProposition) -> Option<usize> {
        self.domain.reads(proposition)
    }

    fn grid(&self) -> Option<Grid> {
        self.domain.grid().filter(|_| self.moving.contains(0))
    }

    #[inline]
    fn bit_of(&self, place: usize) -> usize {
        self.domain.bit_of(place)
    }

    fn is_free(&self, place: usize) -> bool {
        let standing = (1..self.domain.variables()).filter(|&variable| !self.moving.contains(variable));
        self.domain.is_free(place) && !standing.into_iter().any(|variable| self.domain.taken(self.now, variable) == Some(place))
    }

    #[inline]
    fn taken(&self, state: &Self::State, variable: usize) -> Option<usize> {
        if self.moving.contains(variable) { self.domain.taken(state, variable) } else { None }
    }
}
