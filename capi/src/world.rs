//! The robot's world: a home, or a world of the caller's own. Both are one domain here, so code for a domain is linked once.

#[cfg(feature = "table")]
use crate::table::TableDomain;
use goodbot::Capacities;
#[cfg(feature = "home")]
use goodbot::home::{Home, HomeBuilder};
#[cfg(feature = "home")]
use goodbot::memory::HomeTables;
use goodbot::oomdp::{Domain, Either};
#[cfg(not(all(feature = "home", feature = "table")))]
use {core::convert::Infallible, goodbot::oomdp::NoGrid};

/// The robot's world, also before it is described.
#[derive(Debug)]
pub enum World {
    /// Nothing yet.
    #[cfg(feature = "home")]
    Nothing(HomeTables<'static>),
    /// A home that is being described.
    #[cfg(feature = "home")]
    Plan(HomeBuilder<HomeTables<'static>>),
    /// Being replaced; no call ends in this state.
    #[cfg(feature = "home")]
    Changing,
    /// A world and its state.
    Here(Surroundings, <Surroundings as Domain>::State),
}

#[cfg(feature = "home")]
type InHome = Home<HomeTables<'static>>;
#[cfg(not(feature = "home"))]
type InHome = NoGrid<Infallible>;
#[cfg(feature = "table")]
type ByTable = TableDomain;
#[cfg(not(feature = "table"))]
type ByTable = NoGrid<Infallible>;

/// A home, or a world of the caller's own.
pub type Surroundings = Either<InHome, ByTable>;

/// Runs an expression on the world and its state, if there is a world.
macro_rules! in_world {
    ($world:expr, |$domain:ident, $state:ident| $run:expr) => {
        match $world {
            World::Here($domain, $state) => $run,
            #[cfg(feature = "home")]
            World::Nothing(_) | World::Plan(_) | World::Changing => return Err(GoodbotStatus::NoWorld.into()),
        }
    };
}
pub(crate) use in_world;

/// How full the tables of a world are.
pub fn usage(world: &Surroundings) -> Capacities {
    match world {
        #[cfg(feature = "home")]
        Either::Floor(home) => home.usage(),
        #[cfg(feature = "table")]
        Either::Other(table) => table.usage(),
        #[cfg(not(all(feature = "home", feature = "table")))]
        _ => Capacities::NONE,
    }
}
