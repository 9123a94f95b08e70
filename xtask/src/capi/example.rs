//! The C examples on this machine and on an emulated board.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Result, bail};

use super::{header, library};
use crate::firmware::board::{Board, emulate};
use crate::firmware::image::{flash, panics};
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

/// Bytes of flash that the library adds to programs for the Cortex-M4F.
pub fn sizes() -> Result<Vec<(&'static str, u64)>> {
    const EMPTY: &str = "int main(void) { return 0; }\n";
    let target = Target::Thumbv7emHf;
    let mut sizes = Vec::new();
    let programs: [(&str, &[&str], Vec<String>); 3] = [
        ("every function, all features", &library::FEATURES, header::functions()?),
        ("what capi/examples/home.c calls, feature `home`", &["home"], called("home")?),
        ("what capi/examples/lift.c calls, feature `table`", &["table"], called("lift")?),
    ];
    for (name, features, functions) in programs {
        let library = library::build(Some(target), features)?;
        let built = library::artifacts(target);
        let (source, binary) = (built.join("empty.c"), built.join("size.elf"));
        std::fs::write(&source, EMPTY)?;
        let linked = |functions: &[String]| {
            let mut gcc = cross_gcc(&source, &library, &binary)?;
            process::run(gcc.args(functions.iter().map(|function| format!("-Wl,--undefined={function}"))))?;
            flash(&binary)
        };
        // A program that calls nothing has the start-up, and what that takes of C's own library.
        sizes.push((name, linked(&functions)?.saturating_sub(linked(&[])?)));
    }
    Ok(sizes)
}

/// The functions of the library that an example calls.
fn called(example: &str) -> Result<Vec<String>> {
    let source = std::fs::read_to_string(source(example))?;
    Ok(header::functions()?.into_iter().filter(|function| source.contains(&format!("{function}("))).collect())
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
