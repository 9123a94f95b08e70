//! Packages of npm.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use anyhow::{Context, Result};

use super::{NODE, NPM, missing};
use crate::{process, project};

/// The page's folder, where `package-lock.json` is; what it names is installed, if that has not been done since it last changed.
pub fn packages() -> Result<PathBuf> {
    let folder = project::root().join("page");
    if is_current(&folder) {
        return Ok(folder);
    }
    NODE.path()?;
    eprintln!("fetching the npm packages of page");
    let mut command = NPM.command()?;
    command.args(["ci", "--no-audit", "--no-fund"]).current_dir(&folder);
    process::run(&mut command).map_err(|error| missing("npm's packages", "to make the page and to try it", &error))?;
    Ok(folder)
}

/// Whether npm's own note of what it installed is newer than both files that say what to install.
fn is_current(folder: &Path) -> bool {
    let changed = |name: &str| -> Result<SystemTime> {
        let about = folder.join(name).metadata().with_context(|| format!("{name} is not there"))?;
        Ok(about.modified()?)
    };
    let Ok(installed) = changed("node_modules/.package-lock.json") else { return false };
    ["package.json", "package-lock.json"].iter().all(|name| changed(name).is_ok_and(|wanted| wanted <= installed))
}
