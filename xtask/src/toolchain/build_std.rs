//! Targets by Debian's toolchain: its cargo builds the standard library from the sources that Debian has packaged, with Debian's linker.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use anyhow::{Context, Result};

use super::Target;
use crate::programs::debian::{Launch, Tree};
use crate::programs::missing;
use crate::{process, project};

const PACKAGES: [&str; 3] = ["rustc-web", "cargo-web", "rust-web-src"];
pub const WHY: &str = "to build for microcontrollers and the browser";
/// The standard library's sources.
const SOURCES: &str = "usr/lib/rustlib/src/rust/library/Cargo.lock";

/// The toolchain's parts.
#[derive(Debug)]
struct Toolchain {
    cargo: PathBuf,
    rustc: PathBuf,
    /// The folder of the linkers.
    linkers: PathBuf,
}

/// The toolchain: the system's, or fetched.
fn toolchain() -> Result<&'static Toolchain> {
    static FOUND: OnceLock<Toolchain> = OnceLock::new();
    if let Some(found) = FOUND.get() {
        return Ok(found);
    }
    let found = match installed() {
        Some(toolchain) => toolchain,
        None => fetch().map_err(|error| missing("a Rust toolchain for other targets", WHY, &error))?,
    };
    Ok(FOUND.get_or_init(|| found))
}

/// Whether it has been fetched.
pub fn is_fetched() -> bool {
    Tree::is_fetched(&PACKAGES)
}

fn installed() -> Option<Toolchain> {
    let root = Path::new("/");
    let [cargo, rustc] = ["cargo", "rustc"].map(|name| root.join("usr/bin").join(name));
    let linkers = linkers(root, &rustc).ok()?;
    (cargo.is_file() && root.join(SOURCES).is_file() && linkers.join("wasm-ld").is_file()).then_some(Toolchain { cargo, rustc, linkers })
}

fn fetch() -> Result<Toolchain> {
    // The linker is that of the LLVM that the compiler was built with.
    let tree = Tree::fetch(&PACKAGES, WHY, |needed| {
        let llvm = needed.iter().find_map(|name| name.strip_prefix("libllvm"))?;
        Some(format!("lld-{llvm}"))
    })
    .context("install Rust by rustup, and the targets by `rustup target add`")?;
    let launcher = |name: &str, file: &'static str| tree.launcher(name, &Launch::plain(file));
    let rustc = launcher("rustc", "usr/bin/rustc")?;
    let linkers = linkers(tree.path(), &rustc)?;
    Ok(Toolchain { cargo: launcher("cargo", "usr/bin/cargo")?, rustc, linkers })
}

/// The compiler's name and version.
pub fn describe() -> Result<String> {
    let version = process::capture(command(&toolchain()?.rustc).arg("--version"))?;
    Ok(format!("Debian's {}", version.trim()))
}

/// Debian's cargo, told to build the standard library as well; the subcommand is the next argument.
pub fn cargo(target: Target) -> Result<Command> {
    let Toolchain { cargo, rustc, linkers } = toolchain()?;
    let crates = if target.has_std() { "std,panic_abort" } else { "core,alloc" };
    let mut command = command(cargo);
    // Without the first variable, cargo takes -Z options only if it is a nightly one.
    command.arg(format!("-Zbuild-std={crates}")).env("RUSTC_BOOTSTRAP", "1").env("RUSTC", rustc);
    let variable = target.cargo_variable("LINKER");
    if std::env::var_os(&variable).is_none() {
        command.env(variable, linkers.join(if target == Target::Wasm32 { "wasm-ld" } else { "ld.lld" }));
    }
    Ok(command)
}

/// A program of the toolchain, without the variables by which the cargo that runs this program names its own parts.
fn command(program: &Path) -> Command {
    let mut command = Command::new(program);
    command.current_dir(project::root());
    project::forget_own_package(&mut command);
    for name in ["CARGO", "RUSTUP_TOOLCHAIN", "LD_LIBRARY_PATH"] {
        command.env_remove(name);
    }
    command
}

fn linkers(root: &Path, rustc: &Path) -> Result<PathBuf> {
    let about = process::capture(command(rustc).arg("-vV"))?;
    let llvm = llvm_release(&about).context("`rustc -vV` names no LLVM version")?;
    Ok(root.join(format!("usr/lib/llvm-{llvm}/bin")))
}

fn llvm_release(about: &str) -> Option<u32> {
    let version = about.lines().find_map(|line| line.strip_prefix("LLVM version: "))?;
    version.split('.').next()?.trim().parse().ok()
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
