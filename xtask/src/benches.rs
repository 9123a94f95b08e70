//! Measurements other than the footprint.

use anyhow::Result;
use xshell::cmd;

use crate::process::shell;
use crate::programs::{NODE, python_with};
use crate::toolchain::{self, WASM};

/// Compares goodbot with other programs on the same work, in one run. A line names each that cannot be installed and is left out.
pub fn compare() -> Result<()> {
    let sh = shell()?;
    match python_with("nltk==3.10.4", "peers") {
        Ok(programs) => sh.set_var("GOODBOT_PEERS_PYTHON", programs.join("python")),
        Err(error) => eprintln!("skipped: NLTK cannot be installed: {error:#}"),
    }
    Ok(cmd!(sh, "cargo run --profile dist --quiet --package goodbot-benches --bin compare").run()?)
}

/// Runs each benchmark natively and in WebAssembly: its native time, its time in node, and the ratio.
pub fn wasm() -> Result<()> {
    let (sh, _) = (shell()?, NODE.path()?);
    let module = toolchain::cargo(&sh, WASM, "rustc")?.args(["--quiet", "--profile", "dist", "--package", "goodbot-benches", "--lib"]);
    module.args(["--crate-type", "cdylib"]).run()?;
    let module = toolchain::artifacts(WASM, "dist").join("goodbot_benches.wasm");
    Ok(cmd!(sh, "cargo run --profile dist --quiet --package goodbot-benches --bin wasm -- {module}").run()?)
}

/// Draws the cost of a plan against states, tasks and blocks.
pub fn plot() -> Result<()> {
    let sh = shell()?;
    Ok(cmd!(sh, "cargo run --profile dist --quiet --package goodbot-benches --bin plot -- docs/planning-cost.svg").run()?)
}
