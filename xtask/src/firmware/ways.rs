//! The first plan for tasks with ways, on the emulated Cortex-M4F.

use anyhow::{Result, bail};

use super::board::{Board, emulate};
use super::trial::Report;
use crate::{process, project, toolchain};

/// Builds the firmware of three storeys, runs it, and gives what it reported.
pub fn first_plan() -> Result<Report> {
    let (board, manifest) = (Board::An386, project::root().join("firmware/Cargo.toml"));
    let mut cargo = toolchain::cross_cargo(board.target())?;
    cargo.args(["--quiet", "--release", "--locked", "--bin", "ways", "--manifest-path"]).arg(manifest);
    cargo.args(["--features", &format!("{} ways", board.name())]);
    process::run(&mut cargo)?;
    let (code, said) = emulate(board, &toolchain::artifacts(board.target(), "release").join("ways"))?;
    if code != 0 {
        bail!("`ways` ended with {code} on {}; it said:\n{said}", board.name());
    }
    Ok(Report::read(&said))
}
