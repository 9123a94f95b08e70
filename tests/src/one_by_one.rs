//! A domain that does not say how its states lie in a grid, so that they are looked at one by one.

use goodbot::oomdp::{Action, ActionKind, Domain, GroundProposition, ObjectSet, Schema};

/// The domain, without its grid.
#[derive(Debug)]
pub struct OneByOne<'d, D: Domain>(pub &'d D);

impl<D: Domain> Domain for OneByOne<'_, D> {
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
}
