//! The promises of the whole project, tested from outside.

#[path = "../../../core/examples/arm/domain.rs"]
mod arm;
#[path = "../../../firmware/src/commands.rs"]
mod commands;
mod lamps;
#[path = "../../../firmware/src/lessons.rs"]
mod lessons;
#[path = "../../../core/examples/lift/domain.rs"]
mod lift;
#[path = "../../../core/examples/teach/mod.rs"]
mod teach;
mod turning_robot;

use goodbot_drill::digest;

mod bit_flips;
mod bounds;
mod derived_facts;
mod every_state;
mod example_robots;
mod format;
mod full_memory;
mod fuzz_smoke;
mod joining;
mod large_homes;
mod laws;
mod least_capacities;
mod one_life;
mod optimal_sets;
mod parameters;
mod power_loss;
mod reference_numbers;
mod restoring;
mod rows;
mod second_robot;
mod snapshot;
mod sound_domains;
mod understanding;
mod unlearning;
mod ways;
