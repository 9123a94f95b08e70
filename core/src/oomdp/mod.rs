//! Object-oriented MDPs (paper, section 3): a world is a set of objects of a few classes, each with attributes, and propositional
//! functions say what holds between them.
//!
//! - [`schema`]: the classes, attributes and propositional functions of a domain, by name;
//! - [`objects`]: the objects of one environment;
//! - [`domain`]: the [`Domain`] trait, the seam where a robot brings its own states and actions;
//! - [`grid`]: how a robot's places lie in a grid, for the search that looks at many states at once;
//! - [`divider`]: state numbers, taken apart.

pub mod divider;
pub mod domain;
pub mod grid;
pub mod objects;
pub mod schema;

pub use divider::Divider;
pub use domain::{Action, ActionKind, ActionSet, Domain, action_name, action_named, apply};
pub use grid::Grid;
pub use objects::{Object, ObjectId, ObjectSet};
pub use schema::{Attribute, Carrier, Class, ClassId, GroundProposition, Proposition, PropositionId, Schema};
