//! The toolchain for targets other than the host.
//!
//! There are two ways to build for those [`TARGETS`]. rustup can add a target's ready-made standard library to the host's toolchain. Where
//! that cannot be had, Debian's compiler comes with the standard library's sources, and cargo builds the library together with the project.
//! The variable `CROSS_TOOLCHAIN_MODE` chooses: `rustup`, `build-std`, or `auto`, which tries rustup first and is what holds if it is not
//! set.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use std::time::Duration;

use anyhow::{Context, Result, ensure};
use xshell::{Cmd, Shell, cmd};

use crate::process::{once, shell, target_dir, within};
use crate::programs::{CARGO, RUSTC, missing};

/// WebAssembly, for the browser.
pub const WASM: &str = "wasm32-unknown-unknown";
/// Cortex-M0 and M0+.
pub const CORTEX_M0: &str = "thumbv6m-none-eabi";
pub const CORTEX_M3: &str = "thumbv7m-none-eabi";
/// Cortex-M4F and M7F: floats in registers of the floating-point unit.
pub const CORTEX_M4F: &str = "thumbv7em-none-eabihf";
/// The same processors, for boards whose C code passes floats in integer registers.
pub const CORTEX_M4: &str = "thumbv7em-none-eabi";
/// Cortex-M33 with a floating-point unit.
pub const CORTEX_M33F: &str = "thumbv8m.main-none-eabihf";
/// RISC-V without a floating-point unit, such as an ESP32-C6.
pub const RISCV: &str = "riscv32imac-unknown-none-elf";
/// The same without atomic instructions, such as an ESP32-C3.
pub const RISCV_C3: &str = "riscv32imc-unknown-none-elf";
/// A system that is no Unix, for the command line. The build is only checked, because its linker is not available everywhere.
pub const WINDOWS: &str = "x86_64-pc-windows-msvc";
/// The targets besides the host.
pub const TARGETS: [&str; 8] = [WASM, CORTEX_M0, CORTEX_M3, CORTEX_M4, CORTEX_M4F, CORTEX_M33F, RISCV, RISCV_C3];

/// Inlines small functions on controllers, whose code is optimised for size ("z"). With LLVM's limit for such code, 5, the calls take more flash
/// than the functions, and a sixth more instructions.
const INLINED_ON_CONTROLLERS: &str = "-Cllvm-args=-inline-threshold=50";

/// How long rustup may take.
const RUSTUP_LIMIT: Duration = Duration::from_secs(90);

/// Debian's toolchain: its cargo builds the standard library from Debian's packaged sources, with Debian's linker.
#[derive(Debug)]
struct Debian {
    cargo: PathBuf,
    rustc: PathBuf,
    /// The folder of the linkers.
    linkers: PathBuf,
}

impl Debian {
    /// Finds the system's, or fetches it.
    fn find() -> Result<Self> {
        let is_complete = |found: &Self| Path::new("/usr/lib/rustlib/src/rust/library/Cargo.lock").is_file() && found.cargo.is_file();
        match Self::below(Path::new("/"), "/usr/bin/cargo".into(), "/usr/bin/rustc".into()) {
            Ok(found) if is_complete(&found) => Ok(found),
            _ => Self::below(&RUSTC.tree(), CARGO.fetch()?, RUSTC.fetch()?),
        }
    }

    fn below(root: &Path, cargo: PathBuf, rustc: PathBuf) -> Result<Self> {
        let sh = shell()?;
        let about = own(cmd!(sh, "{rustc} -vV")).ignore_stderr().read()?;
        let (_, llvm) = about.split_once("LLVM version: ").context("`rustc -vV` names no LLVM version")?;
        let linkers = root.join(format!("usr/lib/llvm-{}/bin", llvm.split('.').next().unwrap_or_default()));
        ensure!(linkers.join("wasm-ld").is_file(), "there is no linker in {}", linkers.display());
        Ok(Self { cargo, rustc, linkers })
    }
}

/// A command without the environment variables that refer to the running cargo's own parts.
fn own(program: Cmd) -> Cmd {
    program.env_remove("CARGO").env_remove("RUSTUP_TOOLCHAIN").env_remove("LD_LIBRARY_PATH")
}

/// Debian's toolchain, or `None` if rustup's is used. The first call chooses one and sets it up.
fn debian() -> Result<Option<&'static Debian>> {
    static CHOSEN: OnceLock<Option<Debian>> = OnceLock::new();
    let mode = std::env::var("CROSS_TOOLCHAIN_MODE").unwrap_or_default();
    ensure!(["", "auto", "rustup", "build-std"].contains(&&*mode), "CROSS_TOOLCHAIN_MODE is auto, rustup or build-std, not `{mode}`");
    let choose = || {
        let by_rustup = match mode.as_str() {
            "rustup" => add_by_rustup(&TARGETS).map(|()| true)?,
            "build-std" => false,
            // Debian's was fetched before, because rustup had failed.
            _ if RUSTC.is_fetched() => lacking(&TARGETS).is_ok_and(|lacking| lacking.is_empty()),
            _ => add_by_rustup(&TARGETS).inspect_err(|error| eprintln!("{error:#}")).is_ok(),
        };
        let to_do = "install Rust by rustup, and the targets by `rustup target add`";
        (!by_rustup).then(|| Debian::find().context(to_do)).transpose()
    };
    let chosen = once(&CHOSEN, || Ok(choose().map_err(|error| missing("a Rust toolchain for other targets", RUSTC.why, error))?))?;
    Ok(chosen.as_ref())
}

/// The targets that rustup has not added yet.
fn lacking(targets: &[&'static str]) -> Result<Vec<&'static str>> {
    let sh = shell()?;
    let added = cmd!(sh, "rustup target list --installed").quiet().read()?;
    Ok(targets.iter().copied().filter(|target| !added.lines().any(|line| line.trim() == *target)).collect())
}

fn add_by_rustup(targets: &[&'static str]) -> Result<()> {
    let (sh, lacking) = (shell()?, lacking(targets)?);
    if !lacking.is_empty() {
        eprintln!("rustup adds {} (it is given {} s)", lacking.join(", "), RUSTUP_LIMIT.as_secs());
        let (code, _) = within(RUSTUP_LIMIT, cmd!(sh, "rustup target add {lacking...}"))?;
        ensure!(code == 0, "rustup could not add the targets");
    }
    Ok(())
}

/// Sets up the targets, and prints them with the compiler that builds for them.
pub fn list() -> Result<()> {
    println!("{}: built by {}", TARGETS.join(", "), compiler()?);
    Ok(())
}

/// The name of the compiler for the targets, such as `rustup's rustc 1.95.0`. It is set up if necessary.
pub fn compiler() -> Result<String> {
    let sh = shell()?;
    let (whose, version) = match debian()? {
        None => ("rustup", cmd!(sh, "rustc --version").read()?),
        Some(Debian { rustc, .. }) => ("Debian", own(cmd!(sh, "{rustc} --version")).read()?),
    };
    // Without the commit and the date.
    Ok(format!("{whose}'s {}", version.split(" (").next().unwrap_or_default()))
}

/// Whether the target [`WINDOWS`] has a ready-made standard library. rustup adds it if needed.
pub fn has_windows() -> Result<bool> {
    let by_rustup = debian()?.is_none();
    if by_rustup {
        add_by_rustup(&[WINDOWS]).map_err(|error| missing("the target of Windows", "to check the command line for it", error))?;
    }
    Ok(by_rustup)
}

/// Cargo's command `build`, `check` or `rustc` for a target, without its other arguments. Sets up the target if necessary. [`artifacts`]
/// names the folder of the result.
pub fn cargo<'sh>(sh: &'sh Shell, target: &str, subcommand: &str) -> Result<Cmd<'sh>> {
    let is_hosted = [WASM, WINDOWS].contains(&target);
    let variable = |name: &str| format!("CARGO_TARGET_{}_{name}", target.replace(['-', '.'], "_").to_uppercase());
    let cargo = match debian()? {
        None => cmd!(sh, "cargo"),
        Some(Debian { cargo, rustc, linkers }) => {
            let crates = if is_hosted { "std,panic_abort" } else { "core,alloc" };
            let linker = if target == WASM { "wasm-ld" } else { "ld.lld" };
            // Without the first variable, only a nightly cargo accepts -Z options.
            let cargo = own(cmd!(sh, "{cargo} -Zbuild-std={crates}")).env("RUSTC_BOOTSTRAP", "1").env("RUSTC", rustc);
            cargo.env(variable("LINKER"), linkers.join(linker))
        }
    };
    let cargo = if is_hosted { cargo } else { cargo.env(variable("RUSTFLAGS"), INLINED_ON_CONTROLLERS) };
    // Its own folder, so that the two kinds of build do not undo each other's work.
    Ok(cargo.args([subcommand, "--target", target, "--target-dir"]).arg(target_dir().join("cross")))
}

/// Set where this program stands between cargo and the compiler. Its value is the user's own program at that place, if there is one.
const AS_COMPILER: &str = "GOODBOT_XTASK_AS_COMPILER";

/// The same build, with the same bytes in any folder.
///
/// Cargo numbers the crates, and the numbers order what the compiler writes. A crate outside the workspace, as the core is for the firmware, is numbered by
/// its whole path. So this program calls the compiler, and gives the project's crates their names instead.
pub fn in_any_folder(cargo: Cmd) -> Result<Cmd> {
    let own = std::env::var_os("RUSTC_WRAPPER").unwrap_or_default();
    Ok(cargo.env("RUSTC_WRAPPER", std::env::current_exe()?).env(AS_COMPILER, own))
}

/// Calls the compiler, if cargo calls this program for that.
pub fn as_compiler() -> Option<Result<()>> {
    std::env::var_os(AS_COMPILER).map(|own| {
        let package = std::env::var("CARGO_PKG_NAME").unwrap_or_default();
        let mut arguments = Some(own).filter(|own| !own.is_empty()).into_iter().chain(std::env::args_os().skip(1));
        let mut compiler = Command::new(arguments.next().context("cargo names no compiler")?);
        let ended = compiler.args(arguments.map(|argument| without_number(argument, &package))).status();
        let ended = ended.with_context(|| format!("{} could not be started", compiler.get_program().display()))?;
        ensure!(ended.success(), "the compiler ended with {ended}");
        Ok(())
    })
}

/// An argument for the compiler; a package of the project has its name as its number.
fn without_number(argument: OsString, package: &str) -> OsString {
    let is_number = argument.to_str().is_some_and(|text| text.starts_with("metadata="));
    if is_number && package.starts_with("goodbot") { format!("metadata={package}").into() } else { argument }
}

/// Where [`cargo`] leaves what it builds with a profile.
pub fn artifacts(target: &str, profile: &str) -> PathBuf {
    target_dir().join("cross").join(target).join(profile)
}

/// Arguments for [`cargo`] that optimise packages for size and speed ("s") where a profile optimises for size alone ("z"). The standard library stays
/// as it is, so that it is built once for both.
pub fn faster(profile: &str, packages: &[&str]) -> Vec<String> {
    packages.iter().map(|package| format!("--config=profile.{profile}.package.{package}.opt-level=\"s\"")).collect()
}

/// The profile of the C library for controllers. The firmware's workspace needs another folder: the two would rebuild each other's standard library.
pub const CONTROLLER: &str = "controller";

/// Cargo's command for a small WebAssembly module of one package, without the package, and whether the module has messages of panics:
/// rustup's ready-made standard library contains them. Its profile is `page`.
pub fn module(sh: &Shell) -> Result<(Cmd<'_>, bool)> {
    // Only the module: with a library in the same call, cargo leaves out the optimisation at link time.
    let cargo = cargo(sh, WASM, "rustc")?.args(["--profile", "page", "--crate-type", "cdylib"]);
    if debian()?.is_none() {
        return Ok((cargo, true));
    }
    // Not by -Z: options after the subcommand would replace those before it. The last setting leaves out the source locations of panics, which
    // nobody could read here.
    let settings = [
        "unstable.panic-immediate-abort=true",
        "unstable.build-std-features=[\"optimize_for_size\"]",
        "profile.page.panic=\"immediate-abort\"",
        "target.wasm32-unknown-unknown.rustflags=[\"-Zlocation-detail=none\"]",
    ];
    Ok((cargo.args(settings.map(|setting| format!("--config={setting}"))), false))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crate_of_the_project_is_numbered_by_its_name_and_another_crate_as_cargo_says() {
        let number = OsString::from("metadata=0123456789abcdef");
        assert_eq!(without_number(number.clone(), "goodbot-microbit"), "metadata=goodbot-microbit");
        assert_eq!(without_number(number.clone(), "heapless"), number);
        assert_eq!(without_number("extra-filename=-0123456789abcdef".into(), "goodbot"), "extra-filename=-0123456789abcdef");
    }
}
