//! Made by `goodbot fit-trainers feedback.jsonl --rust`; do not edit.

use crate::feedback::{Ending, Hazard, Strategy};

/// The strategies of real trainers and of exact ones, each with its share of them: see [`population`](super).
pub const STRATEGIES: [(Strategy, f32); 10] = [
    (Strategy::of_people([0.98, 0.937, 0.45], [0.973, 0.96, 0.09, 1.0], [1.0, 0.0, 0.0]), 0.213),
    (Strategy::of_people([0.937, 0.75, 0.128], [0.819, 0.732, 0.044, 1.0], [1.0, 0.0, 0.0]), 0.178),
    (Strategy::of_people([0.919, 0.96, 0.277], [0.815, 0.776, 0.265, 1.0], [1.0, 0.0, 0.0]), 0.153),
    (Strategy::of_people([0.961, 0.88, 0.257], [0.847, 0.927, 0.25, 1.0], [1.0, 0.0, 0.0]), 0.142),
    (Strategy::of_people([0.767, 0.866, 0.313], [0.629, 0.941, 0.45, 1.0], [1.0, 0.0, 0.0]), 0.109),
    (Strategy::of_people([0.949, 0.91, 0.312], [0.856, 0.924, 0.228, 1.0], [1.0, 0.0, 0.0]), 0.104),
    (Strategy::of_people([0.05, 0.05, 0.02], [0.05, 0.05, 0.02, 0.5], [1.0, 0.0, 0.0]), 0.04),
    (Strategy::of_people([0.05, 1.0, 0.02], [0.05, 1.0, 0.02, 0.5], [1.0, 0.0, 0.0]), 0.02),
    (Strategy::of_people([1.0, 0.05, 0.02], [1.0, 0.05, 0.02, 0.5], [1.0, 0.0, 0.0]), 0.02),
    (Strategy::of_people([0.5, 0.5, 0.02], [0.5, 0.5, 0.02, 0.5], [1.0, 0.0, 0.0]), 0.02),
];

/// How often real trainers end a session at the goal, and elsewhere.
pub const ENDING: Ending = Ending {
    at_goal: Hazard { moved: 0.037, rested: 0.069, resting: 0.156, praised: 1.339, scolded: 0.154 },
    elsewhere: Hazard { moved: 0.032, rested: 0.024, resting: 0.081, praised: 2.427, scolded: 0.451 },
};
