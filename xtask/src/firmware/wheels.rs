//! The lessons on wheels that slip, built and run on the Cortex-M4F.

use anyhow::{Result, bail};

use super::board::{Board, emulate};
use crate::{process, project, toolchain};

const BOARD: Board = Board::An386;
const BINARY: &str = "wheels";

/// Builds and runs them; says what came of them.
pub fn drive() -> Result<String> {
    let target = BOARD.target();
    let mut cargo = toolchain::cross_cargo(target)?;
    cargo.args(["--quiet", "--release", "--locked", "--bin", BINARY, "--manifest-path"]).arg(project::root().join("firmware/Cargo.toml"));
    process::run(cargo.args(["--features", &format!("{} {BINARY}", BOARD.name())]))?;
    let binary = toolchain::artifacts(target, "release").join(BINARY);
    // The simulated world may panic; the other firmware shows that the robot cannot.
    let (code, said) = emulate(BOARD, &binary)?;
    let said = said.lines().collect::<Vec<_>>().join(", ");
    if code != 0 {
        bail!("the lessons on wheels ended with {code} on {}: {said}", BOARD.name());
    }
    Ok(said)
}
