//! The project's folders, and programs that run in them.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use std::time::Duration;

use anyhow::{Context, Result, bail};
use clap::ValueEnum;
use serde_json::Value;
use wait_timeout::ChildExt;
use xshell::{Cmd, Shell, cmd};

/// The project's top folder.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

/// The folder that cargo builds in.
pub fn target_dir() -> PathBuf {
    folder_named_by("CARGO_TARGET_DIR").unwrap_or_else(|| root().join("target"))
}

/// The folder that an environment variable names, if it is set.
pub fn folder_named_by(variable: &str) -> Option<PathBuf> {
    std::path::absolute(std::env::var_os(variable)?).ok()
}

/// A shell in the project's top folder, or, if the user may not enter that, in the current folder, where programs can still be fetched.
pub fn shell() -> Result<Shell> {
    let sh = Shell::new()?;
    if root().join("Cargo.toml").is_file() {
        sh.change_dir(root());
    }
    Ok(sh)
}

/// The crates of a workspace, as cargo tells them.
pub fn packages(sh: &Shell, manifest: &str) -> Result<Vec<Value>> {
    let metadata = cmd!(sh, "cargo metadata --offline --no-deps --format-version 1 --manifest-path {manifest}").quiet().read()?;
    let metadata: Value = serde_json::from_str(&metadata)?;
    Ok(metadata["packages"].as_array().context("cargo tells packages")?.clone())
}

/// Runs a program, stops it after `limit`, and returns its exit code and standard output. The output must fit into a pipe, so it may have
/// only some lines.
pub fn within(limit: Duration, command: Cmd) -> Result<(i32, String)> {
    let shown = command.to_string();
    let child = Command::from(command).stdin(Stdio::null()).stdout(Stdio::piped()).spawn();
    let mut child = child.with_context(|| format!("`{shown}` could not be started"))?;
    let status = child.wait_timeout(limit)?;
    child.kill()?;
    let said = String::from_utf8_lossy(&child.wait_with_output()?.stdout).into_owned();
    let Some(status) = status else { bail!("`{shown}` did not end within {} s; so far it said: {said}", limit.as_secs()) };
    Ok((status.code().with_context(|| format!("`{shown}` was stopped ({status})"))?, said))
}

/// The value in `cell`, made at its first use in this run.
pub fn once<T>(cell: &'static OnceLock<T>, make: impl FnOnce() -> Result<T>) -> Result<&'static T> {
    match cell.get() {
        Some(made) => Ok(made),
        None => make().map(|made| cell.get_or_init(|| made)),
    }
}

/// What a step or a package is called, and what it is.
pub fn described(value: impl ValueEnum) -> (String, String) {
    let value = value.to_possible_value();
    let (name, about) = value.map(|value| (value.get_name().to_owned(), value.get_help().map(ToString::to_string))).unzip();
    (name.unwrap_or_default(), about.flatten().unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_that_takes_too_long_is_stopped_and_one_that_ends_tells_its_code() {
        let sh = shell().unwrap();
        let error = within(Duration::from_millis(100), cmd!(sh, "sleep 60")).unwrap_err();
        assert!(error.to_string().contains("did not end"), "{error}");
        assert_eq!(within(Duration::from_secs(30), cmd!(sh, "sh -c 'echo y; exit 3'")).unwrap(), (3, "y\n".to_owned()));
    }
}
