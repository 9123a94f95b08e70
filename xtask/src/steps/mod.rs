//! The steps of `cargo xtask test`, one kind a file.
//!
//! A new step is a file here with a [`Step`] in it and a line in [`ALL`].

mod capi;
mod clippy;
mod cross;
mod docs;
mod firmware;
mod format;
mod guide;
mod page;
mod style;
mod tests;

use anyhow::Result;

use crate::process;
use crate::project;

/// One thing that `cargo xtask test` checks.
pub struct Step {
    /// What it is called, also for `--only`.
    pub name: &'static str,
    /// What it checks, in a few words.
    pub about: &'static str,
    /// Whether it is quick enough for `--fast`.
    pub fast: bool,
    /// Does it; an error is the step's failure.
    pub run: fn(&mut Tally) -> Result<()>,
    /// What to do when it has failed.
    pub next: &'static str,
}

/// All steps, in the order they run: what fails soonest comes first.
pub const ALL: &[Step] = &[
    format::STEP,
    style::STEP,
    clippy::STEP,
    tests::CORE,
    tests::CORE_WITH_STD,
    tests::WORKSPACE,
    docs::STEP,
    cross::SETUP,
    cross::MICROCONTROLLER,
    cross::BROWSER,
    page::STEP,
    capi::HEADER,
    capi::HOST,
    capi::BOARD,
    guide::STEP,
    firmware::COURSE,
    firmware::TICK,
    firmware::SAME_BITS,
    firmware::NO_PANIC,
    firmware::FOOTPRINT,
];

/// How many tests ran, over all steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    pub passed: u64,
    pub failed: u64,
    pub skipped: u64,
}

impl Tally {
    /// Adds what a line of `cargo test`'s output says, if it is such a line.
    fn read(&mut self, line: &str) {
        let Some(result) = line.strip_prefix("test result: ") else {
            return;
        };
        let words: Vec<&str> = result.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty()).collect();
        let count = |what| words.windows(2).find(|pair| pair[1] == what).and_then(|pair| pair[0].parse::<u64>().ok()).unwrap_or(0);
        self.passed += count("passed");
        self.failed += count("failed");
        self.skipped += count("ignored");
    }
}

/// Runs the host's cargo with these arguments.
fn cargo(arguments: &[&str]) -> Result<()> {
    process::run(project::cargo().args(arguments))
}

#[cfg(test)]
mod unit_tests {
    use super::*;

    #[test]
    fn results_of_tests_are_added_up() {
        let mut tally = Tally::default();
        tally.read("running 4 tests");
        tally.read("test result: ok. 4 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out");
        tally.read("test result: FAILED. 2 passed; 3 failed; 0 ignored; finished in 0.00s");
        let expected = Tally { passed: 6, failed: 3, skipped: 1 };
        assert_eq!(tally, expected);
    }

    #[test]
    fn no_two_steps_have_one_name() {
        for (index, step) in ALL.iter().enumerate() {
            assert!(ALL[..index].iter().all(|other| other.name != step.name));
        }
    }
}
