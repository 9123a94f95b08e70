//! The C examples on this machine and on an emulated board.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Result, bail};

use super::{header, library};
use crate::firmware::board::{Board, emulate};
use crate::firmware::image::panics;
use crate::programs::{ARM_GCC, GCC};
use crate::toolchain::Target;
use crate::{process, project};

/// The examples in `capi/examples`.
const EXAMPLES: [&str; 2] = ["home", "lift"];

const WARNINGS: [&str; 5] = ["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror"];

fn capi(file: &str) -> PathBuf {
    project::root().join("capi").join(file)
}

/// Builds every example with the host's compiler, with both sanitizers, and runs it.
pub fn on_host() -> Result<()> {
    let library = library::build(None, &library::FEATURES)?;
    for example in EXAMPLES {
        let binary = library.with_file_name(example);
        let mut gcc = GCC.command()?;
        gcc.args(WARNINGS).args(["-g", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-I"]);
        gcc.arg(capi("include")).arg(capi("examples").join(format!("{example}.c"))).arg(&library).arg("-o").arg(&binary);
        process::run(&mut gcc)?;
        process::run(&mut Command::new(&binary))?;
    }
    Ok(())
}

/// Builds every example for the Cortex-M4F and runs it in the emulator.
pub fn on_board() -> Result<()> {
    let target = Target::Thumbv7emHf;
    let library = library::build(Some(target), &library::FEATURES)?;
    let built = library::artifacts(target);
    for example in EXAMPLES {
        let binary = built.join(format!("{example}.elf"));
        process::run(&mut cross_gcc(&source(example), &library, &binary)?)?;
        must_not_panic(&binary)?;
    }
    // Not every function is in an example.
    let binary = built.join("every-function.elf");
    let mut gcc = cross_gcc(&source(EXAMPLES[0]), &library, &binary)?;
    process::run(gcc.args(header::functions()?.iter().map(|function| format!("-Wl,--undefined={function}"))))?;
    must_not_panic(&binary)?;
    for example in EXAMPLES {
        let (code, said) = emulate(Board::An386, &built.join(format!("{example}.elf")))?;
        print!("{said}");
        if code != 0 {
            bail!("the example {example} ended with {code} on the board");
        }
    }
    Ok(())
}

fn source(example: &str) -> PathBuf {
    capi("examples").join(format!("{example}.c"))
}

fn must_not_panic(binary: &Path) -> Result<()> {
    let panics = panics(binary)?;
    if !panics.is_empty() {
        bail!("{} has symbols that are there to panic: {}", binary.display(), panics.join(", "));
    }
    Ok(())
}

fn cross_gcc(source: &Path, library: &Path, binary: &Path) -> Result<Command> {
    let mut gcc = ARM_GCC.command()?;
    gcc.args(WARNINGS).args(["-mthumb", "-mcpu=cortex-m4", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16", "-ffp-contract=off", "-O2"]);
    gcc.args(["-ffunction-sections", "-fdata-sections", "-Wl,--gc-sections", "--specs=rdimon.specs", "-nostartfiles", "-I"]);
    gcc.arg(capi("include")).arg("-T").arg(capi("examples/board/link.ld"));
    gcc.arg(source).arg(capi("examples/board/start.c"));
    gcc.arg(library).arg("-o").arg(binary);
    Ok(gcc)
}
