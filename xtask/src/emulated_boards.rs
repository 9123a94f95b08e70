//! The boards that the emulator knows, and how a binary runs on one.

use std::path::Path;
use std::time::Duration;

use anyhow::{Context, Result, ensure};
use xshell::cmd;

use crate::process::{shell, within};
use crate::programs::{QEMU, QEMU_RISCV};
use crate::toolchain::{CORTEX_M0, CORTEX_M3, CORTEX_M4F, CORTEX_M33F, RISCV};

/// A binary for another processor would hang. The longest run, with full tables, took a minute and a half beside one compiler, and it takes
/// longer beside the page's browsers.
pub const LIMIT: Duration = Duration::from_secs(900);

/// A board that the emulator knows, and a preset of the library's capacities.
#[derive(Debug)]
pub struct Board {
    pub name: &'static str,
    /// The firmware's feature: this board, or one with the same processor family and memory, whose firmware it runs.
    pub feature: &'static str,
    pub processor: &'static str,
    pub target: &'static str,
    pub preset: &'static str,
    /// Whether another board is so like it that only `--all-boards` runs this one too: the same instructions, or those of two others.
    pub is_alike: bool,
    /// The course's bounds: bytes of RAM with the stack, bytes of flash, and instructions to hear a command and to choose an action once
    /// it is planned.
    pub most: [u64; 3],
}

pub const AN386: Board = Board {
    name: "mps2-an386",
    feature: "mps2-an386",
    processor: "Cortex-M4F",
    target: CORTEX_M4F,
    preset: "small",
    is_alike: false,
    most: [32 * 1024, 96 * 1024, 1_000_000],
};
const UNBOUND: [u64; 3] = [u64::MAX; 3];

/// The emulator's board for RISC-V, which needs an emulator of its own.
const RISCV_BOARD: &str = "virt";

/// The boards whose firmware is built, run and measured: one of each set of instructions, and those that are like one of them. The micro:bit computes floats
/// in software, which takes flash and instructions.
pub const BOARDS: [Board; 6] = [
    AN386,
    Board { name: "mps2-an385", feature: "mps2-an385", processor: "Cortex-M3", target: CORTEX_M3, is_alike: true, most: UNBOUND, ..AN386 },
    Board {
        name: "microbit",
        feature: "microbit",
        processor: "Cortex-M0",
        target: CORTEX_M0,
        preset: "tiny",
        is_alike: false,
        most: [16 * 1024, 100 * 1024, 2_000_000],
    },
    Board {
        name: "mps2-an505",
        feature: "mps2-an505",
        processor: "Cortex-M33F",
        target: CORTEX_M33F,
        is_alike: true,
        most: UNBOUND,
        ..AN386
    },
    Board { name: "mps2-an500", processor: "Cortex-M7F", is_alike: true, most: UNBOUND, ..AN386 },
    Board { name: RISCV_BOARD, feature: RISCV_BOARD, processor: "RISC-V, rv32imac", target: RISCV, most: UNBOUND, ..AN386 },
];

/// A binary's output: among other lines, lines of a name and a number.
#[derive(Clone, Debug)]
pub struct Report(pub String);

impl Report {
    /// All numbers with a name, in order.
    pub fn all(&self, name: &str) -> Vec<u64> {
        self.0.lines().filter_map(|line| line.strip_prefix(name)?.strip_prefix(' ')?.trim().parse().ok()).collect()
    }

    /// The first number with a name.
    pub fn number(&self, name: &str) -> Result<u64> {
        self.all(name).first().copied().with_context(|| format!("the firmware did not report `{name}`"))
    }

    /// Bytes of RAM: statics and the deepest stack.
    pub fn ram(&self) -> Result<u64> {
        Ok(self.number("statics")? + self.number("stack")?)
    }
}

/// Runs a binary in the emulator. Each instruction takes 64 ns of the board's time. It is an error if it ends with another exit code.
pub fn emulate(board: &str, binary: &Path, code: i32) -> Result<Report> {
    let (sh, is_riscv) = (shell()?, board == RISCV_BOARD);
    let qemu = if is_riscv { &QEMU_RISCV } else { &QEMU }.path()?;
    let machine = cmd!(sh, "{qemu} -M {board} -display none -monitor none -serial none -icount shift=6,sleep=off -chardev stdio,id=out");
    let machine = machine.args(["-semihosting-config", "enable=on,target=native,chardev=out"]);
    // As a kernel it would be started at the beginning of the RAM, where the stack is.
    let loaded = if is_riscv {
        machine.args(["-bios", "none", "-device"]).arg(format!("loader,cpu-num=0,file={}", binary.display()))
    } else {
        machine.arg("-kernel").arg(binary)
    };
    let (ended, said) = within(LIMIT, loaded)?;
    ensure!(ended == code, "{} ended with {ended} on {board}, not with {code}; it said:\n{said}", binary.display());
    Ok(Report(said))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_is_names_and_numbers() {
        let report = Report("stack 4268\nplan 1\nplan 2\nerror: no room\n".to_owned());
        assert_eq!(report.number("stack").unwrap(), 4268);
        assert_eq!(report.all("plan"), [1, 2]);
        assert!(report.number("statics").unwrap_err().to_string().contains("statics"));
    }
}
