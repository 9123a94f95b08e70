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
    let (module, has_messages) = toolchain::module(&sh)?;
    module.args(["--package", "goodbot-wasm"]).run()?;
    let flag = has_messages.then_some("--with-panic-messages");
    let module = toolchain::artifacts(WASM, "page").join("goodbot_wasm.wasm");
    Ok(cmd!(sh, "cargo run --package goodbot-page -- {module} dist/goodbot.html {node} {flag...}").run()?)
}
