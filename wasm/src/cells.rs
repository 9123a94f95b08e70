//! How large the tables of the page's robot, homes and scout are.

use goodbot::Capacities;

/// The robot's mind: all that a host can give it.
pub const MIND: Capacities = Capacities::STANDARD;

/// The most that any of the mind's tables may hold after a model file from elsewhere.
pub const MOST_OF_A_FIELD: usize = 1 << 22;

/// A home alone.
pub const ROOMS: Capacities = Capacities::STANDARD;

/// The scout: smaller than the mind, for looking ahead is a courtesy.
pub const SCOUT: Capacities = Capacities { tasks: 64, ground_propositions: 64, goal_entries: 8_192, states: 1 << 18, ..Capacities::NONE };
