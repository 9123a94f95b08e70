//! Programs that run on the Cortex-M4F alone: the first plan for tasks with ways, and the lessons on wheels that slip.

use std::path::PathBuf;

use anyhow::{Result, bail};

use super::board::{Board, emulate};
use super::trial::Report;
use crate::{process, project, toolchain};

const BOARD: Board = Board::An386;

/// The programs, and the firmware's features that they need.
pub const BINARIES: [&str; 2] = ["ways", "wheels"];

/// Builds all of them. Gives where one of them is.
pub fn build(name: &str) -> Result<PathBuf> {
    let mut cargo = toolchain::cross_cargo(BOARD.target())?;
    cargo.args(["--quiet", "--release", "--locked", "--manifest-path"]).arg(project::root().join("firmware/Cargo.toml"));
    cargo.args(BINARIES.iter().flat_map(|binary| ["--bin", binary]));
    process::run(cargo.args(["--features", &format!("{} {}", BOARD.name(), BINARIES.join(" "))]))?;
    Ok(toolchain::artifacts(BOARD.target(), "release").join(name))
}

/// Builds all of them and runs one. Gives what it reports.
pub fn run(name: &str) -> Result<Report> {
    let (code, said) = emulate(BOARD, &build(name)?)?;
    if code != 0 {
        bail!("`{name}` ended with {code} on {}; it said:\n{said}", BOARD.name());
    }
    Ok(Report::read(&said))
}
