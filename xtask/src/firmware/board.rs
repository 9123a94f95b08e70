//! The boards and how the emulator is told of them.

use std::path::Path;
use std::time::Duration;

use anyhow::Result;

use crate::process;
use crate::programs::QEMU;
use crate::toolchain::Target;

/// What no run should come near; a binary for another processor would hang.
const LIMIT: Duration = Duration::from_secs(180);

/// A board that the emulator knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Board {
    /// A Cortex-M4 with a floating-point unit.
    An386,
    /// A Cortex-M3.
    An385,
    /// The BBC micro:bit: a Cortex-M0 with 16 KiB of RAM.
    Microbit,
}

/// Which capacities the firmware has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preset {
    /// `Capacities::SMALL`.
    Small,
    /// `Capacities::TINY`.
    Tiny,
}

impl Board {
    /// The emulator's name for it, and the firmware's feature.
    pub const fn name(self) -> &'static str {
        match self {
            Self::An386 => "mps2-an386",
            Self::An385 => "mps2-an385",
            Self::Microbit => "microbit",
        }
    }

    /// Its processor.
    pub const fn processor(self) -> &'static str {
        match self {
            Self::An386 => "Cortex-M4F",
            Self::An385 => "Cortex-M3",
            Self::Microbit => "Cortex-M0",
        }
    }

    /// What to build for.
    pub const fn target(self) -> Target {
        match self {
            Self::An386 => Target::Thumbv7emHf,
            Self::An385 => Target::Thumbv7m,
            Self::Microbit => Target::Thumbv6m,
        }
    }
}

impl Preset {
    /// Its name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Small => "small",
            Self::Tiny => "tiny",
        }
    }
}

/// Runs a binary in the emulator, each instruction 64 ns of the board's time; gives its exit code and what it prints.
pub fn emulate(board: Board, binary: &Path) -> Result<(i32, String)> {
    let mut qemu = QEMU.command()?;
    qemu.args(["-M", board.name(), "-display", "none", "-monitor", "none", "-serial", "none"]);
    qemu.args(["-icount", "shift=6,sleep=off", "-chardev", "stdio,id=out"]);
    qemu.args(["-semihosting-config", "enable=on,target=native,chardev=out", "-kernel"]).arg(binary);
    process::capture_within(&mut qemu, LIMIT)
}
