//! The C interface as a static library, for this machine or a microcontroller.

use std::path::PathBuf;

use anyhow::{Context, Result, bail};

use crate::toolchain::{self, Target};
use crate::{process, project};

/// What makes a static library of the interface.
const LIBRARY: [&str; 5] = ["--quiet", "--package", "goodbot-capi", "--crate-type", "staticlib"];

/// The feature that a library alone needs.
const ALONE: &str = "alone";

/// The features that are chosen from, as `capi/Cargo.toml` has them.
pub const FEATURES: [&str; 6] = ["asking", "derived", "home", "table", "unicode", "ways"];

/// The library's file, as cargo names it.
const FILE: &str = "libgoodbot_capi.a";

/// The profile of the library for a microcontroller.
const FOR_CONTROLLERS: &str = "controller";

/// Where the library for a microcontroller is built.
pub fn artifacts(target: Target) -> PathBuf {
    toolchain::artifacts(target, FOR_CONTROLLERS)
}

/// Builds it with these features, for this machine where there is no target. Gives where it is.
pub fn build(target: Option<Target>, features: &[&str]) -> Result<PathBuf> {
    let features = ["--no-default-features".to_owned(), "--features".to_owned(), [&[ALONE], features].concat().join(",")];
    let Some(target) = target else {
        // Beside the workspace's own files: the feature changes what is built.
        let folder = project::target_dir().join("capi");
        process::run(project::cargo().arg("rustc").args(LIBRARY).args(&features).arg("--release").arg("--target-dir").arg(&folder))?;
        return Ok(folder.join("release").join(FILE));
    };
    process::run(toolchain::cross_cargo_as(target, "rustc")?.args(LIBRARY).args(&features).args(["--profile", FOR_CONTROLLERS]))?;
    Ok(artifacts(target).join(FILE))
}

/// Builds it and puts it into a folder, with the header.
pub fn deliver(target: Option<Target>, features: &[String]) -> Result<()> {
    let features: Vec<&str> = features.iter().map(String::as_str).collect();
    if let Some(unknown) = features.iter().find(|feature| !FEATURES.contains(feature)) {
        bail!("the C library has no feature `{unknown}`; there are {}", FEATURES.join(", "));
    }
    if !features.iter().any(|feature| ["home", "table"].contains(feature)) {
        bail!("a robot lives in homes or is your own; add the feature home or table");
    }
    let built = build(target, &features)?;
    let folder = project::root().join("dist/c").join(target.map_or("host", Target::triple));
    std::fs::create_dir_all(&folder)?;
    for (from, name) in [(built, "libgoodbot.a"), (project::root().join("capi/include/goodbot.h"), "goodbot.h")] {
        std::fs::copy(&from, folder.join(name)).with_context(|| format!("{} cannot be copied", from.display()))?;
    }
    eprintln!("written: libgoodbot.a and goodbot.h in {}", folder.display());
    Ok(())
}
