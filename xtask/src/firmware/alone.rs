//! Programs that run on the Cortex-M4F alone: a robot of one's own, the first plan for tasks with ways, and the lessons on wheels that slip.

use std::path::PathBuf;

use anyhow::{Result, bail};

use super::board::{Board, emulate};
use super::trial::Report;
use crate::{process, project, toolchain};

const BOARD: Board = Board::An386;

/// One of the programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Alone {
    /// The arm of the library's examples.
    Arm,
    /// A home of three storeys.
    Ways,
    /// Lessons on wheels.
    Wheels,
}

impl Alone {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Arm, Self::Ways, Self::Wheels];

    /// Its name in `firmware/Cargo.toml`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Arm => "arm",
            Self::Ways => "ways",
            Self::Wheels => "wheels",
        }
    }

    /// Builds it. Gives where it is.
    pub fn build(self) -> Result<PathBuf> {
        // What has the same features is built once.
        let (binaries, features): (&[Self], _) = match self {
            Self::Arm => (&[Self::Arm], "arm"),
            Self::Ways | Self::Wheels => (&[Self::Ways, Self::Wheels], "ways wheels"),
        };
        let mut cargo = toolchain::cross_cargo(BOARD.target())?;
        cargo.args(["--quiet", "--release", "--locked", "--manifest-path"]).arg(project::root().join("firmware/Cargo.toml"));
        cargo.args(binaries.iter().flat_map(|binary| ["--bin", binary.name()]));
        process::run(cargo.args(["--features", &format!("{} {features}", BOARD.name())]))?;
        Ok(toolchain::artifacts(BOARD.target(), "release").join(self.name()))
    }

    /// Builds it and runs it. Gives what it reports.
    pub fn run(self) -> Result<Report> {
        let (code, said) = emulate(BOARD, &self.build()?)?;
        if code != 0 {
            bail!("`{}` ended with {code} on {}; it said:\n{said}", self.name(), BOARD.name());
        }
        Ok(Report::read(&said))
    }
}
