//! The steps of `cargo xtask test`, their outcomes, and the number of tests that they have run.

use crate::process::described;
use anyhow::{Context, Result, ensure};
use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use std::io::{BufRead, BufReader};
use std::process::Command;
use std::time::Duration;
use xshell::Cmd;

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

/// The chosen steps, and the tests that they have counted so far.
#[derive(Default)]
pub struct Run {
    /// Whether to leave out the longest tests.
    pub fast: bool,
    /// Whether to run also what is much like the rest, such as a second board with the same instructions.
    pub all_boards: bool,
    pub chosen: Vec<Step>,
    pub tally: Tally,
}

/// The number of tests, over all steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tally {
    pub passed: u64,
    pub failed: u64,
    pub skipped: u64,
}

impl Tally {
    pub fn add(&mut self, other: Self) {
        self.passed += other.passed;
        self.failed += other.failed;
        self.skipped += other.skipped;
    }

    /// Adds the numbers of a summary line of cargo, nextest, node or pytest. Other lines add nothing.
    fn read(&mut self, line: &str) {
        let words: Vec<&str> = line.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()).collect();
        let is_number = |word: &&str| word.bytes().all(|c| c.is_ascii_digit());
        let of_cargo = line.starts_with("test result: ") || line.trim_start().starts_with("Summary [");
        let of_pytest = line.ends_with('s') && words.contains(&"in") && words.first().is_some_and(is_number);
        let of_node = line.starts_with(['ℹ', '#']) && words.len() == 2;
        if !of_cargo && !of_pytest && !of_node {
            return;
        }
        for pair in words.windows(2) {
            // Node prints the number after its name, the others before it.
            let (name, number) = if of_node { (pair[0], pair[1]) } else { (pair[1], pair[0]) };
            let number = number.parse().unwrap_or(0);
            match name {
                "passed" | "pass" => self.passed += number,
                "failed" | "fail" | "timed" | "error" | "errors" | "cancelled" => self.failed += number,
                "skipped" | "skip" | "ignored" | "todo" => self.skipped += number,
                _ => {}
            }
        }
    }
}

impl Run {
    /// Runs a program, shows its output, and adds up its test summaries.
    pub fn count(&mut self, command: Cmd) -> Result<()> {
        let shown = command.to_string();
        println!("$ {shown}");
        let (reader, writer) = std::io::pipe()?;
        let child = Command::from(command).stdout(writer.try_clone()?).stderr(writer).spawn();
        let mut child = child.with_context(|| format!("`{shown}` could not be started"))?;
        for line in BufReader::new(reader).split(b'\n') {
            let line = line?;
            let line = String::from_utf8_lossy(&line);
            println!("{line}");
            self.tally.read(&line);
        }
        let status = child.wait()?;
        ensure!(status.success(), "`{shown}` failed ({status})");
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_of_tests_are_added_up() {
        let lines = [
            "running 4 tests",
            "    test result: FAILED. 0 passed; 1 failed; as nextest shows it once more",
            "test result: ok. 4 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out",
            "test result: FAILED. 2 passed; 3 failed; 0 ignored; finished in 0.00s",
            "     Summary [   1.234s] 12 tests run: 10 passed (1 slow), 1 failed, 1 timed out, 5 skipped",
            "ℹ tests 7",
            "ℹ pass 6",
            "ℹ fail 0",
            "ℹ skipped 1",
            "1 failed, 4 passed, 2 skipped in 3.21s",
            "3 passed the bread in time",
        ];
        let mut tally = Tally::default();
        lines.into_iter().for_each(|line| tally.read(line));
        assert_eq!(tally, Tally { passed: 26, failed: 6, skipped: 9 });
    }
}
