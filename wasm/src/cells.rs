//! The capacities of the page's robot, homes and scout.

use goodbot::Capacities;

/// The robot's mind: the preset for hosts.
pub const MIND: Capacities = Capacities::STANDARD;

/// The most entries that a model file from elsewhere may demand for a table of the mind.
pub const MOST_OF_A_FIELD: usize = 1 << 22;

/// A home alone.
pub const ROOMS: Capacities = Capacities::STANDARD;

/// The scout: smaller than the mind, because the page can do without looking ahead.
pub const SCOUT: Capacities = Capacities { tasks: 64, ground_propositions: 64, goal_entries: 8_192, states: 1 << 18, ..Capacities::NONE };
