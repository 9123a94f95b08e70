//! Targets by rustup: it adds their standard libraries to the host's toolchain.

use std::process::Command;
use std::time::Duration;

use anyhow::{Context, Result, bail};

use super::Target;
use crate::{process, project};

/// How many seconds rustup is given, if not [`DEFAULT_SECONDS`].
const WAIT: &str = "CROSS_TOOLCHAIN_WAIT";
const DEFAULT_SECONDS: u64 = 90;

/// Adds the targets that are missing.
pub fn setup() -> Result<()> {
    if process::find_program("rustup").is_none() {
        bail!("rustup is not here");
    }
    let missing = missing()?;
    if missing.is_empty() {
        return Ok(());
    }
    let limit = Duration::from_secs(seconds()?);
    eprintln!("rustup adds {} (it is given {} s)", missing.join(", "), limit.as_secs());
    let mut add = rustup();
    add.args(["target", "add"]).args(&missing);
    let (code, _) = process::capture_within(&mut add, limit).context("rustup could not add the targets")?;
    if code != 0 {
        bail!("rustup could not add the targets");
    }
    Ok(())
}

/// Whether no target is missing.
pub fn has_all() -> bool {
    missing().is_ok_and(|missing| missing.is_empty())
}

fn missing() -> Result<Vec<&'static str>> {
    let installed = process::capture(rustup().args(["target", "list", "--installed"]))?;
    Ok(Target::ALL.map(Target::triple).into_iter().filter(|triple| !installed.lines().any(|line| line.trim() == *triple)).collect())
}

fn rustup() -> Command {
    let mut command = Command::new("rustup");
    // rustup looks at the folder it runs in to know which toolchain is meant.
    command.current_dir(project::root());
    command
}

fn seconds() -> Result<u64> {
    match std::env::var(WAIT) {
        Ok(text) => text.parse().with_context(|| format!("{WAIT} is a number of seconds, not `{text}`")),
        Err(_) => Ok(DEFAULT_SECONDS),
    }
}
