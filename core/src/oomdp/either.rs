//! One type for domains of two kinds.

#[cfg(feature = "ways")]
use super::ObjectId;
use super::{Action, ActionKind, BitRows, CellId, Domain, Floor, GroundProposition, Piece, PushGrid, StateKey, World};

/// A floor with pieces, or a domain of another kind. A program with both kinds then links the code for a domain once. Its states are of the
/// same two kinds; in a state of the other kind, no action can be done and no proposition holds.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(hidden)]
pub enum Either<F, O> {
    /// A floor with pieces, such as a home, or its state.
    Floor(F),
    /// A domain of another kind, whose states are expanded one by one, or its state.
    Other(O),
}

impl<F, O> Either<F, O> {
    /// The floor, if it is one.
    #[inline]
    pub const fn as_floor(&self) -> Option<&F> {
        match self {
            Self::Floor(floor) => Some(floor),
            Self::Other(_) => None,
        }
    }

    /// The domain of the other kind, if it is one.
    #[inline]
    pub const fn as_other(&self) -> Option<&O> {
        match self {
            Self::Floor(_) => None,
            Self::Other(other) => Some(other),
        }
    }
}

/// What a domain of either kind does by itself, or in a state of its own kind.
macro_rules! either {
    ($either:expr, $domain:ident => $run:expr) => {
        match $either {
            Either::Floor($domain) => $run,
            Either::Other($domain) => $run,
        }
    };
    ($either:expr, $state:ident, $domain:ident => $run:expr, else $otherwise:expr) => {
        match ($either, $state) {
            (Either::Floor($domain), Either::Floor($state)) => $run,
            (Either::Other($domain), Either::Other($state)) => $run,
            _ => $otherwise,
        }
    };
}

impl<F: PushGrid, O: Domain> Domain for Either<F, O> {
    type State = Either<F::State, O::State>;
    type Search = BitRows;

    fn world(&self) -> World<'_> {
        either!(self, domain => domain.world())
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        either!(self, domain => domain.actions())
    }

    fn step(&self, state: &Self::State, action: Action) -> Option<Self::State> {
        match (self, state) {
            (Self::Floor(floor), Either::Floor(state)) => floor.step(state, action).map(Either::Floor),
            (Self::Other(other), Either::Other(state)) => other.step(state, action).map(Either::Other),
            _ => None,
        }
    }

    fn holds(&self, proposition: &GroundProposition, state: &Self::State) -> bool {
        either!(self, state, domain => domain.holds(proposition, state), else false)
    }

    fn state_count(&self) -> u64 {
        either!(self, domain => domain.state_count())
    }

    fn number(&self, state: &Self::State) -> u64 {
        // A state of the other kind has no number here.
        either!(self, state, domain => domain.number(state), else u64::MAX)
    }

    fn numbered(&self, number: u64) -> Self::State {
        match self {
            Self::Floor(floor) => Either::Floor(floor.numbered(number)),
            Self::Other(other) => Either::Other(other.numbered(number)),
        }
    }

    fn key(&self, state: &Self::State) -> StateKey {
        match (self, state) {
            (Self::Floor(floor), Either::Floor(state)) => floor.key(state),
            _ => StateKey::of(self.number(state)),
        }
    }

    fn keyed(&self, key: StateKey) -> Self::State {
        match self {
            Self::Floor(floor) => Either::Floor(floor.keyed(key)),
            Self::Other(other) => Either::Other(other.keyed(key)),
        }
    }

    #[cfg(feature = "ways")]
    fn tell_derived(&self, state: &Self::State, object: ObjectId, tell: &mut dyn FnMut(&str)) {
        either!(self, state, domain => domain.tell_derived(state, object, tell), else ())
    }

    #[cfg(feature = "alloc")]
    fn admits(&self, proposition: &GroundProposition) -> bool {
        either!(self, domain => domain.admits(proposition))
    }
}

impl<F: PushGrid, O: Domain> PushGrid for Either<F, O> {
    fn is_floor(&self) -> bool {
        self.as_floor().is_some_and(F::is_floor)
    }

    fn is_numbered(&self) -> bool {
        self.as_floor().is_none_or(F::is_numbered)
    }

    fn floor(&self) -> Floor<'_> {
        self.as_floor().map_or(Floor { cells: &[], directions: [Action::NOOP; 4] }, F::floor)
    }

    fn pieces(&self) -> usize {
        self.as_floor().map_or(0, F::pieces)
    }

    fn cell(&self, state: &Self::State, piece: Piece) -> CellId {
        match (self, state) {
            (Self::Floor(floor), Either::Floor(state)) => floor.cell(state, piece),
            _ => CellId::NONE,
        }
    }

    fn put(&self, state: &Self::State, piece: Piece, cell: CellId) -> Self::State {
        match (self, state) {
            (Self::Floor(floor), Either::Floor(state)) => Either::Floor(floor.put(state, piece, cell)),
            _ => *state,
        }
    }

    fn piece_of(&self, proposition: &GroundProposition) -> Option<Piece> {
        self.as_floor()?.piece_of(proposition)
    }

    fn can_pull(&self) -> bool {
        self.as_floor().is_some_and(F::can_pull)
    }

    fn pushes_plainly(&self) -> bool {
        self.as_floor().is_some_and(F::pushes_plainly)
    }

    fn swaps(&self) -> bool {
        self.as_floor().is_some_and(F::swaps)
    }
}
