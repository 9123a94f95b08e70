//! A domain whose states are expanded one by one, even if it has a floor of cells.

use goodbot::oomdp::{Action, ActionKind, Domain, GroundProposition, OneByOne, World};

/// The domain, without its floor.
#[derive(Debug)]
pub struct WithoutGrid<'d, D: Domain> {
    /// The domain.
    pub domain: &'d D,
}

impl<D: Domain> Domain for WithoutGrid<'_, D> {
    type State = D::State;
    type Search = OneByOne;

    fn world(&self) -> World<'_> {
        self.domain.world()
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
}
