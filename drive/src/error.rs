//! The reasons to refuse a setting or an action.

use core::fmt;
use goodbot::oomdp::Action;

/// An invalid setting or action.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum DriveError {
    /// A cell's side is not above 0.
    CellSize(f32),
    /// The hysteresis is not from 0 to below a half of a cell.
    Hysteresis(f32),
    /// A limit is not above 0, or `slowest` is above 1.
    Limit {
        /// The name of the limit.
        name: &'static str,
        /// Its value.
        value: f32,
    },
    /// The action leads to no neighbouring cell.
    NoNeighbour(Action),
    /// A counter does not have 2 to 32 bits, or its ticks per metre are 0 or not a number.
    Encoder {
        /// The ticks.
        ticks_per_metre: f32,
        /// The bits.
        bits: u32,
    },
    /// A gain is below 0 or not a number.
    Gain {
        /// The name of the gain.
        name: &'static str,
        /// Its value.
        value: f32,
    },
    /// A measured run is unusable.
    Run {
        /// The name of the run.
        name: &'static str,
        /// The ticks of the left and the right wheel.
        ticks: [f32; 2],
    },
}

impl fmt::Display for DriveError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::CellSize(size) => write!(out, "a cell's side of {size} m: it must be above 0"),
            Self::Hysteresis(share) => write!(out, "a hysteresis of {share} of a cell: it must be at least 0 and below 0.5"),
            Self::Limit { name: "slowest", value } => write!(out, "slowest is {value}: it must be above 0 and at most 1"),
            Self::Limit { name, value } => write!(out, "{name} is {value}: it must be above 0"),
            Self::NoNeighbour(action) => write!(out, "action {} leads to no neighbouring cell: only 0 to 3 do", action.index()),
            Self::Encoder { ticks_per_metre, bits } => {
                write!(
                    out,
                    "an encoder of {bits} bits with {ticks_per_metre} ticks a metre: take 2 to 32 bits, and a number of ticks other than 0"
                )
            }
            Self::Gain { name, value } => write!(out, "the gain {name} is {value}: it must be at least 0"),
            Self::Run { name: "straight", ticks: [left, right] } => {
                write!(out, "the straight run has {left} and {right} ticks: both wheels must roll, and the metres must be above 0")
            }
            Self::Run { name, ticks: [left, right] } => {
                write!(out, "the run {name} has {left} and {right} ticks: turn on the spot to the left, by a number of turns above 0")
            }
        }
    }
}

impl core::error::Error for DriveError {}
