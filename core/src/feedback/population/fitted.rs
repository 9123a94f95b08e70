//! Made by `goodbot fit-trainers feedback.jsonl --rust`; do not edit.

use crate::feedback::{Ending, Hazard, Strategy};

/// The strategies of real trainers, each with its share of them: see [`population`](super).
pub const STRATEGIES: [(Strategy, f32); 13] = [
    (Strategy::of_people([0.906, 0.735, 0.089], [0.906, 0.735, 0.089, 1.0], [0.968, 0.03, 0.002]), 0.096),
    (Strategy::of_people([0.983, 0.939, 0.437], [0.983, 0.939, 0.437, 1.0], [0.957, 0.041, 0.002]), 0.095),
    (Strategy::of_people([0.905, 0.754, 0.102], [0.905, 0.754, 0.102, 1.0], [0.96, 0.038, 0.002]), 0.085),
    (Strategy::of_people([0.661, 0.916, 0.45], [0.661, 0.916, 0.45, 1.0], [0.976, 0.023, 0.001]), 0.084),
    (Strategy::of_people([0.906, 0.908, 0.278], [0.906, 0.908, 0.278, 1.0], [0.963, 0.035, 0.002]), 0.076),
    (Strategy::of_people([0.906, 0.908, 0.28], [0.906, 0.908, 0.28, 1.0], [0.969, 0.03, 0.001]), 0.074),
    (Strategy::of_people([0.922, 0.915, 0.263], [0.922, 0.915, 0.263, 1.0], [0.919, 0.074, 0.007]), 0.074),
    (Strategy::of_people([0.906, 0.909, 0.295], [0.906, 0.909, 0.295, 1.0], [0.979, 0.02, 0.001]), 0.072),
    (Strategy::of_people([0.979, 0.94, 0.34], [0.979, 0.94, 0.34, 1.0], [0.958, 0.04, 0.002]), 0.07),
    (Strategy::of_people([0.979, 0.94, 0.337], [0.979, 0.94, 0.337, 1.0], [0.958, 0.04, 0.002]), 0.069),
    (Strategy::of_people([0.979, 0.939, 0.334], [0.979, 0.939, 0.334, 1.0], [0.957, 0.041, 0.002]), 0.069),
    (Strategy::of_people([0.979, 0.939, 0.334], [0.979, 0.939, 0.334, 1.0], [0.957, 0.041, 0.002]), 0.069),
    (Strategy::of_people([0.979, 0.939, 0.334], [0.979, 0.939, 0.334, 1.0], [0.958, 0.04, 0.002]), 0.069),
];

/// How often real trainers end a session at the goal, and elsewhere.
pub const ENDING: Ending = Ending { at_goal: Hazard::of(0.129), elsewhere: Hazard::of(0.042) };
