//! What the tests that cross goodbot's crates share: the external data, and homes from them.

#![deny(missing_docs)]

pub mod brute_force;
pub mod fixture;
pub mod hostile;
pub mod own_planner;
pub mod plan_sums;
pub mod random_homes;
pub mod reachable;
pub mod school;
pub mod sweep;
pub mod turning_robot;
pub mod without_grid;

use std::path::PathBuf;

/// The folder of external data beside the project, `None` (with a printed line) where it is absent.
pub fn external(file: &str) -> Option<PathBuf> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../shared").join(file);
    if path.exists() {
        return Some(path);
    }
    println!("skipped: the external data file {file} is not beside the project");
    None
}
