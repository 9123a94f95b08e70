//! Measurements other than the footprint.

use anyhow::{Context, Result};
use xshell::cmd;

use crate::process::{shell, target_dir};
use crate::programs::{NODE, VALGRIND, python_with};
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

/// Counts, by valgrind, the instructions of each benchmark with `filter` in its name. Other load of the machine does not change them.
pub fn instructions(filter: &str) -> Result<()> {
    let (sh, valgrind) = (shell()?, VALGRIND.path()?);
    cmd!(sh, "cargo build --profile dist --quiet --package goodbot-benches --bin measure").run()?;
    let measure = target_dir().join("dist/measure");
    let count = |name: &str, times: &str| {
        let run = cmd!(sh, "{valgrind} --tool=callgrind --callgrind-out-file=/dev/null {measure} {name} {times}");
        let said = run.quiet().ignore_stdout().read_stderr()?;
        collected(&said).context("callgrind gave no total")
    };
    println!("| work | instructions |\n|---|---|");
    for name in cmd!(sh, "{measure}").read()?.lines().filter(|name| name.contains(filter)) {
        // Both counts include the preparation.
        println!("| {name} | {} |", count(name, "2")?.saturating_sub(count(name, "1")?));
    }
    Ok(())
}

/// The total that callgrind prints at its end.
fn collected(said: &str) -> Option<u64> {
    said.rsplit_once("Collected :")?.1.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_total_is_read() {
        assert_eq!(collected("==7== Events    : Ir\n==7== Collected : 1234\n==7== \n"), Some(1234));
        assert_eq!(collected("==7== Events    : Ir\n"), None);
    }
}
