//! `cargo xtask api`: the core's public interface as a text file, so that a diff shows each change of it.

use anyhow::{Result, ensure};
use clap::Args;
use xshell::cmd;

use crate::process::{shell, target_dir};
use crate::programs::installed_by_cargo;

const LIST: &str = "core/public-api.txt";

/// What to do with the list.
#[derive(Args)]
pub struct Options {
    /// Compares with the committed list and writes nothing
    #[arg(long)]
    pub check: bool,
}

/// Lists the items with all features, by cargo-public-api.
pub fn run(options: &Options) -> Result<()> {
    let sh = shell()?;
    let program = installed_by_cargo(&sh, "cargo-public-api")?;
    let list = cmd!(sh, "{program} public-api --package goodbot --all-features -sss --target-dir").arg(target_dir().join("api"));
    // Only a nightly rustdoc describes items as data; the variable makes a stable one accept the option.
    let list = list.env("RUSTC_BOOTSTRAP", "1").read()? + "\n";
    if options.check {
        ensure!(
            sh.read_file(LIST)? == list,
            "{LIST} is stale: write it again with `cargo xtask api`, and see whether users' code still compiles"
        );
        return Ok(());
    }
    sh.write_file(LIST, &list)?;
    println!("written: {LIST}, {} items", list.lines().count());
    Ok(())
}
