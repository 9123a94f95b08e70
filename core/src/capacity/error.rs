//! The error of a full table.

use super::Capacity;
use crate::task::TaskSet;
use core::fmt;

/// A table was full: which one, its limit, and the number of entries asked for (at least).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CapacityError {
    /// The capacity that was exceeded.
    pub capacity: Capacity,
    /// The limit.
    pub limit: u32,
    /// The number asked for. If the total was not counted to the end, the first number beyond the limit.
    pub given: u32,
}

impl CapacityError {
    /// The error for a table of `limit` entries that was asked for `given`.
    pub const fn new(capacity: Capacity, limit: usize, given: usize) -> Self {
        Self { capacity, limit: clamp(limit), given: clamp(given) }
    }

    /// The error for the next entry after `limit`.
    pub const fn full(capacity: Capacity, limit: usize) -> Self {
        Self::new(capacity, limit, limit.saturating_add(1))
    }
}

const fn clamp(count: usize) -> u32 {
    if count > u32::MAX as usize { u32::MAX } else { count as u32 }
}

impl fmt::Display for CapacityError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let field = self.capacity.field();
        let remedy = match self.capacity {
            Capacity::Tasks if self.given as usize > TaskSet::MOST => {
                return write!(
                    f,
                    "no room: {field} is {}, and {} or more were given; more than {} cannot be told apart: give fewer objects or lifted tasks",
                    self.limit,
                    self.given,
                    TaskSet::MOST
                );
            }
            _ if field.starts_with("Capacities") => "raise it",
            _ => "it is fixed: give fewer, or shorter ones",
        };
        write!(f, "no room: {field} is {}, and {} or more were given; {remedy}", self.limit, self.given)
    }
}

impl core::error::Error for CapacityError {}
