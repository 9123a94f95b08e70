//! `cargo xtask fresh-machine`: the fetching, proved as on a machine where nobody has prepared anything.
//!
//! This program runs again, as a user who is not root and may not become it, with an empty home, a `PATH` that leads to none of the programs
//! nor to sudo, and a list of installed packages in which a `qemu-utils` is held that conflicts with the emulator. What that user fetched is
//! then used by the other commands, if they have nothing yet.

use std::fs;
use std::os::unix::fs::{MetadataExt, PermissionsExt, chown, symlink};
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail};

use crate::process;
use crate::programs::{self, FETCHED};

/// The user `nobody`.
const NOBODY: u32 = 65_534;

/// What the user's `PATH` does not lead to, beside the programs themselves.
const HIDDEN: [&str; 7] = ["sudo", "su", "doas", "pkexec", "cargo", "rustc", "qemu-utils"];

/// Where Debian notes what is installed.
const INSTALLED: &str = "/var/lib/dpkg/status";

/// A newer emulator's tools, as a backport brings them, kept by somebody's wish.
const HELD: &str = "\
Package: qemu-utils
Status: hold ok installed
Priority: optional
Section: otherosfs
Maintainer: nobody
Architecture: ARCHITECTURE
Version: 1:99.0
Breaks: qemu-system-common, qemu-system-arm
Conflicts: qemu-system-arm
Description: of another release
";

/// The machine: a folder that everybody can read, gone when this is dropped.
struct Machine(PathBuf);

impl Drop for Machine {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Fetches everything on such a machine; an error says what it took that it must not take.
pub fn prove() -> Result<()> {
    let before = fs::read(INSTALLED).context("this proof takes Debian")?;
    let machine = Machine::new()?;
    let fetched = machine.0.join("programs");
    let kept = programs::folder();
    let user = process::capture(machine.command("id").arg("-u"))?;
    if user.trim() == "0" {
        bail!("the proof runs as root");
    }
    for name in FETCHED.map(|program| program.name).into_iter().chain(["sudo"]) {
        if process::capture(machine.command("sh").args(["-c", &format!("command -v {name}")])).is_ok() {
            bail!("`{name}` is on the PATH of the proof");
        }
    }
    process::run(machine.command(machine.0.join("xtask")).arg("programs"))?;
    machine.must_have_refused_to_install()?;
    for program in FETCHED {
        let launcher = fetched.join(program.folder()).join("launch").join(program.name);
        let owner = launcher.metadata().with_context(|| format!("{} was not fetched", program.name))?.uid();
        if owner.to_string() != user.trim() {
            bail!("{} belongs to another user", launcher.display());
        }
    }
    if fs::read(INSTALLED)? != before {
        bail!("the system's packages have changed");
    }
    println!("user {} fetched everything on a machine that had none of it", user.trim());
    if !kept.exists() {
        fs::create_dir_all(kept.parent().context("no folder for programs")?)?;
        // Not by a new name: it may be another disk, and it shall be this user's.
        process::run(Command::new("cp").args(["-r", "--preserve=links,mode,timestamps", "--"]).arg(&fetched).arg(&kept))?;
    }
    Ok(())
}

impl Machine {
    fn new() -> Result<Self> {
        let machine = Self(std::env::temp_dir().join(format!("goodbot-fresh-machine-{}", std::process::id())));
        let root = &machine.0;
        for folder in ["bin", "home", "dpkg/updates", "dpkg/info", "programs"] {
            fs::create_dir_all(root.join(folder)).with_context(|| format!("{} cannot be made", root.display()))?;
        }
        for folder in [root.clone(), root.join("home"), root.join("bin")] {
            fs::set_permissions(folder, fs::Permissions::from_mode(0o755))?;
        }
        fs::copy(std::env::current_exe()?, root.join("xtask"))?;
        machine.link_programs()?;
        let status = fs::read_to_string(INSTALLED)?;
        let architecture = process::capture(Command::new("dpkg").arg("--print-architecture"))?;
        let others = status.split("\n\n").filter(|package| !package.starts_with("Package: qemu-") && !package.trim().is_empty());
        let all: Vec<_> =
            others.map(str::trim).chain([HELD.replace("ARCHITECTURE", architecture.trim()).trim()]).map(str::to_owned).collect();
        fs::write(root.join("dpkg/status"), all.join("\n\n") + "\n")?;
        for folder in ["home", "dpkg", "programs"] {
            machine.give(&root.join(folder))?;
        }
        Ok(machine)
    }

    /// Links to what the system has, but for what is hidden.
    fn link_programs(&self) -> Result<()> {
        for folder in ["/usr/local/bin", "/usr/bin", "/bin", "/usr/sbin", "/sbin"] {
            for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
                let name = entry.file_name().to_string_lossy().into_owned();
                let is_hidden =
                    HIDDEN.contains(&name.as_str()) || ["qemu", "chrom", "arm-none-eabi"].iter().any(|start| name.starts_with(start));
                if !is_hidden {
                    // The first folder's comes first.
                    let _ = symlink(entry.path(), self.0.join("bin").join(name));
                }
            }
        }
        Ok(())
    }

    /// Gives a folder and what is in it to the user.
    fn give(&self, path: &Path) -> Result<()> {
        if !is_root()? {
            return Ok(());
        }
        chown(path, Some(NOBODY), Some(NOBODY))?;
        if path.is_dir() {
            for entry in fs::read_dir(path)? {
                self.give(&entry?.path())?;
            }
        }
        Ok(())
    }

    /// A program as the user starts it. Of the environment, what says how to reach the packages is left.
    fn command(&self, program: impl AsRef<std::ffi::OsStr>) -> Command {
        let mut command = Command::new("setpriv");
        command.args(["--no-new-privs"]);
        if is_root().unwrap_or(true) {
            command.args([format!("--reuid={NOBODY}"), format!("--regid={NOBODY}"), "--clear-groups".to_owned()]);
        }
        command.arg("--").arg(program).env_clear().current_dir(self.0.join("home"));
        for (name, value) in std::env::vars_os() {
            let text = name.to_string_lossy().to_lowercase();
            if text.ends_with("_proxy") || text.starts_with("ssl_cert_") {
                command.env(name, value);
            }
        }
        command.env("PATH", self.0.join("bin")).env("HOME", self.0.join("home")).env("DPKG_ADMINDIR", self.0.join("dpkg"));
        command.env("GOODBOT_PROGRAMS", self.0.join("programs")).env("CROSS_TOOLCHAIN_MODE", "build-std");
        command
    }

    /// The conflict is a real one: here, apt would not install the emulator.
    fn must_have_refused_to_install(&self) -> Result<()> {
        let apt = self.0.join("programs/apt");
        let mut install = self.command("apt-get");
        install.args(["-o", &format!("Dir::State={}/state", apt.display()), "-o", &format!("Dir::Cache={}/cache", apt.display())]);
        install.args(["-o", &format!("Dir::State::status={}/dpkg/status", self.0.display()), "-o", "Debug::NoLocking=1"]);
        install.args(["--simulate", "--yes", "--no-remove", "--no-install-recommends", "install"]);
        let Err(error) = process::capture(install.arg("qemu-system-arm")) else {
            bail!("apt would install the emulator: the proof's machine holds nothing that conflicts");
        };
        let error = error.to_string();
        if !error.contains("held") && !error.contains("remove") {
            bail!("apt refuses for another reason than the conflict: {error}");
        }
        Ok(())
    }
}

fn is_root() -> Result<bool> {
    Ok(process::capture(Command::new("id").arg("-u"))?.trim() == "0")
}
