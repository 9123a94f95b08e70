//! Every file is as rustfmt writes it.

use super::{Step, cargo};

pub const STEP: Step = Step {
    name: "format",
    about: "files are as rustfmt writes them",
    fast: true,
    run: |_| cargo(&["fmt", "--all", "--check"]),
    next: "run `cargo fmt --all`",
};
