//! Where the project's files are, and cargo as run on them.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};

use crate::process;

/// Folders of a working copy that hold nothing of the project's own.
const NOT_OURS: [&str; 4] = [".git", "target", "dist", "node_modules"];

/// The project's top folder.
pub fn root() -> PathBuf {
    let own = std::env::var_os("CARGO_MANIFEST_DIR").map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")), PathBuf::from);
    own.parent().map(Path::to_path_buf).unwrap_or(own)
}

/// The folder that cargo builds in.
pub fn target_dir() -> PathBuf {
    match std::env::var_os("CARGO_TARGET_DIR") {
        Some(dir) if !dir.is_empty() => {
            let dir = PathBuf::from(dir);
            std::path::absolute(&dir).unwrap_or(dir)
        }
        _ => root().join("target"),
    }
}

/// The folder with data that some tests read and that is no part of the project.
pub fn external_data() -> Option<PathBuf> {
    let dir = root().parent()?.join("shared");
    dir.is_dir().then_some(dir)
}

/// The host's cargo, to be run in the project's top folder.
pub fn cargo() -> Command {
    let program = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(program);
    command.current_dir(root());
    forget_own_package(&mut command);
    command
}

/// Takes away the variables by which cargo told this program of its own package.
pub fn forget_own_package(command: &mut Command) {
    for (name, _) in std::env::vars_os() {
        let text = name.to_string_lossy();
        if text.starts_with("CARGO_PKG_") || text.starts_with("CARGO_MANIFEST_") {
            command.env_remove(&name);
        }
    }
}

/// The project's files, relative to its top folder: those that git knows or
/// would take, or without git all but what was built.
pub fn files() -> Result<Vec<PathBuf>> {
    let root = root();
    let mut git = Command::new("git");
    git.current_dir(&root).args(["-c", "core.quotePath=false", "ls-files", "--cached", "--others", "--exclude-standard"]);
    let mut files = Vec::new();
    match process::capture(&mut git) {
        Ok(list) if !list.is_empty() => files.extend(list.lines().map(PathBuf::from)),
        _ => walk(&root, Path::new(""), &mut files)?,
    }
    // git still lists a file that was removed but not yet committed so.
    files.retain(|file| root.join(file).is_file());
    files.sort();
    files.dedup();
    Ok(files)
}

fn walk(root: &Path, below: &Path, files: &mut Vec<PathBuf>) -> Result<()> {
    let folder = root.join(below);
    let entries = std::fs::read_dir(&folder).with_context(|| format!("{} cannot be listed", folder.display()))?;
    for entry in entries {
        let entry = entry?;
        let path = below.join(entry.file_name());
        let kind = entry.file_type()?;
        if kind.is_file() {
            files.push(path);
        } else if kind.is_dir() && !NOT_OURS.iter().any(|name| entry.file_name() == *name) {
            walk(root, &path, files)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_root_has_the_workspace() {
        let manifest = std::fs::read_to_string(root().join("Cargo.toml")).unwrap();
        assert!(manifest.contains("[workspace]"));
    }

    #[test]
    fn files_are_found_with_and_without_git() {
        let own = Path::new("xtask").join("src").join("project.rs");
        assert!(files().unwrap().contains(&own));
        let mut walked = Vec::new();
        walk(&root(), Path::new(""), &mut walked).unwrap();
        assert!(walked.contains(&own));
        assert!(!walked.iter().any(|file| file.starts_with("target")));
    }
}
