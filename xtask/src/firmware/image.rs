//! One linked firmware: what it takes of the flash, and what it is made of.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use super::board::{Board, Preset};
use crate::programs::{ARM_NM, ARM_SIZE, Program};
use crate::toolchain;
use crate::{process, project};

/// What the linker puts into the flash, and into the RAM.
const IN_FLASH: [&str; 5] = [".vector_table", ".text", ".rodata", ".ARM.exidx", ".data"];
const IN_RAM: [&str; 2] = [".data", ".bss"];

/// What a firmware consists of.
pub const BINARIES: [&str; 3] = ["course", "tick", "overflow"];

/// What a symbol's name has in it if it is there to panic.
const PANIC: [&str; 8] = ["panic", "unwind", "unwrap_failed", "expect_failed", "slice_index", "_fail", "const_div", "begin_unwind"];

/// The binaries of one firmware, and where they are kept.
#[derive(Clone, Debug)]
pub struct Image {
    pub board: Board,
    pub preset: Preset,
    folder: PathBuf,
}

impl Image {
    /// Builds the firmware.
    pub fn build(board: Board, preset: Preset) -> Result<Self> {
        let target = board.target();
        let mut features = board.name().to_owned();
        if preset == Preset::Tiny {
            features.push_str(" tiny");
        }
        let manifest = project::root().join("firmware/Cargo.toml");
        let mut cargo = toolchain::cross_cargo(target)?;
        cargo.args(["--quiet", "--release", "--locked", "--manifest-path"]).arg(manifest).args(["--features", &features]);
        process::run(&mut cargo)?;
        let built = toolchain::artifacts(target, "release");
        // The next preset is built into the same place.
        let folder = built.join(format!("{}-{}", board.name(), preset.name()));
        std::fs::create_dir_all(&folder)?;
        for binary in BINARIES {
            std::fs::copy(built.join(binary), folder.join(binary)).with_context(|| format!("{binary} was not built"))?;
        }
        Ok(Self { board, preset, folder })
    }

    /// Its name in tables.
    pub fn name(&self) -> String {
        format!("{} {}", self.board.name(), self.preset.name())
    }

    /// One of its binaries.
    pub fn binary(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Bytes of flash that a binary takes.
    pub fn flash(&self, name: &str) -> Result<u64> {
        flash(&self.binary(name))
    }
}

/// Bytes of flash that a binary takes.
pub fn flash(binary: &Path) -> Result<u64> {
    bytes_in(binary, &IN_FLASH)
}

/// Bytes of static memory that a binary takes.
pub fn statics(binary: &Path) -> Result<u64> {
    bytes_in(binary, &IN_RAM)
}

fn bytes_in(binary: &Path, places: &[&str]) -> Result<u64> {
    let listed = binutils(&ARM_SIZE, &["-A"], binary)?;
    Ok(sections(&listed).filter(|(section, _)| places.contains(section)).map(|(_, bytes)| bytes).sum())
}

/// The symbols of a binary that are there to panic. The linker keeps only what is called.
pub fn panics(binary: &Path) -> Result<Vec<String>> {
    let listed = binutils(&ARM_NM, &["--demangle"], binary)?;
    Ok(listed.lines().filter(|line| is_panic(line)).map(str::to_owned).collect())
}

fn binutils(program: &Program, arguments: &[&str], binary: &Path) -> Result<String> {
    process::capture(program.command()?.args(arguments).arg(binary))
}

/// The sections that `size -A` lists, with their bytes.
fn sections(listed: &str) -> impl Iterator<Item = (&str, u64)> {
    listed.lines().filter_map(|line| {
        let mut words = line.split_whitespace();
        Some((words.next()?, words.next()?.parse().ok()?))
    })
}

fn is_panic(symbol: &str) -> bool {
    PANIC.iter().any(|word| symbol.contains(word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_are_read_from_the_list() {
        let listed = "course  :\nsection   size   addr\n.text    55224   1024\n.bss  22856  536870920\n";
        assert_eq!(sections(listed).collect::<Vec<_>>(), [(".text", 55_224), (".bss", 22_856)]);
    }

    #[test]
    fn a_symbol_that_panics_is_known_by_its_name() {
        assert!(is_panic("00007454 t core::panicking::panic_fmt"));
        assert!(is_panic("0000745c t core::slice::index::slice_index_fail"));
        assert!(is_panic("000077b0 t core::slice::copy_from_slice_impl::len_mismatch_fail"));
        assert!(!is_panic("00005b90 t goodbot::session::Agent::hear"));
    }
}
