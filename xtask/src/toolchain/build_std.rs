//! Targets by Debian's toolchain: its cargo builds the standard library from
//! the sources that Debian has packaged, with Debian's linker.

use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context, Result};

use super::{Target, apt_install, debian};
use crate::{process, project};

const RUST: [&str; 3] = ["rustc-web", "cargo-web", "rust-web-src"];
const WHY: &str = "to build for microcontrollers and the browser";

const CARGO: &str = "/usr/bin/cargo";
const RUSTC: &str = "/usr/bin/rustc";
const RUSTDOC: &str = "/usr/bin/rustdoc";

/// Installs what is missing of the toolchain.
pub fn setup() -> Result<()> {
    apt_install(&RUST, WHY)?;
    // Which linker fits is known only when the compiler is there.
    apt_install(&[&linker_package()?], WHY)
}

/// Whether nothing of the toolchain is missing.
pub fn is_installed() -> bool {
    debian::are_installed(&RUST) && linker_package().is_ok_and(|linker| debian::are_installed(&[&linker]))
}

/// The compiler's name and version.
pub fn describe() -> Result<String> {
    let version = process::capture(rustc().arg("--version"))?;
    Ok(format!("Debian's {}", version.trim()))
}

/// Debian's cargo, told to build the standard library as well; the
/// subcommand is the next argument.
pub fn cargo(target: Target) -> Result<Command> {
    let crates = if target.has_std() { "std,panic_abort" } else { "core,alloc" };
    let mut command = Command::new(CARGO);
    command
        .arg(format!("-Zbuild-std={crates}"))
        .current_dir(project::root())
        // Without this, cargo takes -Z options only if it is a nightly one.
        .env("RUSTC_BOOTSTRAP", "1")
        .env("RUSTC", RUSTC)
        .env("RUSTDOC", RUSTDOC);
    let linker = target.cargo_variable("LINKER");
    if std::env::var_os(&linker).is_none() {
        command.env(linker, linker_path(target)?);
    }
    forget_host_toolchain(&mut command);
    Ok(command)
}

fn rustc() -> Command {
    let mut command = Command::new(RUSTC);
    forget_host_toolchain(&mut command);
    command
}

/// Takes away the variables by which the cargo that runs this program names
/// its own parts: mixed with Debian's they would fail.
fn forget_host_toolchain(command: &mut Command) {
    project::forget_own_package(command);
    for name in ["CARGO", "RUSTUP_TOOLCHAIN", "LD_LIBRARY_PATH"] {
        command.env_remove(name);
    }
}

fn linker_package() -> Result<String> {
    Ok(format!("lld-{}", llvm()?))
}

fn linker_path(target: Target) -> Result<PathBuf> {
    let name = match target {
        Target::Wasm32 => "wasm-ld",
        Target::Thumbv6m | Target::Thumbv7m | Target::Thumbv7emHf => "ld.lld",
    };
    Ok(PathBuf::from(format!("/usr/lib/llvm-{}/bin/{name}", llvm()?)))
}

/// The LLVM release that the compiler was built with.
fn llvm() -> Result<u32> {
    let about = process::capture(rustc().arg("-vV"))?;
    llvm_release(&about).with_context(|| format!("`{RUSTC} -vV` names no LLVM version"))
}

fn llvm_release(about: &str) -> Option<u32> {
    about
        .lines()
        .find_map(|line| line.strip_prefix("LLVM version: "))
        .and_then(|version| version.split('.').next())
        .and_then(|release| release.trim().parse().ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_llvm_release_is_the_first_number() {
        let about = "rustc 1.96.0 (abc 2026-05-25)\nrelease: 1.96.0\nLLVM version: 22.1.2\n";
        assert_eq!(llvm_release(about), Some(22));
        assert_eq!(llvm_release("rustc 1.96.0\n"), None);
    }
}
