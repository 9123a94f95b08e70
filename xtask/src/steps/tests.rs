//! The tests that run on the host.

use anyhow::Result;

use super::{Step, Tally};
use crate::{process, project};

const NEXT: &str = "run the failed test alone, by the command above with the test's name after it";

/// The core alone, as a microcontroller has it.
pub const CORE: Step = Step {
    name: "core",
    about: "the core's tests, without features",
    fast: true,
    run: |tally| test(tally, &["-p", "goodbot"]),
    next: NEXT,
};

/// The core as a host has it.
pub const CORE_WITH_STD: Step = Step {
    name: "core-std",
    about: "the core's tests, with std",
    fast: true,
    run: |tally| test(tally, &["-p", "goodbot", "--features", "std"]),
    next: NEXT,
};

/// Everything.
pub const WORKSPACE: Step =
    Step { name: "workspace", about: "the tests of all crates", fast: true, run: |tally| test(tally, &["--workspace"]), next: NEXT };

fn test(tally: &mut Tally, arguments: &[&str]) -> Result<()> {
    let mut command = project::cargo();
    command.arg("test").args(arguments);
    process::run_with_lines(&mut command, |line| tally.read(line))
}
