//! The reference plans of a task, as sums over the states that can be reached.

use serde_json::Value;

/// The sums of one task.
#[derive(Clone, Copy, Debug, Default)]
pub struct PlanSums {
    max: u64,
    total: u64,
    goals: u64,
    optimal_moves: u64,
}

impl PlanSums {
    /// Adds a state from which the goal can be reached: its distance, and how many actions begin a shortest way.
    pub fn add(&mut self, distance: u64, optimal_moves: u64) {
        self.max = self.max.max(distance);
        self.total += distance;
        self.goals += u64::from(distance == 0);
        self.optimal_moves += optimal_moves;
    }

    /// Panics if the reference has other sums for the task of this name.
    pub fn assert_are(&self, name: &str, reference: &Value) {
        let expected = ["max", "total", "goals", "optimal_moves"].map(|field| reference[field].as_u64().unwrap());
        assert_eq!([self.max, self.total, self.goals, self.optimal_moves], expected, "{name}");
    }
}
