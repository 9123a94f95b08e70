//! The tests that run on the host.

use anyhow::{Result, bail};

use super::page::{self, EXPORT};
use super::{Run, Step, WORKSPACE};
use crate::{process, project};

pub const STEP: Step =
    Step::new("tests", "the tests of all crates", all, "run the failed test alone: `cargo test --workspace`, and the test's name after it")
        .fast();

/// By cargo-nextest where it is, which runs the tests of several files at once and knows which take long, else by cargo.
fn all(run: &mut Run) -> Result<()> {
    let has_nextest = process::capture(project::cargo().args(["nextest", "--version"])).is_ok();
    let ways: &[&[&str]] = match (has_nextest, run.fast) {
        (true, true) => &[&["nextest", "run", "--no-fail-fast", "--profile", "fast"]],
        (true, false) => &[&["nextest", "run", "--no-fail-fast"], &["test", "--doc"]],
        (false, _) => &[&["test"]],
    };
    for way in ways {
        let mut command = project::cargo();
        command.args(*way).args(WORKSPACE);
        if run.includes(&page::STEP) {
            command.env(EXPORT, "later");
        }
        run.count(&mut command)?;
    }
    if run.tally.passed == 0 {
        bail!("no test ran");
    }
    Ok(())
}
