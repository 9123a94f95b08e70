//! The steps of `cargo xtask test`, and their outcomes.

use std::time::Duration;

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

use crate::process::described;

/// One check. They run in this order: those that fail soonest come first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
pub enum Step {
    /// files are as rustfmt writes them
    Format,
    /// no file names a place on one machine, or a package's server
    Style,
    /// actionlint finds no fault in the workflows of GitHub Actions
    Workflows,
    /// clippy finds no fault
    Clippy,
    /// the tests of all crates
    Tests,
    /// locked crates, licences, sources and the public interface are as written down, where cargo-deny and cargo-public-api are installed
    Trust,
    /// the documentation of the libraries is built without a warning
    Docs,
    /// the page's module and the program that makes the page are built
    Module,
    /// the core compiles with each of its features alone, and the command line for Windows, where its standard library is ready
    Portable,
    /// the trainer page works in a browser, from a file
    Page,
    /// the examples in C and C++ run under AddressSanitizer and UBSan
    CHost,
    /// the C examples run on an emulated Cortex-M4F and contain no panic
    CBoard,
    /// the programs of docs/robot.md, built in an empty folder, print what it promises
    Guide,
    /// the paper's course passes on emulated boards, a Cortex-M0, a Cortex-M4F and a RISC-V, in its bounds
    Firmware,
    /// a control loop with a fixed tick misses none while the robot learns
    Tick,
    /// the micro:bit's file learns by serial line and buttons on emulated boards, and outlives a torn store
    Microbit,
    /// this machine, WebAssembly and the boards come to the same posteriors, bit for bit
    SameBits,
    /// the linked firmware contains no panic
    NoPanic,
    /// nothing costs more than docs/footprint.md says
    Footprint,
    /// the Python package's tests, types and stubs, of a wheel in an environment of its own
    Python,
}

impl Step {
    /// The lane in which it runs: the steps of a lane run one after another, and the lanes in parallel, because most of the time a step uses
    /// less than one processor: it links one program, waits for a page, or fetches packages. Lane 0 is this process. Boards, what is
    /// built for other programs, and the page's module are lane 1, Python is lane 2.
    pub const fn lane(self) -> usize {
        use Step::{CBoard, CHost, Firmware, Footprint, Guide, Microbit, Module, NoPanic, Portable, Python, SameBits, Tick};
        match self {
            Module | Portable | CHost | CBoard | Guide | Firmware | Tick | Microbit | SameBits | NoPanic | Footprint => 1,
            Python => 2,
            _ => 0,
        }
    }

    /// Its name.
    pub fn name(self) -> String {
        described(self).0
    }

    /// Whether it is quick enough for `--fast`.
    pub const fn is_fast(self) -> bool {
        matches!(self, Self::Format | Self::Style | Self::Workflows | Self::Clippy | Self::Tests)
    }
}

/// The outcome of a step.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Outcome {
    Passed,
    Failed,
    /// It cannot be run here, for this reason.
    LeftOut(String),
}

/// A step that was run, the time that it took, and its outcome.
pub type End = (Step, Duration, Outcome);
