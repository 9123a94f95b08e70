//! The page's scripts: their types are checked, and they become one.

use std::path::Path;
use std::process::Command;

use anyhow::{Context, Result, bail};
use serde_json::json;

/// The scripts of `page/src` with the module's glue, small, as one text. `generated` has the glue.
pub fn bundle(page: &Path, generated: &Path, node: &Path) -> Result<String> {
    let config = generated.join("tsconfig.json");
    // The scripts call the module `goodbot-wasm`, wherever it was generated.
    let settings = json!({
        "extends": page.join("tsconfig.json"),
        "compilerOptions": { "paths": { "goodbot-wasm": ["./goodbot_wasm.d.ts"] } },
        "include": [page.join("src")],
    });
    std::fs::write(&config, settings.to_string()).with_context(|| format!("{} cannot be written", config.display()))?;
    let packages = page.join("node_modules");
    run(Command::new(node).arg(packages.join("typescript/bin/tsc")).arg("--project").arg(&config), "the types in page/src are wrong")?;
    let small = generated.join("page.min.js");
    let glue = generated.join("goodbot_wasm.js");
    run(Command::new(node).arg(page.join("builder/bundle.mjs")).arg(glue).arg(&small), "the scripts in page/src cannot be joined")?;
    std::fs::read_to_string(&small).with_context(|| format!("{} was not written", small.display()))
}

fn run(command: &mut Command, failure: &str) -> Result<()> {
    if !command.status().with_context(|| format!("{} cannot be started", command.get_program().display()))?.success() {
        bail!("{failure}");
    }
    Ok(())
}
