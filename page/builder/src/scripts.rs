//! Calls npm's programs for the page: they check the types of its scripts, join the scripts, and make the style and the module small.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};
use serde_json::json;

/// The page's scripts and its style, made small.
pub struct Scripts {
    /// The script that expands the packed parts.
    pub begin: String,
    /// All others, with the module's glue.
    pub others: String,
    /// The style.
    pub style: String,
}

/// Joins the scripts of `page/src` with the module's glue, which `generated` has.
pub fn bundle(page: &Path, generated: &Path, node: &Path) -> Result<Scripts> {
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
    let [begin, others, style] = ["begin.min.js", "others.min.js", "style.min.css"].map(|name| generated.join(name));
    let mut bundle = Command::new(node);
    bundle
        .arg(page.join("builder/bundle.mjs"))
        .arg(generated.join("goodbot_wasm.js"))
        .args([&begin, &others, &style])
        .arg(env!("CARGO_PKG_VERSION"));
    run(&mut bundle, "the scripts in page/src cannot be joined")?;
    let read = |small: &Path| std::fs::read_to_string(small).with_context(|| format!("{} was not written", small.display()));
    Ok(Scripts { begin: read(&begin)?, others: read(&others)?, style: read(&style)? })
}

/// The module without unused parts and duplicate functions, written so that it packs well. Binaryen's other passes make the module itself smaller, but larger when packed.
pub fn packable(page: &Path, module: &Path, node: &Path) -> Result<PathBuf> {
    let small = module.with_extension("small.wasm");
    // The lowest kilobyte of memory is the end of the stack, so an address may have its constant as an offset.
    let passes = "low-memory-unused remove-unused-brs remove-unused-names merge-blocks optimize-instructions dealign remove-unused-module-elements \
        duplicate-function-elimination rse vacuum remove-unused-brs optimize-instructions vacuum optimize-added-constants reorder-locals strip-target-features";
    let mut optimizer = Command::new(node);
    optimizer.arg(page.join("node_modules/binaryen/bin/wasm-opt")).args(passes.split(' ').map(|pass| format!("--{pass}")));
    run(optimizer.arg(module).arg("-o").arg(&small), "binaryen cannot make the module smaller")?;
    Ok(small)
}

fn run(command: &mut Command, failure: &str) -> Result<()> {
    if !command.status().with_context(|| format!("{} cannot be started", command.get_program().display()))?.success() {
        bail!("{failure}");
    }
    Ok(())
}
