//! The guide to a robot of one's own.

use super::Step;
use crate::guide;

/// Its programs work as they stand.
pub const STEP: Step = Step {
    name: "guide",
    about: "the programs of docs/robot.md are built in an empty folder and say what it promises",
    fast: false,
    run: |_| guide::follow(),
    next: "mend docs/robot.md, or what it speaks of",
};
