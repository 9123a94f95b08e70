//! `cargo xtask page`: the trainer page as one HTML file, by `page/builder`.

use std::path::PathBuf;

use anyhow::Result;
use xshell::{Cmd, Shell, cmd};

use crate::process::{shell, target_dir};
use crate::programs::{NODE, npm_packages};
use crate::toolchain::{self, WASM};

/// Where the page's builder is built: apart from the workspace's own builds, which run at the same time, and with which it shares next to nothing.
fn builder<'sh>(sh: &'sh Shell, what: &str) -> Cmd<'sh> {
    let folder = target_dir().join("page-builder");
    cmd!(sh, "cargo {what} --package goodbot-page --target-dir {folder}")
}

/// Builds the module and the builder, and writes nothing: the page is then made within seconds.
pub fn prepare() -> Result<()> {
    let sh = shell()?;
    module(&sh)?;
    Ok(builder(&sh, "build").run()?)
}

/// Builds the module. Returns its path, and whether it has messages of panics.
fn module(sh: &Shell) -> Result<(PathBuf, bool)> {
    let (module, has_messages) = toolchain::module(sh)?;
    module.args(["--package", "goodbot-wasm"]).run()?;
    Ok((toolchain::artifacts(WASM, "page").join("goodbot_wasm.wasm"), has_messages))
}

/// Writes the page, and prints the sizes of its parts. It is an error if the page is too large.
pub fn build() -> Result<()> {
    let (sh, node) = (shell()?, NODE.path()?);
    npm_packages()?;
    let (module, has_messages) = module(&sh)?;
    let flag = has_messages.then_some("--with-panic-messages");
    Ok(builder(&sh, "run").arg("--").arg(module).arg("dist/goodbot.html").arg(node).args(flag).run()?)
}
