//! The documentation can be built, with no link that leads nowhere.

use anyhow::Result;

use super::{Step, Tally};
use crate::{process, project};

pub const STEP: Step = Step {
    name: "docs",
    about: "the documentation is built without a warning",
    fast: false,
    run,
    next: "mend the doc comments that rustdoc points at",
};

fn run(_: &mut Tally) -> Result<()> {
    let mut command = project::cargo();
    command.args(["doc", "--workspace", "--no-deps"]).env("RUSTDOCFLAGS", "-D warnings");
    process::run(&mut command)
}
