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

use anyhow::{Context, Result, bail};

pub use target::Target;

use crate::project;

const MODE: &str = "CROSS_TOOLCHAIN_MODE";

/// How the targets other than the host are built for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// The host's toolchain, with standard libraries that rustup added.
    Rustup,
    /// Debian's toolchain, which builds the standard library from its sources.
    BuildStd,
}

impl Way {
    const fn name(self) -> &'static str {
        match self {
            Self::Rustup => "rustup",
            Self::BuildStd => "build-std",
        }
    }
}

/// Makes sure that all targets can be built for, and says how.
pub fn setup() -> Result<()> {
    let way = way()?;
    let by = match way {
        Way::Rustup => "standard libraries from rustup".to_owned(),
        Way::BuildStd => format!("standard library built by {}", build_std::describe()?),
    };
    say(&format!("ready ({}): {by}, for", way.name()));
    for target in Target::ALL {
        say(&format!("  {}", target.triple()));
    }
    Ok(())
}

/// `cargo build --target …`, ready to be given its other arguments. Sets the
/// target up if that has not been done. What is built is in [`artifacts`].
pub fn cross_cargo(target: Target) -> Result<Command> {
    cross_cargo_as(target, "build")
}

/// Like [`cross_cargo`], for another of cargo's commands, such as `rustc`.
pub fn cross_cargo_as(target: Target, subcommand: &str) -> Result<Command> {
    let mut command = match way()? {
        Way::Rustup => project::cargo(),
        Way::BuildStd => build_std::cargo(target)?,
    };
    command.args([subcommand, "--target", target.triple(), "--target-dir"]).arg(cross_dir());
    Ok(command)
}

/// Where [`cross_cargo`] leaves what it builds with a profile (`release`, `debug`).
pub fn artifacts(target: Target, profile: &str) -> PathBuf {
    cross_dir().join(target.triple()).join(profile)
}

/// The way that is set up. The first call sets it up.
pub fn way() -> Result<Way> {
    static CHOSEN: OnceLock<Way> = OnceLock::new();
    if let Some(way) = CHOSEN.get() {
        return Ok(*way);
    }
    let way = choose()?;
    Ok(*CHOSEN.get_or_init(|| way))
}

fn choose() -> Result<Way> {
    let mode = std::env::var(MODE).unwrap_or_default();
    match mode.as_str() {
        "rustup" => {
            rustup::setup()?;
            Ok(Way::Rustup)
        }
        "build-std" => {
            build_std::describe()?;
            Ok(Way::BuildStd)
        }
        "" | "auto" => choose_by_trying(),
        other => bail!("{MODE} is auto, rustup or build-std, not `{other}`"),
    }
}

/// Takes rustup's libraries if they are there, else what the last setup ended
/// in (so that it asks nothing again), else what can be had.
fn choose_by_trying() -> Result<Way> {
    if rustup::has_all() {
        return Ok(Way::Rustup);
    }
    if remembered() == Some(Way::BuildStd) && build_std::describe().is_ok() {
        return Ok(Way::BuildStd);
    }
    let Err(no_rustup) = rustup::setup() else {
        return remember(Way::Rustup);
    };
    say(&format!("{no_rustup:#}"));
    build_std::describe()?;
    remember(Way::BuildStd)
}

fn remembered() -> Option<Way> {
    let name = std::fs::read_to_string(note()).ok()?;
    [Way::Rustup, Way::BuildStd].into_iter().find(|way| way.name() == name.trim())
}

fn remember(way: Way) -> Result<Way> {
    let note = note();
    std::fs::create_dir_all(cross_dir())
        .and_then(|()| std::fs::write(&note, format!("{}\n", way.name())))
        .with_context(|| format!("{} cannot be written", note.display()))?;
    Ok(way)
}

fn note() -> PathBuf {
    cross_dir().join("way")
}

/// Its own folder, so that the two kinds of build do not undo each other's work.
fn cross_dir() -> PathBuf {
    project::target_dir().join("cross")
}

/// Tells the user what is being done.
fn say(text: &str) {
    eprintln!("toolchain: {text}");
}
