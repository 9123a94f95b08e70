//! Simulations whose figures the documentation has. They run with few robots, unless `GOODBOT_ROBOTS` names more.

mod questions;
mod ways;

/// The number of robots: as the environment says, else this many.
fn robots(few: u64) -> u64 {
    std::env::var("GOODBOT_ROBOTS").map_or(few, |robots| robots.parse().expect("GOODBOT_ROBOTS is a number"))
}
