//! `capi/include/goodbot.h`, as `capi/header` writes it.

use std::path::PathBuf;

use anyhow::{Context, Result, bail};

use crate::{process, project};

fn path() -> PathBuf {
    project::root().join("capi/include/goodbot.h")
}

fn kept() -> Result<String> {
    std::fs::read_to_string(path()).with_context(|| format!("{} cannot be read", path().display()))
}

/// The header as it should be.
fn generate() -> Result<String> {
    process::capture_output(project::cargo().args(["run", "--package", "goodbot-header"]))
}

/// Writes the header.
pub fn write() -> Result<()> {
    std::fs::write(path(), generate()?).with_context(|| format!("{} cannot be written", path().display()))
}

/// The names of all functions that the header declares.
pub fn functions() -> Result<Vec<String>> {
    Ok(kept()?.lines().filter_map(declared).map(str::to_owned).collect())
}

/// The function that a line begins to declare.
fn declared(line: &str) -> Option<&str> {
    let (before, _) = line.split_once('(')?;
    let name = before.rsplit([' ', '*']).next()?;
    let is_type = line.starts_with("typedef") || line.starts_with([' ', '/', '#']);
    (name.starts_with("goodbot_") && !is_type).then_some(name)
}

/// Compares the header that is checked in.
pub fn check() -> Result<()> {
    if kept()? != generate()? {
        bail!("capi/include/goodbot.h is stale: write it again with `cargo xtask capi`");
    }
    println!("capi/include/goodbot.h is what capi/src says");
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::declared;

    #[test]
    fn functions_are_found_in_the_header() {
        assert_eq!(declared("enum goodbot_status goodbot_save(struct goodbot *robot,"), Some("goodbot_save"));
        assert_eq!(declared("const char *goodbot_status_text(int32_t status);"), Some("goodbot_status_text"));
        assert_eq!(declared("typedef bool (*goodbot_holds)(void *context,"), None);
        assert_eq!(declared(" * `goodbot_full` names it (see there)."), None);
    }
}
