//! The choice of the search for a domain. It is a type, so it costs nothing at run time.

use super::{Action, ActionKind, CellId, Domain, Floor, GroundProposition, Piece, PushGrid, World};
use core::convert::Infallible;
use core::marker::PhantomData;

mod sealed {
    pub trait Sealed {}
}

/// Chooses the search of a domain: [`OneByOne`] or [`BitRows`]. No other type can implement it.
pub trait SearchKind<D: Domain>: sealed::Sealed {
    /// The domain as a floor with pieces.
    #[doc(hidden)]
    type Grid: PushGrid<State = D::State>;

    /// The domain as a floor with pieces, if it is one.
    #[doc(hidden)]
    fn grid(domain: &D) -> Option<&Self::Grid>;
}

/// Expands states one by one. This serves every domain.
#[derive(Clone, Copy, Debug)]
pub enum OneByOne {}

/// Expands all states that differ only in the robot's cell together, as rows of bits. For domains that implement [`PushGrid`].
#[derive(Clone, Copy, Debug)]
pub enum BitRows {}

impl sealed::Sealed for OneByOne {}
impl sealed::Sealed for BitRows {}

impl<D: Domain> SearchKind<D> for OneByOne {
    type Grid = NoGrid<D::State>;

    #[inline]
    fn grid(_domain: &D) -> Option<&Self::Grid> {
        None
    }
}

impl<D: PushGrid> SearchKind<D> for BitRows {
    type Grid = D;

    #[inline]
    fn grid(domain: &D) -> Option<&D> {
        domain.is_floor().then_some(domain)
    }
}

/// A domain without values: the compiler leaves out all code for it. It replaces a kind of an [`Either`](super::Either) that a program is
/// built without.
#[derive(Debug)]
#[doc(hidden)]
pub struct NoGrid<S>(Infallible, PhantomData<S>);

/// Methods that nobody can call, because there is no value to call them on.
macro_rules! never {
    ($(fn $name:ident(&self $(, $given:ident: $Given:ty)*) -> $Result:ty;)*) => {
        $(fn $name(&self $(, $given: $Given)*) -> $Result {
            match self.0 {}
        })*
    };
}

impl<S: Copy + PartialEq> Domain for NoGrid<S> {
    type State = S;
    type Search = OneByOne;

    never! {
        fn world(&self) -> World<'_>;
        fn actions(&self) -> &[ActionKind<'_>];
        fn step(&self, _state: &S, _action: Action) -> Option<S>;
        fn holds(&self, _proposition: &GroundProposition, _state: &S) -> bool;
        fn state_count(&self) -> u64;
        fn number(&self, _state: &S) -> u64;
        fn numbered(&self, _number: u64) -> S;
    }
}

impl<S: Copy + PartialEq> PushGrid for NoGrid<S> {
    never! {
        fn floor(&self) -> Floor<'_>;
        fn pieces(&self) -> usize;
        fn cell(&self, _state: &S, _piece: Piece) -> CellId;
        fn put(&self, _state: &S, _piece: Piece, _cell: CellId) -> S;
        fn piece_of(&self, _proposition: &GroundProposition) -> Option<Piece>;
        fn can_pull(&self) -> bool;
    }
}
