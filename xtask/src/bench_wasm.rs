//! Each benchmark here and in WebAssembly, in one run.

use anyhow::Result;

use crate::programs::NODE;
use crate::toolchain::{self, Target};
use crate::{process, project};

/// Prints one line a work: its time, that in node, and the ratio.
pub fn run() -> Result<()> {
    NODE.path()?;
    let mut command = toolchain::cross_cargo_as(Target::Wasm32, "rustc")?;
    process::run(command.args(["--quiet", "--release", "--package", "goodbot-benches", "--lib", "--crate-type", "cdylib"]))?;
    let module = toolchain::artifacts(Target::Wasm32, "release").join("goodbot_benches.wasm");
    let mut command = project::cargo();
    command.args(["run", "--release", "--quiet", "--package", "goodbot-benches", "--bin", "wasm", "--"]);
    process::run(command.arg(module))
}
