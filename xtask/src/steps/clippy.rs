//! Clippy has nothing to say.

use super::{Step, cargo};

pub const STEP: Step = Step {
    name: "clippy",
    about: "clippy has nothing to say",
    fast: true,
    run: |_| cargo(&["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"]),
    next: "mend what clippy points at; an `#[expect(…, reason = \"…\")]` is for where it is wrong",
};
