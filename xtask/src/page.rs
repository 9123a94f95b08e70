//! `cargo xtask page`: the trainer page as one HTML file, by `page/builder`.

use anyhow::Result;
use xshell::cmd;

use crate::process::shell;
use crate::programs::{NODE, npm_packages};
use crate::toolchain::{self, WASM};

/// Writes the page, and prints the sizes of its parts. It is an error if the page is too large.
pub fn build() -> Result<()> {
    let (sh, node) = (shell()?, NODE.path()?);
    npm_packages()?;
    let small = toolchain::without_panic_messages("page")?;
    // Leaves out the source locations of panics, which nobody could read here.
    let no_places = format!("--config=target.{WASM}.rustflags=[\"-Zlocation-detail=none\"]");
    let (settings, flag) = if small.is_empty() { (None, Some("--with-panic-messages")) } else { (Some(no_places), None) };
    // Only the module: with the library for its tests in the same call, cargo leaves out the optimisation at link time.
    let module = toolchain::cargo(&sh, WASM, "rustc")?.args(["--profile", "page", "--package", "goodbot-wasm", "--crate-type", "cdylib"]);
    module.args(small).args(settings).run()?;
    let module = toolchain::artifacts(WASM, "page").join("goodbot_wasm.wasm");
    Ok(cmd!(sh, "cargo run --package goodbot-page -- {module} dist/goodbot.html {node} {flag...}").run()?)
}
