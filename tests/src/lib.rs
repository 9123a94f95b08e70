//! Shared parts of the tests that cross goodbot's crates: reference numbers, homes from them, oracles for plans, and hostile input.

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

/// The README's lesson.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct Readme;

/// The recipes for Rust.
#[cfg(doctest)]
#[doc = include_str!("../../docs/cookbook.md")]
pub struct Cookbook;
