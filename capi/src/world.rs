//! The robot's world: a home, or a world of the caller's own. Both are one domain here, so code for a domain is linked once.

#[cfg(feature = "table")]
use crate::table::TableDomain;
use goodbot::Capacities;
#[cfg(feature = "home")]
use goodbot::home::{Home, HomeBuilder, HomeState};
#[cfg(feature = "home")]
use goodbot::memory::HomeTables;
use goodbot::oomdp::{Action, ActionKind, Domain, GroundProposition, StateKey};
#[cfg(feature = "home")]
use goodbot::oomdp::{BitRows, CellId, Floor, Piece, PushGrid};

/// The robot's world, also before it is described.
#[derive(Debug)]
pub enum World {
    /// Nothing yet.
    #[cfg(feature = "home")]
    Nothing(HomeTables<'static>),
    /// A home that is being described.
    #[cfg(feature = "home")]
    Plan(HomeBuilder<HomeTables<'static>>),
    /// It is being changed for another; no call ends so.
    #[cfg(feature = "home")]
    Changing,
    /// A world and its state.
    Here(Surroundings, Standing),
}

/// A world.
#[derive(Debug)]
pub enum Surroundings {
    /// A home.
    #[cfg(feature = "home")]
    Home(Home<HomeTables<'static>>),
    /// The caller's own.
    #[cfg(feature = "table")]
    Table(TableDomain),
}

/// The state of a world of the same kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Standing {
    /// In a home.
    #[cfg(feature = "home")]
    Home(HomeState),
    /// In the caller's own: the number of the state.
    #[cfg(feature = "table")]
    Table(u32),
}

impl Surroundings {
    /// How full the tables of the world are.
    pub fn usage(&self) -> Capacities {
        match self {
            #[cfg(feature = "home")]
            Self::Home(home) => home.usage(),
            #[cfg(feature = "table")]
            Self::Table(table) => table.usage(),
        }
    }
}

impl Domain for Surroundings {
    type State = Standing;
    #[cfg(feature = "home")]
    type Search = BitRows;
    #[cfg(not(feature = "home"))]
    type Search = goodbot::oomdp::OneByOne;

    fn world(&self) -> goodbot::oomdp::World<'_> {
        match self {
            #[cfg(feature = "home")]
            Self::Home(home) => home.world(),
            #[cfg(feature = "table")]
            Self::Table(table) => table.world(),
        }
    }

    fn actions(&self) -> &[ActionKind<'_>] {
        match self {
            #[cfg(feature = "home")]
            Self::Home(home) => home.actions(),
            #[cfg(feature = "table")]
            Self::Table(table) => table.actions(),
        }
    }

    fn step(&self, state: &Standing, action: Action) -> Option<Standing> {
        match (self, state) {
            #[cfg(feature = "home")]
            (Self::Home(home), Standing::Home(state)) => home.step(state, action).map(Standing::Home),
            #[cfg(feature = "table")]
            (Self::Table(table), Standing::Table(state)) => table.step(state, action).map(Standing::Table),
            #[cfg(all(feature = "home", feature = "table"))]
            _ => None,
        }
    }

    fn holds(&self, proposition: &GroundProposition, state: &Standing) -> bool {
        match (self, state) {
            #[cfg(feature = "home")]
            (Self::Home(home), Standing::Home(state)) => home.holds(proposition, state),
            #[cfg(feature = "table")]
            (Self::Table(table), Standing::Table(state)) => table.holds(proposition, state),
            #[cfg(all(feature = "home", feature = "table"))]
            _ => false,
        }
    }

    fn state_count(&self) -> u64 {
        match self {
            #[cfg(feature = "home")]
            Self::Home(home) => home.state_count(),
            #[cfg(feature = "table")]
            Self::Table(table) => table.state_count(),
        }
    }

    fn number(&self, state: &Standing) -> u64 {
        match (self, state) {
            #[cfg(feature = "home")]
            (Self::Home(home), Standing::Home(state)) => home.number(state),
            #[cfg(feature = "table")]
            (Self::Table(table), Standing::Table(state)) => table.number(state),
            #[cfg(all(feature = "home", feature = "table"))]
            _ => 0,
        }
    }

    fn numbered(&self, number: u64) -> Standing {
        match self {
            #[cfg(feature = "home")]
            Self::Home(home) => Standing::Home(home.numbered(number)),
            #[cfg(feature = "table")]
            Self::Table(table) => Standing::Table(table.numbered(number)),
        }
    }

    fn key(&self, state: &Standing) -> StateKey {
        match (self, state) {
            #[cfg(feature = "home")]
            (Self::Home(home), Standing::Home(state)) => home.key(state),
            #[cfg(feature = "table")]
            _ => StateKey::of(self.number(state)),
        }
    }

    fn keyed(&self, key: StateKey) -> Standing {
        match self {
            #[cfg(feature = "home")]
            Self::Home(home) => Standing::Home(home.keyed(key)),
            #[cfg(feature = "table")]
            Self::Table(table) => Standing::Table(table.keyed(key)),
        }
    }

    #[cfg(feature = "derived")]
    fn tell_derived(&self, state: &Standing, object: goodbot::oomdp::ObjectId, tell: &mut dyn FnMut(&str)) {
        match (self, state) {
            #[cfg(feature = "home")]
            (Self::Home(home), Standing::Home(state)) => home.tell_derived(state, object, tell),
            #[cfg(feature = "table")]
            (Self::Table(table), Standing::Table(state)) => table.tell_derived(state, object, tell),
            #[cfg(all(feature = "home", feature = "table"))]
            _ => {}
        }
    }
}

/// A home is a floor with pieces; the caller's own world is none.
#[cfg(feature = "home")]
impl PushGrid for Surroundings {
    fn is_floor(&self) -> bool {
        matches!(self, Self::Home(_))
    }

    fn is_numbered(&self) -> bool {
        match self {
            Self::Home(home) => home.is_numbered(),
            #[cfg(feature = "table")]
            Self::Table(_) => true,
        }
    }

    fn floor(&self) -> Floor<'_> {
        match self {
            Self::Home(home) => home.floor(),
            #[cfg(feature = "table")]
            Self::Table(_) => Floor { cells: &[], directions: [Action::NOOP; 4] },
        }
    }

    fn pieces(&self) -> usize {
        match self {
            Self::Home(home) => home.pieces(),
            #[cfg(feature = "table")]
            Self::Table(_) => 0,
        }
    }

    fn cell(&self, state: &Standing, piece: Piece) -> CellId {
        match (self, state) {
            (Self::Home(home), Standing::Home(state)) => home.cell(state, piece),
            #[cfg(feature = "table")]
            _ => CellId::NONE,
        }
    }

    fn put(&self, state: &Standing, piece: Piece, cell: CellId) -> Standing {
        match (self, state) {
            (Self::Home(home), Standing::Home(state)) => Standing::Home(home.put(state, piece, cell)),
            #[cfg(feature = "table")]
            _ => *state,
        }
    }

    fn piece_of(&self, proposition: &GroundProposition) -> Option<Piece> {
        match self {
            Self::Home(home) => home.piece_of(proposition),
            #[cfg(feature = "table")]
            Self::Table(_) => None,
        }
    }

    fn can_pull(&self) -> bool {
        match self {
            Self::Home(home) => home.can_pull(),
            #[cfg(feature = "table")]
            Self::Table(_) => false,
        }
    }

    fn pushes_plainly(&self) -> bool {
        match self {
            Self::Home(home) => home.pushes_plainly(),
            #[cfg(feature = "table")]
            Self::Table(_) => false,
        }
    }

    fn swaps(&self) -> bool {
        match self {
            Self::Home(home) => home.swaps(),
            #[cfg(feature = "table")]
            Self::Table(_) => false,
        }
    }
}
