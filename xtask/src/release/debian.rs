//! The command line for Debian and systems that take its packages.

use super::archive::Texts;
use anyhow::{Context, Result};
use std::path::Path;
use xshell::{Shell, cmd};

/// Packs the folder of the command line, which was built for a machine, by `dpkg-deb`.
pub fn make(sh: &Shell, texts: &Texts, folder: &Path, machine: &str, to: &Path) -> Result<()> {
    let processor = machine.split('-').next().unwrap_or_default();
    let architecture = [("x86_64", "amd64"), ("aarch64", "arm64"), ("riscv64gc", "riscv64")];
    let (_, architecture) =
        architecture.into_iter().find(|(rust, _)| *rust == processor).context("Debian has another name for this processor")?;
    let above = sh.create_temp_dir()?;
    let (name, version) = ("goodbot", texts.text("@VERSION@"));
    let tree = above.path().join(name);
    let share = sh.create_dir(tree.join("usr/share"))?;
    sh.copy_file(folder.join("bin/goodbot"), sh.create_dir(tree.join("usr/bin"))?)?;
    let places = [
        ("man/man1/goodbot.1", "man/man1/goodbot.1"),
        ("bash-completion/completions/goodbot", "bash-completion/completions/goodbot"),
        ("zsh/site-functions/_goodbot", "zsh/vendor-completions/_goodbot"),
        ("fish/vendor_completions.d/goodbot.fish", "fish/vendor_completions.d/goodbot.fish"),
    ];
    for (from, place) in places {
        sh.write_file(share.join(place), sh.read_file(folder.join("share").join(from))?)?;
    }
    let licences = ["LICENSE-MIT", "LICENSE-APACHE"].map(|file| sh.read_file(folder.join(file)));
    let licences = licences.into_iter().collect::<xshell::Result<Vec<_>>>()?.join("\n\n");
    sh.write_file(share.join("doc/goodbot/copyright"), licences)?;
    // A program for musl brings its libraries.
    let needs = if machine.ends_with("gnu") { format!("Depends: libc6 (>= {}), libgcc-s1\n", c_library(sh)?) } else { String::new() };
    let control = format!(
        "Package: {name}\nVersion: {version}\nArchitecture: {architecture}\nMaintainer: The goodbot developers\n{needs}\
         Section: science\nPriority: optional\nDescription: trains a robot by praise and blame to understand commands\n \
         You tell a robot in your own words what to do. You say \"good bot\" or \"bad bot\" while it\n \
         tries. It learns what your words mean.\n"
    );
    sh.write_file(tree.join("DEBIAN/control"), control)?;
    let package = to.join(format!("{name}_{version}_{architecture}.deb"));
    cmd!(sh, "chmod -R u=rwX,go=rX {tree}").run()?;
    cmd!(sh, "dpkg-deb --root-owner-group --build {tree} {package}").run()?;
    Ok(())
}

/// The version of this machine's C library, which the program was linked to.
fn c_library(sh: &Shell) -> Result<String> {
    let said = cmd!(sh, "ldd --version").quiet().read()?;
    let version = said.lines().next().and_then(|line| line.rsplit(' ').next());
    Ok(version.context("`ldd --version` names no version")?.to_owned())
}
