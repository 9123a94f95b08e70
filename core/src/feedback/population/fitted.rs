//! Made by `goodbot fit-trainers feedback.jsonl --rust`; do not edit.

use crate::feedback::{Ending, Strategy};

/// The strategies of real trainers, each with its share of them: see [`population`](super).
pub const STRATEGIES: [(Strategy, f32); 13] = [
    (Strategy::known(0.906, 0.735, 0.089, [0.968, 0.03, 0.002]), 0.096),
    (Strategy::known(0.983, 0.939, 0.437, [0.957, 0.041, 0.002]), 0.095),
    (Strategy::known(0.905, 0.754, 0.102, [0.96, 0.038, 0.002]), 0.085),
    (Strategy::known(0.661, 0.916, 0.45, [0.976, 0.023, 0.001]), 0.084),
    (Strategy::known(0.906, 0.908, 0.278, [0.963, 0.035, 0.002]), 0.076),
    (Strategy::known(0.906, 0.908, 0.28, [0.969, 0.03, 0.001]), 0.074),
    (Strategy::known(0.922, 0.915, 0.263, [0.919, 0.074, 0.007]), 0.074),
    (Strategy::known(0.906, 0.909, 0.295, [0.979, 0.02, 0.001]), 0.072),
    (Strategy::known(0.979, 0.94, 0.34, [0.958, 0.04, 0.002]), 0.07),
    (Strategy::known(0.979, 0.94, 0.337, [0.958, 0.04, 0.002]), 0.069),
    (Strategy::known(0.979, 0.939, 0.334, [0.957, 0.041, 0.002]), 0.069),
    (Strategy::known(0.979, 0.939, 0.334, [0.957, 0.041, 0.002]), 0.069),
    (Strategy::known(0.979, 0.939, 0.334, [0.958, 0.04, 0.002]), 0.069),
];

/// How often real trainers end a session at the goal, and elsewhere.
pub const ENDING: Ending = Ending { at_goal: 0.129, elsewhere: 0.042 };
