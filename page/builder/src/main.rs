//! The trainer page as one HTML file: `goodbot-page MODULE OUT NODE`, as `cargo xtask page` calls it.
//!
//! The JavaScript glue of the WebAssembly module is generated, and both are put into `page/index.html` together with the page's own style
//! and scripts. The module is packed with LZMA, and the page unpacks it. NODE is the program that makes the scripts small.

mod assemble;
mod budget;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use wasm_bindgen_cli_support::Bindgen;

/// The folder `page`.
const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

fn main() -> Result<()> {
    let arguments: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let [module, out, node] = arguments.as_slice() else { bail!("usage: goodbot-page MODULE OUT NODE") };
    // Beside the module: nothing of it is kept.
    let folder = module.with_extension("page");
    let parts = parts(module, &folder)?;
    let page = assemble::assemble(Path::new(PAGE), &folder, &parts, node)?;
    if let Some(dist) = out.parent() {
        std::fs::create_dir_all(dist).with_context(|| format!("{} cannot be made", dist.display()))?;
    }
    std::fs::write(out, &page.html).with_context(|| format!("{} cannot be written", out.display()))?;
    budget::check(&page, parts.wasm.len())
}

/// What is generated: the module and its glue.
struct Parts {
    wasm: Vec<u8>,
    glue: String,
}

fn parts(module: &Path, folder: &Path) -> Result<Parts> {
    let mut bindgen = Bindgen::new();
    bindgen
        .input_path(module)
        .no_modules(true)
        .and_then(|bindgen| bindgen.no_modules_global("core"))
        .and_then(|bindgen| bindgen.typescript(false).remove_name_section(true).remove_producers_section(true).generate(folder))
        .with_context(|| format!("the glue for {} could not be generated", module.display()))?;
    let read = |name: &str| std::fs::read(folder.join(name)).with_context(|| format!("{name} was not generated"));
    let glue = String::from_utf8(read("goodbot_wasm.js")?).context("the glue is no text")?;
    Ok(Parts { wasm: read("goodbot_wasm_bg.wasm")?, glue })
}
