//! The file for a BBC micro:bit, to be dragged onto it.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use goodbot_formats::microbit::MicrobitFile;
use object::Endianness;
use object::elf::PT_LOAD;
use object::read::elf::{ElfFile32, ProgramHeader};

use crate::toolchain::{self, Target};
use crate::{process, project};

/// Where the linked program is.
pub fn program() -> PathBuf {
    toolchain::artifacts(Target::Thumbv6m, "release").join("microbit")
}

fn build(package: &str) -> Result<()> {
    let mut cargo = toolchain::cross_cargo(Target::Thumbv6m)?;
    cargo.args(["--quiet", "--release", "--locked", "--package", package, "--manifest-path"]);
    process::run(cargo.arg(project::root().join("firmware/Cargo.toml")))
}

/// Builds the robot among embassy's tasks. Returns where it is.
pub fn among_tasks() -> Result<PathBuf> {
    build("goodbot-embassy")?;
    Ok(toolchain::artifacts(Target::Thumbv6m, "release").join("embassy"))
}

/// Builds it and writes `dist/goodbot.hex`. Returns where that is.
pub fn deliver() -> Result<PathBuf> {
    build("goodbot-microbit")?;
    let file = MicrobitFile::of_program(in_flash(&std::fs::read(program())?)?)?;
    let path = project::root().join("dist/goodbot.hex");
    write(&path, &file.to_text())?;
    println!("{}: {} bytes of flash; drag it onto a micro:bit (first version)", path.display(), file.len());
    Ok(path)
}

fn write(path: &Path, text: &str) -> Result<()> {
    std::fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))?;
    std::fs::write(path, text).with_context(|| format!("{} cannot be written", path.display()))
}

/// The addresses in the flash, and the bytes there. What begins in the RAM with a value stands in the flash too: its physical address.
fn in_flash(program: &[u8]) -> Result<Vec<(u32, &[u8])>> {
    let elf = ElfFile32::<Endianness>::parse(program).context("the linked program cannot be read")?;
    let endian = elf.endian();
    let mut parts = Vec::new();
    for header in elf.elf_program_headers().iter().filter(|header| header.p_type(endian) == PT_LOAD) {
        let bytes = header.data(endian, program).ok().context("the linked program is cut off")?;
        parts.push((header.p_paddr(endian), bytes));
    }
    parts.sort_unstable();
    Ok(parts)
}
