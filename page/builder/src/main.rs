//! The trainer page as one HTML file: `goodbot-page MODULE OUT NODE [--with-panic-messages]`, as `cargo xtask page` calls it.
//!
//! The JavaScript glue of the WebAssembly module is generated, and both are put into `page/index.html` together with the page's own style
//! and scripts. The style, the body, the scripts, the texts of all languages and the module are packed; one small script has the browser
//! expand them. NODE runs what checks the scripts' types and joins them.

mod assemble;
mod budget;
mod languages;
mod pack;
mod scripts;
mod split;

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
    // A folder beside the module, for intermediate files.
    let folder = module.with_extension("page");
    let wasm = generate(module, &folder)?;
    let source = Path::new(PAGE).canonicalize().with_context(|| format!("{PAGE} is not there"))?;
    let mut scripts = scripts::bundle(&source, &folder, node)?;
    let mut body = assemble::body(&source)?;
    let texts = languages::read(&source.join("languages"))?.number(&mut scripts.others, &mut body)?;
    let wasm = scripts::packable(&source, &wasm, node)?;
    let module = std::fs::read(&wasm).with_context(|| format!("{} cannot be read", wasm.display()))?;
    let split::Split { before, parts: code, behind } = split::split(&module)?;
    let texts = [&scripts.others, &body, &scripts.style, &texts].map(String::as_bytes);
    // In the order in which page/src/begin.js takes them. They pack best so.
    let parts: Vec<&[u8]> =
        [before.as_slice()].into_iter().chain(code.iter().map(Vec::as_slice)).chain([behind.as_slice()]).chain(texts).collect();
    let page = assemble::assemble(&source, &parts, &scripts.begin)?;
    if let Some(dist) = out.parent() {
        std::fs::create_dir_all(dist).with_context(|| format!("{} cannot be made", dist.display()))?;
    }
    std::fs::write(out, &page.html).with_context(|| format!("{} cannot be written", out.display()))?;
    let names = ["the scripts with the glue", "the body", "the style", "the texts"];
    let sizes: Vec<_> = [("the module", module.len())].into_iter().chain(names.into_iter().zip(texts.map(<[u8]>::len))).collect();
    budget::check(&page, &sizes, with_messages)
}

/// Generates the page's module, its glue and the glue's types in `folder`. Returns the module's path.
fn generate(module: &Path, folder: &Path) -> Result<PathBuf> {
    let mut bindgen = Bindgen::new();
    bindgen
        .input_path(module)
        .web(true)
        .and_then(|bindgen| bindgen.typescript(true).remove_name_section(true).remove_producers_section(true).generate(folder))
        .with_context(|| format!("the glue for {} could not be generated", module.display()))?;
    Ok(folder.join("goodbot_wasm_bg.wasm"))
}
