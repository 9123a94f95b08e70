//! The C examples on this machine and on an emulated board.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Result, bail};

use super::{header, library};
use crate::firmware::board::{Board, emulate};
use crate::firmware::image::panics;
use crate::firmware::trial::Report;
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

/// A program for the Cortex-M4F.
#[derive(Clone, Copy, Debug)]
pub struct Program {
    /// What its file is called where it is built.
    name: &'static str,
    example: &'static str,
    /// The library's features.
    features: &'static [&'static str],
    /// Whether all functions are linked, also those that it does not call.
    every_function: bool,
}

impl Program {
    const fn example(name: &'static str) -> Self {
        Self { name, example: name, features: &library::FEATURES, every_function: false }
    }

    /// A robot in a home.
    pub const HOME: Self = Self::example("home");
    /// A robot of one's own.
    pub const LIFT: Self = Self::example("lift");
    /// The same with a library that has nothing else.
    pub const LIFT_ALONE: Self = Self { name: "lift-alone", features: &["table"], ..Self::LIFT };
    /// Not every function is in an example.
    pub const EVERY_FUNCTION: Self = Self { name: "every-function", every_function: true, ..Self::HOME };

    /// Builds it. Gives where it is.
    pub fn build(self) -> Result<PathBuf> {
        let library = library::build(Some(TARGET), self.features)?;
        let binary = library::artifacts(TARGET).join(format!("{}.elf", self.name));
        let mut gcc = cross_gcc(&capi("examples").join(format!("{}.c", self.example)), &library, &binary)?;
        if self.every_function {
            gcc.args(header::functions()?.iter().map(|function| format!("-Wl,--undefined={function}")));
        }
        process::run(&mut gcc)?;
        Ok(binary)
    }

    /// Builds it, and runs it in the emulator. Gives what it reports.
    pub fn run(self) -> Result<Report> {
        let (code, said) = emulate(Board::An386, &self.build()?)?;
        print!("{said}");
        if code != 0 {
            bail!("the example {} ended with {code} on the board", self.name);
        }
        Ok(Report::read(&said))
    }
}

const TARGET: Target = Target::Thumbv7emHf;

/// Builds every example for the Cortex-M4F and runs it in the emulator.
pub fn on_board() -> Result<()> {
    for program in [Program::HOME, Program::LIFT, Program::EVERY_FUNCTION] {
        let binary = program.build()?;
        let panics = panics(&binary)?;
        if !panics.is_empty() {
            bail!("{} has symbols that are there to panic: {}", binary.display(), panics.join(", "));
        }
        program.run()?;
    }
    Ok(())
}

fn cross_gcc(source: &Path, library: &Path, binary: &Path) -> Result<Command> {
    let mut gcc = ARM_GCC.command()?;
    gcc.args(WARNINGS).args(["-mthumb", "-mcpu=cortex-m4", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16", "-ffp-contract=off", "-O2"]);
    gcc.args([
        "-ffunction-sections",
        "-fdata-sections",
        "-Wl,--gc-sections",
        "--specs=nano.specs",
        "--specs=rdimon.specs",
        "-nostartfiles",
        "-I",
    ]);
    gcc.arg(capi("include")).arg("-T").arg(capi("examples/board/link.ld"));
    gcc.arg(source).arg(capi("examples/board/start.c"));
    gcc.arg(library).arg("-o").arg(binary);
    Ok(gcc)
}
