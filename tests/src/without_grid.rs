//! A domain that says all of its variables, but not how the robot's places lie in a grid.

use goodbot::oomdp::{Action, ActionKind, Domain, GroundProposition, ObjectSet, Schema};

/// The domain, without its grid.
#[derive(Debug)]
pub struct WithoutGrid<'d, D: Domain>(pub &'d D);

impl<D: Domain> Domain for WithoutGrid<'_, D> {
    type State = D::State;

    fn schema(&self) -> Schema<'_> {
        self.0.schema()
    }

    fn objects(&self) -> &ObjectSet<'_> {
        self.0.objects()
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        self.0.actions()
    }

    fn step(&self, state: &D::State, action: Action) -> Option<D::State> {
        self.0.step(state, action)
    }

    fn holds(&self, proposition: &GroundProposition, state: &D::State) -> bool {
        self.0.holds(proposition, state)
    }

    fn state_count(&self) -> u64 {
        self.0.state_count()
    }

    fn number(&self, state: &D::State) -> u64 {
        self.0.number(state)
    }

    fn numbered(&self, number: u64) -> D::State {
        self.0.numbered(number)
    }

    fn variables(&self) -> usize {
        self.0.variables()
    }

    fn values(&self, variable: usize) -> usize {
        self.0.values(variable)
    }

    fn value(&self, state: &D::State, variable: usize) -> usize {
        self.0.value(state, variable)
    }

    fn with_value(&self, state: &D::State, variable: usize, value: usize) -> D::State {
        self.0.with_value(state, variable, value)
    }

    fn reads(&self, proposition: &GroundProposition) -> Option<usize> {
        self.0.reads(proposition)
    }

    fn stands_still(&self, variable: usize) -> bool {
        self.0.stands_still(variable)
    }

    fn ways_on(&self) -> usize {
        self.0.ways_on()
    }

    fn way_on(&self, variable: usize, value: usize, way: usize) -> Option<usize> {
        self.0.way_on(variable, value, way)
    }
}
