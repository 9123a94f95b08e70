//! `cargo xtask page`: the trainer page as one HTML file.
//!
//! The browser part is built for WebAssembly, its JavaScript glue is generated, and both are put into `page/index.html` together with the
//! page's own style and scripts. The module is packed with LZMA, and the page unpacks it.

mod assemble;
mod budget;

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use wasm_bindgen_cli_support::Bindgen;

use crate::toolchain::{self, Target};
use crate::{process, project};

/// The file that is written.
pub fn path() -> PathBuf {
    project::root().join("dist").join("goodbot.html")
}

/// Writes the page, and says what it is made of. It is an error if it has become too large.
pub fn build() -> Result<()> {
    let folder = project::target_dir().join("page");
    let parts = parts(&folder)?;
    let page = assemble::assemble(&project::root().join("page"), &parts)?;
    let path = path();
    if let Some(dist) = path.parent() {
        std::fs::create_dir_all(dist).with_context(|| format!("{} cannot be made", dist.display()))?;
    }
    std::fs::write(&path, &page.html).with_context(|| format!("{} cannot be written", path.display()))?;
    budget::check(&page, parts.wasm.len())
}

/// What is generated: the module and its glue.
struct Parts {
    wasm: Vec<u8>,
    glue: String,
}

fn parts(folder: &Path) -> Result<Parts> {
    let mut command = toolchain::cross_cargo(Target::Wasm32)?;
    process::run(command.args(["--quiet", "--profile", "page", "--package", "goodbot-wasm"]))?;
    let module = toolchain::artifacts(Target::Wasm32, "page").join("goodbot_wasm.wasm");
    let mut bindgen = Bindgen::new();
    bindgen
        .input_path(&module)
        .no_modules(true)
        .and_then(|bindgen| bindgen.no_modules_global("core"))
        .and_then(|bindgen| bindgen.typescript(false).remove_name_section(true).remove_producers_section(true).generate(folder))
        .with_context(|| format!("the glue for {} could not be generated", module.display()))?;
    let read = |name: &str| std::fs::read(folder.join(name)).with_context(|| format!("{name} was not generated"));
    let glue = String::from_utf8(read("goodbot_wasm.js")?).context("the glue is no text")?;
    Ok(Parts { wasm: read("goodbot_wasm_bg.wasm")?, glue })
}
