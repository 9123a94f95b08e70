//! The steps of `cargo xtask test`, one kind a file.
//!
//! A new step is a [`Step`] in a file here and a line in [`ALL`].

mod capi;
mod firmware;
mod page;
mod python;
mod tests;
mod text;

use std::process::Command;

use anyhow::Result;

use crate::process;

/// One thing that `cargo xtask test` checks.
pub struct Step {
    /// What it is called, also for `--only`.
    pub name: &'static str,
    /// What it checks, in a few words.
    pub about: &'static str,
    /// Whether it is quick enough for `--fast`.
    pub fast: bool,
    /// Does it; an error is the step's failure, or says by a [`Missing`](crate::programs::Missing) that it cannot be done here.
    pub run: fn(&mut Run) -> Result<()>,
    /// What to do when it has failed.
    pub next: &'static str,
}

impl Step {
    const fn new(name: &'static str, about: &'static str, run: fn(&mut Run) -> Result<()>, next: &'static str) -> Self {
        Self { name, about, fast: false, run, next }
    }

    const fn fast(self) -> Self {
        Self { fast: true, ..self }
    }
}

/// All steps, in the order they run: what fails soonest comes first.
pub const ALL: &[Step] = &[
    text::FORMAT,
    text::STYLE,
    text::CLIPPY,
    tests::STEP,
    text::DOCS,
    python::STEP,
    page::STEP,
    capi::HEADER,
    capi::HOST,
    capi::BOARD,
    capi::GUIDE,
    firmware::COURSE,
    firmware::TICK,
    firmware::MICROBIT,
    firmware::SAME_BITS,
    firmware::NO_PANIC,
    firmware::FOOTPRINT,
];

/// The crates that are checked and tested together. The page's builder has none but its own dependencies, which take minutes; making the page
/// tests it.
const WORKSPACE: [&str; 3] = ["--workspace", "--exclude", "goodbot-page"];

/// The steps that were chosen, and what they have counted so far.
#[derive(Default)]
pub struct Run {
    /// Whether to leave out what takes long.
    pub fast: bool,
    pub chosen: Vec<&'static Step>,
    pub tally: Tally,
}

impl Run {
    fn includes(&self, step: &Step) -> bool {
        self.chosen.iter().any(|chosen| chosen.name == step.name)
    }

    /// Runs a program, and counts the tests that it says it ran.
    fn count(&mut self, command: &mut Command) -> Result<()> {
        process::run_with_lines(command, |line| self.tally.read(line))
    }
}

/// How many tests ran, over all steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    pub passed: u64,
    pub failed: u64,
    pub skipped: u64,
}

impl Tally {
    /// Adds what a line says, if it is one that sums up: of cargo's, of nextest's, of node's or of pytest's.
    fn read(&mut self, line: &str) {
        let words: Vec<&str> = line.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()).collect();
        let before = |what| words.windows(2).find(|pair| pair[1] == what).and_then(|pair| pair[0].parse::<u64>().ok()).unwrap_or(0);
        if line.starts_with("test result: ") || line.trim_start().starts_with("Summary [") {
            self.passed += before("passed");
            self.failed += before("failed") + before("timed");
            self.skipped += before("ignored") + before("skipped");
        } else if line.ends_with('s') && words.contains(&"in") && words.first().is_some_and(|word| word.parse::<u64>().is_ok()) {
            self.passed += before("passed");
            self.failed += before("failed") + before("errors") + before("error");
            self.skipped += before("skipped");
        } else if let (Some("ℹ" | "#"), [what, number]) = (line.split(' ').next(), words.as_slice()) {
            let number = number.parse().unwrap_or(0);
            match *what {
                "pass" => self.passed += number,
                "fail" | "cancelled" => self.failed += number,
                "skipped" | "todo" => self.skipped += number,
                _ => {}
            }
        }
    }
}

#[cfg(test)]
mod unit_tests {
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

    #[test]
    fn no_two_steps_have_one_name() {
        for (index, step) in ALL.iter().enumerate() {
            assert!(ALL[..index].iter().all(|other| other.name != step.name));
        }
    }
}
