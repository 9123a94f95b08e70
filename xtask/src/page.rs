//! `cargo xtask page`: the trainer page as one HTML file, by `page/builder`.

use std::path::PathBuf;

use anyhow::Result;

use crate::programs::{NODE, npm};
use crate::toolchain::{self, Target};
use crate::{process, project};

/// Writes the page, and says what it is made of. It is an error if it has become too large.
pub fn build() -> Result<PathBuf> {
    let node = NODE.path()?;
    npm::packages()?;
    let mut command = toolchain::cross_cargo(Target::Wasm32)?;
    let small = toolchain::without_panic_messages("page")?;
    command.args(["--profile", "page", "--package", "goodbot-wasm"]).args(&small);
    if !small.is_empty() {
        // Where in the sources something may panic: nobody reads that here.
        command.arg(format!("--config=target.{}.rustflags=[\"-Zlocation-detail=none\"]", Target::Wasm32.triple()));
    }
    process::run(&mut command)?;
    let module = toolchain::artifacts(Target::Wasm32, "page").join("goodbot_wasm.wasm");
    let page = project::root().join("dist/goodbot.html");
    process::run(
        project::cargo()
            .args(["run", "--package", "goodbot-page", "--"])
            .args([&module, &page, &node])
            .args(small.is_empty().then_some("--with-panic-messages")),
    )?;
    Ok(page)
}
