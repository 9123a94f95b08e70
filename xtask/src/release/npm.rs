//! The module and the page for npm.

use super::archive::Texts;
use crate::checks::step::Run;
use crate::process::{root, shell};
use crate::programs::{NODE, NPM};
use crate::toolchain::{WASM, artifacts};
use anyhow::{Context, Result};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::path::{Path, PathBuf};
use xshell::{Shell, cmd};

const SOURCES: &str = "wasm/npm";
const TESTS: &str = "wasm/npm-tests";

/// Packs the module and the page, which have been built. Returns the file.
pub fn make(sh: &Shell, texts: &Texts, to: &Path) -> Result<PathBuf> {
    let (above, npm) = (sh.create_temp_dir()?, NPM.path()?);
    let folder = above.path().join("goodbot");
    describe(sh, texts, &folder)?;
    let name = cmd!(sh, "{npm} pack {folder} --pack-destination {to} --silent").read()?;
    Ok(to.join(name.lines().last().context("npm names no file")?))
}

/// Writes the module and the page into a folder.
pub fn describe(sh: &Shell, texts: &Texts, folder: &Path) -> Result<()> {
    texts.copy_all(sh, Path::new(SOURCES), folder)?;
    // As the page's builder has generated them.
    let generated = artifacts(WASM, "page").join("goodbot_wasm.page");
    for file in ["goodbot_wasm.js", "goodbot_wasm.d.ts"] {
        sh.copy_file(generated.join(file), folder)?;
    }
    let module = STANDARD.encode(sh.read_binary_file(generated.join("goodbot_wasm_bg.wasm"))?);
    sh.write_file(folder.join("module.js"), format!("export default '{module}';\n"))?;
    sh.copy_file("dist/goodbot.html", folder)?;
    super::licences(sh, folder)
}

/// Makes the package, and tries it.
pub fn make_and_try(run: &mut Run) -> Result<()> {
    let sh = shell()?;
    let above = sh.create_temp_dir()?;
    let package = make(&sh, &Texts::new(&sh)?, above.path())?;
    try_out(&sh, &package, run)
}

/// Installs a package into an empty folder, and uses it there.
pub fn try_out(sh: &Shell, package: &Path, run: &mut Run) -> Result<()> {
    let (node, npm, above) = (NODE.path()?, NPM.path()?, sh.create_temp_dir()?);
    let folder = above.path();
    sh.write_file(folder.join("package.json"), "{}\n")?;
    cmd!(sh, "{npm} install --silent --offline --no-audit --no-fund --prefix {folder} {package}").run()?;
    sh.set_var("GOODBOT_INSTALLED", folder);
    // The types, by the compiler that the page has.
    sh.write_file(
        folder.join("typed.mts"),
        "import { Goodbot } from 'goodbot';\nimport type { GoodbotTrainer } from 'goodbot/trainer';\n\
         export const learned: boolean = new Goodbot(1).learn(1);\n\
         export const sessions = (trainer: GoodbotTrainer) => trainer.robot?.sessions();\n",
    )?;
    let tsc = root().join("page/node_modules/.bin/tsc");
    cmd!(sh, "{tsc} --noEmit --strict --module nodenext --target es2022 --lib esnext,dom {folder}/typed.mts").run()?;
    let tests = root().join(TESTS).join("package.test.mjs");
    run.count(cmd!(sh, "{node} --test --test-reporter=spec {tests}"))
}
