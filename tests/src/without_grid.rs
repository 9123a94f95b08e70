//! A domain that does not say how its states lie in a grid, so that they are looked at one by one.

use goodbot::oomdp::{Action, ActionKind, Domain, GroundProposition, ObjectSet, Schema};

/// The domain, without its grid.
#[derive(Debug)]
pub struct WithoutGrid<'d, D: Domain> {
    /// The domain.
    pub domain: &'d D,
    /// Whether it says its variables: without them, no task is told to be a dead end before all is searched.
    pub with_variables: bool,
}

impl<D: Domain> Domain for WithoutGrid<'_, D> {
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

    fn step(&self, state: &D::State, action: Action) -> Option<D::State> {
        self.domain.step(state, action)
    }

    fn holds(&self, proposition: &GroundProposition, state: &D::State) -> bool {
        self.domain.holds(proposition, state)
    }

    fn state_count(&self) -> u64 {
        self.domain.state_count()
    }

    fn number(&self, state: &D::State) -> u64 {
        self.domain.number(state)
    }

    fn numbered(&self, number: u64) -> D::State {
        self.domain.numbered(number)
    }

    fn variables(&self) -> usize {
        if self.with_variables { self.domain.variables() } else { 0 }
    }

    fn values(&self, variable: usize) -> usize {
        self.domain.values(variable)
    }

    fn value(&self, state: &D::State, variable: usize) -> usize {
        self.domain.value(state, variable)
    }

    fn with_value(&self, state: &D::State, variable: usize, value: usize) -> D::State {
        self.domain.with_value(state, variable, value)
    }

    fn reads(&self, proposition: &GroundProposition) -> Option<usize> {
        self.domain.reads(proposition).filter(|_| self.with_variables)
    }

    fn stands_still(&self, variable: usize) -> bool {
        self.domain.stands_still(variable)
    }

    fn ways_on(&self) -> usize {
        if self.with_variables { self.domain.ways_on() } else { 0 }
    }

    fn way_on(&self, variable: usize, value: usize, way: usize) -> Option<usize> {
        self.domain.way_on(variable, value, way)
    }
}
