//! goodbot beside others on the same work, in one run.

use std::path::PathBuf;

use anyhow::Result;

use crate::{process, project};

/// The version of NLTK that is compared with.
const NLTK: &str = "nltk==3.10.4";

/// Runs the comparisons; those whose peer cannot be installed are left out with a line.
pub fn run() -> Result<()> {
    let mut command = project::cargo();
    command.args(["run", "--release", "--quiet", "--package", "goodbot-benches", "--bin", "compare"]);
    match python_with_nltk() {
        Ok(python) => {
            command.env("GOODBOT_PEERS_PYTHON", python);
        }
        Err(error) => eprintln!("skipped: NLTK cannot be installed: {error:#}"),
    }
    process::run(&mut command)
}

/// A Python of our own, below the build folder, that has NLTK.
fn python_with_nltk() -> Result<PathBuf> {
    let folder = project::target_dir().join("peers");
    let python = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    if !python.exists() {
        process::capture(std::process::Command::new("python3").arg("-m").arg("venv").arg(&folder))?;
    }
    process::capture(std::process::Command::new(&python).args(["-m", "pip", "install", "--quiet", NLTK]))?;
    Ok(python)
}
