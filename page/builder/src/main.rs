//! The trainer page as one HTML file: `goodbot-page MODULE OUT NODE [--with-panic-messages]`, as `cargo xtask page` calls it.
//!
//! The JavaScript glue of the WebAssembly module is generated, and both are put into `page/index.html` together with the page's own style
//! and scripts. The module, the style, the scripts and the texts of all languages are packed with LZMA; one small script expands them in
//! the page. NODE runs what checks the scripts' types and joins them.

mod assemble;
mod budget;
mod languages;
mod scripts;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use wasm_bindgen_cli_support::Bindgen;

/// The folder `page`.
const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

fn main() -> Result<()> {
    let arguments: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let (paths, with_messages) = match arguments.as_slice() {
        [paths @ .., flag] if flag.as_os_str() == "--with-panic-messages" => (paths, true),
        paths => (paths, false),
    };
    let [module, out, node] = paths else { bail!("usage: goodbot-page MODULE OUT NODE [--with-panic-messages]") };
    // Beside the module: nothing of it is kept.
    let folder = module.with_extension("page");
    let wasm = generate(module, &folder)?;
    let source = Path::new(PAGE).canonicalize().with_context(|| format!("{PAGE} is not there"))?;
    let scripts = scripts::bundle(&source, &folder, node)?;
    let texts = languages::read(&source.join("languages"))?;
    let style = assemble::style(&source)?;
    // In the order in which page/src/begin.js takes them.
    let parts = [
        ("the module", wasm.as_slice()),
        ("the style", style.as_bytes()),
        ("the scripts with the glue", scripts.others.as_bytes()),
        ("the texts", &texts),
    ];
    let page = assemble::assemble(&source, &parts.map(|(_, part)| part), &scripts.begin)?;
    if let Some(dist) = out.parent() {
        std::fs::create_dir_all(dist).with_context(|| format!("{} cannot be made", dist.display()))?;
    }
    std::fs::write(out, &page.html).with_context(|| format!("{} cannot be written", out.display()))?;
    budget::check(&page, &parts, with_messages)
}

/// Generates the module as the page has it, and beside it in `folder` its glue and the glue's types.
fn generate(module: &Path, folder: &Path) -> Result<Vec<u8>> {
    let mut bindgen = Bindgen::new();
    bindgen
        .input_path(module)
        .web(true)
        .and_then(|bindgen| bindgen.typescript(true).remove_name_section(true).remove_producers_section(true).generate(folder))
        .with_context(|| format!("the glue for {} could not be generated", module.display()))?;
    std::fs::read(folder.join("goodbot_wasm_bg.wasm")).context("goodbot_wasm_bg.wasm was not generated")
}
