//! The core can be built for where there is no operating system.

use anyhow::Result;

use super::Step;
use crate::process;
use crate::toolchain::{self, Target};

/// The toolchain, as a step of its own so that its time is not a build's.
pub const SETUP: Step = Step {
    name: "setup",
    about: "other targets can be built for",
    fast: false,
    run: |_| toolchain::setup(),
    next: "see what `cargo xtask setup` says; \
           CROSS_TOOLCHAIN_MODE=rustup or =build-std chooses the way",
};

pub const MICROCONTROLLER: Step = Step {
    name: "microcontroller",
    about: "the core and the course are built for a Cortex-M4F",
    fast: false,
    run: |_| {
        build(Target::Thumbv7emHf, "goodbot")?;
        build(Target::Thumbv7emHf, "goodbot-course")
    },
    next: "the core may use nothing of std but behind its feature `std`, and no heap",
};

pub const BROWSER: Step = Step {
    name: "browser",
    about: "the core and its browser part are built for WebAssembly",
    fast: false,
    run: |_| {
        build(Target::Wasm32, "goodbot")?;
        build(Target::Wasm32, "goodbot-wasm")
    },
    next: "what the browser part uses must be there for wasm32-unknown-unknown",
};

fn build(target: Target, package: &str) -> Result<()> {
    let mut command = toolchain::cross_cargo(target)?;
    process::run(command.args(["--release", "--package", package]))
}
