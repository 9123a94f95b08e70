//! The drill on this machine and in WebAssembly: the same run as on the boards.

use anyhow::{Context, Result};

use crate::programs::NODE;
use crate::toolchain::{self, Target};
use crate::{process, project};

const PACKAGE: &str = "goodbot-drill";

/// The digest that this machine gives.
pub fn host() -> Result<u64> {
    let mut cargo = project::cargo();
    cargo.args(["run", "--quiet", "--release", "--locked", "--package", PACKAGE, "--manifest-path"]);
    cargo.arg(project::root().join("firmware/Cargo.toml")).arg("--target-dir").arg(project::target_dir().join("drill"));
    let said = process::capture(&mut cargo)?;
    let digest = said.lines().find_map(|line| line.strip_prefix("digest "));
    digest.and_then(|digest| digest.parse().ok()).context("the drill printed no digest")
}

/// The digest that a WebAssembly engine gives.
pub fn wasm() -> Result<u64> {
    let mut cargo = toolchain::cross_cargo_as(Target::Wasm32, "rustc")?;
    cargo.args(["--quiet", "--release", "--locked", "--package", PACKAGE, "--lib", "--crate-type", "cdylib", "--manifest-path"]);
    process::run(cargo.arg(project::root().join("firmware/Cargo.toml")))?;
    let module = toolchain::artifacts(Target::Wasm32, "release").join("goodbot_drill.wasm");
    let script = "const bytes = require('fs').readFileSync(process.argv[1]); \
                  WebAssembly.instantiate(bytes, {}).then(({ instance }) => \
                  console.log(instance.exports.goodbot_drill_digest() >>> 0));";
    let said = process::capture(NODE.command()?.args(["--eval", script]).arg(module))?;
    said.trim().parse().with_context(|| format!("node printed no digest but `{}`", said.trim()))
}
