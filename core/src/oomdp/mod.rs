//! Object-oriented MDPs (paper, section 3): a world is a set of objects of a few classes, each with attributes, and propositional functions
//! define relations between them.
//!
//! - `schema`: the classes, attributes and propositional functions of a domain, by name;
//! - `objects`: the objects of one environment, and propositions about them;
//! - `domain`: the [`Domain`] trait, by which a robot brings its own states and actions;
//! - `action_set`: sets of actions, as wide as the robots of a controller or of a host need;
//! - `push_grid`: the optional [`PushGrid`] trait, for robots that move pieces on a floor of cells;
//! - `either`: one type for domains of two kinds;
//! - `soundness`: checks that a domain keeps the rules of the trait;
//! - `state_key`: a state as an agent keeps it;
//! - `search_kind`: the choice of the search for a domain;
//! - `vocabulary`: the digest that identifies a vocabulary;
//! - `divider`: exact division through a reciprocal.

pub(crate) mod action_set;
pub(crate) mod divider;
pub(crate) mod domain;
pub(crate) mod either;
pub(crate) mod objects;
pub(crate) mod push_grid;
pub(crate) mod schema;
pub(crate) mod search_kind;
pub(crate) mod soundness;
pub(crate) mod state_key;
#[doc(hidden)]
pub mod vocabulary;

pub use crate::memory::{ObjectTables, ObjectTablesRef};
pub use action_set::ActionSet;
pub(crate) use divider::Divider;
pub use domain::{Action, ActionKind, Domain, MOST_COST, MOST_COST_ON_CONTROLLERS, World, action_name, action_named, apply};
pub(crate) use domain::{cost, digest, own_actions};
pub use either::Either;
pub use objects::{GroundProposition, Object, ObjectCount, ObjectError, ObjectId, ObjectSet, Objects};
pub use push_grid::{CellId, Floor, FloorCell, Piece, PushGrid};
pub use schema::{Attribute, Carrier, Class, ClassId, Proposition, PropositionId, Schema};
pub use search_kind::{BitRows, NoGrid, OneByOne, SearchKind};
pub use soundness::DomainFlaw;
pub(crate) use soundness::check_actions;
#[cfg(feature = "alloc")]
pub use soundness::{Checked, check};
pub use state_key::StateKey;
