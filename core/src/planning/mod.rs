//! Planning: which actions are on a shortest way to each task's goal (paper, section 4: uniform-cost search).
//!
//! - [`goals`]: which tasks a state satisfies, at the same cost for one task as for 64;
//! - [`search`]: one uniform-cost search from the current state that serves all tasks, in steps as large as the caller allows;
//! - [`sweep`]: one sweep from all goals that serves all tasks in every state, where the memory allows it.

pub mod goals;
mod lanes;
pub mod search;
pub mod sweep;

pub use goals::{GoalMemory, GoalTable};
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
