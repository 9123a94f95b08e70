//! What is needed to build for the targets other than the host.
//!
//! There are two ways to build for those [`Target`]s. rustup can add a target's ready-made standard library to the host's toolchain. Where
//! that cannot be had, Debian's compiler comes with the standard library's sources, and cargo builds the library together with the project.
//! The variable `CROSS_TOOLCHAIN_MODE` chooses: `rustup`, `build-std`, or `auto`, which tries rustup first and is what holds if it is not
//! set.

mod build_std;
mod rustup;
mod target;

use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;

use anyhow::{Result, bail};

pub use target::Target;

use crate::programs::missing;
use crate::{process, project};

const MODE: &str = "CROSS_TOOLCHAIN_MODE";

/// How the targets other than the host are built for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    /// The host's toolchain, with standard libraries that rustup added.
    Rustup,
    /// Debian's toolchain, which builds the standard library from its sources.
    BuildStd,
}

/// Makes sure that all targets can be built for, and says how.
pub fn setup() -> Result<()> {
    let by = match way()? {
        Way::Rustup => "standard libraries from rustup".to_owned(),
        Way::BuildStd => format!("the standard library built by {}", build_std::describe()?),
    };
    println!("{}: {by}", Target::ALL.map(Target::triple).join(", "));
    Ok(())
}

/// The compiler that builds for the targets, such as `rustup's rustc 1.95.0`.
pub fn compiler() -> Result<String> {
    let described = match way()? {
        Way::Rustup => {
            format!("rustup's {}", process::capture(Command::new("rustc").current_dir(project::root()).arg("--version"))?.trim())
        }
        Way::BuildStd => build_std::describe()?,
    };
    // Without the commit and the day.
    Ok(described.split(" (").next().unwrap_or_default().to_owned())
}

/// `cargo build --target …`, ready to be given its other arguments. Sets the target up if that has not been done. What is built is in
/// [`artifacts`].
pub fn cross_cargo(target: Target) -> Result<Command> {
    cross_cargo_as(target, "build")
}

/// Like [`cross_cargo`], for another of cargo's commands, such as `rustc`.
pub fn cross_cargo_as(target: Target, subcommand: &str) -> Result<Command> {
    let mut command = match way()? {
        Way::Rustup => project::cargo(),
        Way::BuildStd => build_std::cargo(target)?,
    };
    command.args([subcommand, "--target", target.triple(), "--target-dir"]).arg(folder());
    Ok(command)
}

/// Arguments for [`cross_cargo`] by which a profile's panics end at once, without the code that words their messages. That can be had only
/// where the standard library is built too; a ready-made one brings its messages along, and there are none then.
pub fn without_panic_messages(profile: &str) -> Result<Vec<String>> {
    Ok(match way()? {
        Way::Rustup => Vec::new(),
        // Not by -Z: what stands behind the subcommand would replace what stands before it.
        Way::BuildStd => [
            "unstable.panic-immediate-abort=true".to_owned(),
            "unstable.build-std-features=[\"optimize_for_size\"]".to_owned(),
            format!("profile.{profile}.panic=\"immediate-abort\""),
        ]
        .map(|setting| format!("--config={setting}"))
        .to_vec(),
    })
}

/// Where [`cross_cargo`] leaves what it builds with a profile.
pub fn artifacts(target: Target, profile: &str) -> PathBuf {
    folder().join(target.triple()).join(profile)
}

/// Its own folder, so that the two kinds of build do not undo each other's work.
fn folder() -> PathBuf {
    project::target_dir().join("cross")
}

/// The way that is set up. The first call sets it up.
fn way() -> Result<Way> {
    static CHOSEN: OnceLock<Way> = OnceLock::new();
    if let Some(way) = CHOSEN.get() {
        return Ok(*way);
    }
    let mode = std::env::var(MODE).unwrap_or_default();
    let way = match mode.as_str() {
        "rustup" => {
            rustup::setup().map_err(|error| missing("standard libraries for other targets", build_std::WHY, &error))?;
            Way::Rustup
        }
        "" | "auto" if rustup::has_all() => Way::Rustup,
        // rustup was asked once, and had none.
        "" | "auto" if !build_std::is_fetched() => match rustup::setup() {
            Ok(()) => Way::Rustup,
            Err(error) => {
                eprintln!("{error:#}");
                Way::BuildStd
            }
        },
        "" | "auto" | "build-std" => Way::BuildStd,
        other => bail!("{MODE} is auto, rustup or build-std, not `{other}`"),
    };
    if way == Way::BuildStd {
        build_std::describe()?;
    }
    Ok(*CHOSEN.get_or_init(|| way))
}
