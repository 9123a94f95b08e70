//! Planning: the actions that begin a shortest plan to each task's goal (paper, section 4: uniform-cost search).
//!
//! ```text
//!            Planner: for one state after another, all tasks at once
//!            ┌──────────────────────────────────────────────────────┐
//!  goals ──▶ │ deadlock ─▶ exact search ─▶ approximate              │ ──▶ Plan
//!            │             rows, or         only for what the exact │
//!            │             one_by_one       search left open        │
//!            └──────────────────────────────────────────────────────┘
//! ```
//!
//! Ties are kept: an action is optimal for a task if any shortest way begins with it. The agent chooses among them (`Agent::decide`).
//!
//! - `goals`: the tasks that a state satisfies, at nearly the same cost for one task as for 64;
//! - `deadlock`: tasks that one piece alone makes impossible for ever, found without a search;
//! - `rows`: exact; expands all states that differ only in the robot's cell together, as rows of bits;
//! - `one_by_one`: exact; serves every domain, and searches nearby through a hash table if the states do not fit the memory;
//! - `bounds`: exact if two bounds of the distance agree; for floors with more joint states than fit (feature `bounds`);
//! - `approximate`: searches smaller state spaces for the tasks that the exact search left open; to act on, but no evidence (feature
//!   `approximate`);
//! - `ways`: exact; tasks with a path constraint (a way), state by state in the product of the world and the way's progress;
//! - `planner`: the order of these steps;
//! - `plan`: the result for each task, and how it judges an action.

#[cfg(feature = "approximate")]
mod approximate;
mod bits;
#[cfg(feature = "bounds")]
mod bounds;
mod deadlock;
pub(crate) mod goals;
mod one_by_one;
pub(crate) mod plan;
pub(crate) mod planner;
mod rows;
mod ways;

pub use goals::GoalPart;
pub use one_by_one::states_needed;
pub use plan::{Judgement, OptimalSet, Plan};
pub use planner::{PlanTables, Planner};
pub use ways::Ways;

/// Whether work that is done in parts is complete.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[must_use]
pub enum Progress {
    /// Call again.
    Working,
    /// All done.
    Done,
}
