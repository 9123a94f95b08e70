//! The programs that the commands use besides cargo: found on this machine, or fetched into a folder of the project.
//!
//! Nothing is installed. A program on the `PATH` is used if it runs. Otherwise `fetch.sh` fetches Debian's packages and unpacks them below
//! `target/programs`, or below the folder that `GOODBOT_PROGRAMS` names.

use std::collections::HashMap;
use std::env::consts::EXE_SUFFIX;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use anyhow::{Context, Result, anyhow, ensure};
use xshell::{Shell, cmd};

use crate::process::{folder_named_by, root, shell, target_dir};

/// A program that a command needs.
#[derive(Debug)]
pub struct Program {
    /// The name of its file, searched on the `PATH`.
    pub name: &'static str,
    /// The purpose, worded to follow "needed".
    pub why: &'static str,
    /// The folder of the file in Debian's packages.
    folder: &'static str,
    /// Debian's packages that have it; empty if it is not fetched.
    packages: &'static [&'static str],
}

pub const QEMU: Program = Program { packages: &["qemu-system-arm"], ..installed("qemu-system-arm", "to run the firmware") };
pub const QEMU_RISCV: Program =
    Program { packages: &["qemu-system-misc"], ..installed("qemu-system-riscv32", "to run the firmware on RISC-V") };

/// Chromium without windows: the whole browser needs more than twice the work for the same tests.
pub const CHROMIUM: Program = Program {
    packages: &["chromium-headless-shell", "fonts-dejavu-core"],
    folder: "usr/lib/chromium",
    ..installed("chromium-headless-shell", "to try the page")
};

pub const FIREFOX: Program = Program {
    packages: &["firefox-esr", "fonts-dejavu-core"],
    folder: "usr/lib/firefox-esr",
    ..installed("firefox-esr", "to try the page in a second browser")
};

pub const ARM_GCC: Program = Program {
    packages: &["gcc-arm-none-eabi", "libnewlib-arm-none-eabi"],
    ..installed("arm-none-eabi-gcc", "to build C for a controller")
};

/// A second compiler for the header: its enums for ARM have four bytes unless they are told to be short.
pub const CLANG: Program = Program { packages: &["clang"], ..installed("clang", "to check the C header by a second compiler") };

/// A Rust compiler with the standard library's sources.
pub const RUSTC: Program = Program {
    packages: &["rustc-web", "cargo-web", "rust-web-src"],
    ..installed("rustc", "to build for microcontrollers and the browser")
};
pub const CARGO: Program = Program { name: "cargo", ..RUSTC };

/// A program that is not fetched.
const fn installed(name: &'static str, why: &'static str) -> Program {
    Program { name, why, folder: "usr/bin", packages: &[] }
}

pub const NODE: Program = installed("node", "to make the page and to run WebAssembly (version 20 or newer)");
pub const NPM: Program = installed("npm", "to get what the page's tests are made with");
pub const GCC: Program = installed("gcc", "to build C for this machine");
pub const GXX: Program = installed("g++", "to build C++ for this machine");
const PYTHON: Program = installed("python3", "to try the Python package (version 3.10 or newer, with venv)");

/// Names something that is not on this machine and cannot be fetched.
#[derive(Clone, Debug)]
pub struct Missing(pub String);

impl std::fmt::Display for Missing {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Missing {}

/// An error because something is not on this machine.
pub fn missing(what: &str, why: &str, error: impl Into<anyhow::Error>) -> Missing {
    Missing(format!("{what}, needed {why}: {:#}", error.into()))
}

impl Program {
    /// The program's path. The program is fetched if necessary, and checked to run. An error is a [`Missing`].
    pub fn path(&self) -> Result<PathBuf> {
        // A program that could not be fetched is not tried again in the same run.
        static FOUND: Mutex<Option<HashMap<&'static str, Result<PathBuf, Missing>>>> = Mutex::new(None);
        let mut found = FOUND.lock().map_err(|_| anyhow!("another search for a program failed"))?;
        let find = || match on_path(self.name).filter(|path| version(path).is_ok()) {
            Some(path) => Ok(path),
            None => self.fetch(),
        };
        let found = found.get_or_insert_default().entry(self.name);
        Ok(found.or_insert_with(|| find().map_err(|error| missing(self.name, self.why, error))).clone()?)
    }

    /// The folder of its unpacked packages.
    pub fn tree(&self) -> PathBuf {
        programs().join(self.packages.first().unwrap_or(&self.name))
    }

    /// Whether its packages have been fetched.
    pub fn is_fetched(&self) -> bool {
        self.tree().join("packages").is_file()
    }

    /// Fetches its packages if necessary. Returns the path of its launcher.
    pub fn fetch(&self) -> Result<PathBuf> {
        let (sh, tree, &Self { name, why, folder, packages }) = (shell()?, self.tree(), self);
        ensure!(!packages.is_empty(), "not on the PATH, and not fetched; install it");
        let launcher = tree.join("launch").join(name);
        // Steps in a parallel process fetch into the same folders.
        let lock = sh.create_dir(tree.parent().unwrap_or(&tree))?.join("lock");
        let lock = File::create(lock)?;
        lock.lock()?;
        if !self.is_fetched() || !launcher.is_file() {
            let cannot = "only Debian's packages can be fetched, and there is no apt-get here";
            ensure!(on_path("apt-get").is_some(), "install a package that has `{name}`: {cannot}");
            let fetch = cmd!(sh, "sh -eus -- {tree} {folder}/{name} {why} {packages...}").stdin(include_str!("fetch.sh"));
            fetch.quiet().run().with_context(|| format!("install a package that has `{name}`"))?;
        }
        version(&launcher).with_context(|| format!("what was fetched into {} does not run here", tree.display()))?;
        Ok(launcher)
    }
}

/// The folder of all fetched or built programs. It can be moved.
pub fn programs() -> PathBuf {
    folder_named_by("GOODBOT_PROGRAMS").unwrap_or_else(|| target_dir().join("programs"))
}

/// The path of a program that cargo installs, if it is on the `PATH` or in the folder of programs.
pub fn built_by_cargo(program: &str) -> Option<PathBuf> {
    on_path(program).or_else(|| Some(programs().join(program).join("bin").join(program)).filter(|path| path.is_file()))
}

/// A program that cargo installs, on the `PATH` or among those that were fetched.
pub fn installed_by_cargo(sh: &Shell, program: &str) -> Result<PathBuf> {
    let place = programs().join(program);
    if built_by_cargo(program).is_none() {
        cmd!(sh, "cargo install --quiet --locked --root {place} {program}").run()?;
    }
    built_by_cargo(program).with_context(|| format!("cargo installed no {program}"))
}

/// The path of a program on the `PATH`, if it is there.
pub fn on_path(name: &str) -> Option<PathBuf> {
    std::env::split_paths(&std::env::var_os("PATH")?).map(|folder| folder.join(format!("{name}{EXE_SUFFIX}"))).find(|file| file.is_file())
}

/// The first line of a program's `--version`.
pub fn version(path: &Path) -> Result<String> {
    let sh = shell()?;
    Ok(cmd!(sh, "{path} --version").ignore_stderr().read()?.lines().next().unwrap_or_default().trim().to_owned())
}

/// Finds or fetches the programs other than Python. Prints paths and versions.
pub fn list() -> Result<()> {
    for program in [&QEMU, &QEMU_RISCV, &ARM_GCC, &CLANG, &CHROMIUM, &FIREFOX, &NODE, &NPM, &GCC, &GXX] {
        let path = program.path()?;
        println!("{}: {}", path.display(), version(&path)?);
    }
    Ok(())
}

/// Installs the npm packages of the page's `package-lock.json`, if its files have changed since the last time.
pub fn npm_packages() -> Result<()> {
    let (sh, page, npm, _) = (shell()?, root().join("page"), NPM.path()?, NODE.path()?);
    sh.change_dir(&page);
    let changed = |file: &str| page.join(file).metadata().and_then(|about| about.modified()).ok();
    if changed("node_modules/.package-lock.json") < changed("package.json").max(changed("package-lock.json")) {
        let install = cmd!(sh, "{npm} ci --no-audit --no-fund").run();
        install.map_err(|error| missing("npm's packages", "to make the page and to try it", error))?;
    }
    Ok(())
}

/// The path of a Python that can make virtual environments.
pub fn python3() -> Result<PathBuf> {
    let (sh, python) = (shell()?, PYTHON.path()?);
    cmd!(sh, "{python} -c 'import ensurepip, sys, venv; sys.exit(sys.version_info < (3, 10))'").quiet().run().map_err(|error| {
        missing(PYTHON.name, "in version 3.10 or newer, with the modules venv and ensurepip (Debian's python3-venv)", error)
    })?;
    Ok(python)
}

/// The folder of the programs in a Python virtual environment.
pub const VENV: &str = if cfg!(windows) { "Scripts" } else { "bin" };

/// The folder of the programs of a Python virtual environment with these packages, below the build folder.
pub fn python_with(packages: &str, name: &str) -> Result<PathBuf> {
    let (sh, python, folder) = (shell()?, python3()?, target_dir().join(name));
    let programs = folder.join(VENV);
    if !programs.join(format!("pip{EXE_SUFFIX}")).is_file() {
        cmd!(sh, "{python} -m venv {folder}").run()?;
    }
    let install = cmd!(sh, "{programs}/python -m pip install --quiet --disable-pip-version-check --no-compile {packages}").run();
    install.map_err(|error| missing(PYTHON.name, &format!("with {packages}"), error))?;
    Ok(programs)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_that_cannot_be_had_is_missing_and_says_what_to_do() {
        let error = installed("no-such-program-here", "for nothing").path().unwrap_err();
        assert!(error.is::<Missing>());
        assert_eq!(error.to_string(), "no-such-program-here, needed for nothing: not on the PATH, and not fetched; install it");
    }
}
