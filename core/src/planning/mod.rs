//! Planning: which actions are on a shortest way to each task's goal (paper, section 4: uniform-cost search).
//!
//! - [`goals`]: which tasks a state satisfies, at the same cost for one task as for 64;
//! - [`search`]: one uniform-cost search from the current state that serves all tasks, in steps as large as the caller allows;
//! - [`sweep`]: one sweep from all goals that serves all tasks in every state, for those who ask for all;
//! - [`relaxed`]: plans for homes too large for that, with the blocks that do not matter to a task standing still;
//! - `regions`: plans region by region, for memories too small for that too;
//! - [`planner`]: which way of planning serves a state.

mod confined;
mod frontier;
pub mod goals;
mod lanes;
mod optimal_set;
pub mod planner;
mod regions;
pub mod relaxed;
pub mod search;
mod standing;
pub mod sweep;
mod trail;

pub use goals::{GoalMemory, GoalTable};
pub use planner::Planner;
pub use search::{OptimalSet, PlanMemory, Search};
pub use sweep::Sweep;

/// Whether work that is done in parts has come to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[must_use]
pub enum Progress {
    /// Call again.
    Working,
    /// All done.
    Done,
}
