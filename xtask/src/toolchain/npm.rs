//! Packages of npm.

use std::path::Path;
use std::process::Command;
use std::time::SystemTime;

use anyhow::{Context, Result, bail};

use super::{need_program, say};
use crate::process;

/// Installs what a folder's `package-lock.json` names, if that has not been
/// done since the lock file last changed.
#[allow(dead_code)]
pub fn npm_ci(dir: &Path) -> Result<()> {
    if !dir.join("package-lock.json").is_file() {
        bail!("{} has no package-lock.json", dir.display());
    }
    if is_current(dir) {
        return Ok(());
    }
    need_program("npm", &["nodejs", "npm"], "to install npm packages")?;
    say(&format!("npm ci in {}", dir.display()));
    let mut command = Command::new("npm");
    command.args(["ci", "--no-audit", "--no-fund"]).current_dir(dir);
    process::run(&mut command).with_context(|| format!("npm packages could not be installed in {}", dir.display()))
}

/// Whether npm's own note of what it installed is newer than both files that
/// say what to install.
fn is_current(dir: &Path) -> bool {
    let Some(installed) = changed(&dir.join("node_modules/.package-lock.json")) else {
        return false;
    };
    ["package.json", "package-lock.json"].iter().filter_map(|name| changed(&dir.join(name))).all(|wanted| wanted <= installed)
}

fn changed(file: &Path) -> Option<SystemTime> {
    file.metadata().and_then(|about| about.modified()).ok()
}
