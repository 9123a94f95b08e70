//! The programs that the commands use beside cargo: found on this machine, or fetched into a folder of the project's own.
//!
//! Nothing is installed. A program that the machine has is used if it runs. Else Debian's packages are fetched and unpacked below
//! [`folder`], where each program has a launcher that says where its libraries are.

pub mod debian;
pub mod npm;

use std::collections::HashMap;
use std::fmt;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;

use anyhow::{Context, Result, anyhow};

use crate::{process, project, toolchain};
use debian::{Launch, Tree};

/// The variable that names another folder for what is fetched, such as one that several working copies share.
const FOLDER: &str = "GOODBOT_PROGRAMS";

/// A program that some command needs.
#[derive(Debug)]
pub struct Program {
    /// The file that is looked for on the `PATH`.
    pub name: &'static str,
    /// What goes on after "needed".
    why: &'static str,
    /// Debian's packages that have it; none where it is not fetched.
    packages: &'static [&'static str],
    launch: Launch,
}

pub const QEMU: Program = Program {
    name: "qemu-system-arm",
    why: "to run the firmware",
    packages: &["qemu-system-arm"],
    launch: Launch { file: "usr/bin/qemu-system-arm", before: "", arguments: "-L \"$tree/usr/share/qemu\"" },
};

// Where a browser finds the fonts; the folders in the packages' own list are the system's.
const FONTS: &str = "\
export FONTCONFIG_FILE=\"$tree/fonts.conf\"
echo \"<fontconfig><dir>$tree/usr/share/fonts</dir><dir>/usr/share/fonts</dir><cachedir>$tree/fonts</cachedir></fontconfig>\" > \"$FONTCONFIG_FILE\"
";

/// Chromium without windows: the whole browser takes more than twice the work for the same tests.
pub const CHROMIUM: Program = Program {
    name: "chromium-headless-shell",
    why: "to try the page",
    packages: &["chromium-headless-shell", "fonts-dejavu-core"],
    launch: Launch { file: "usr/lib/chromium/chromium-headless-shell", before: FONTS, arguments: "" },
};

pub const FIREFOX: Program = Program {
    name: "firefox-esr",
    why: "to try the page in a second browser",
    packages: &["firefox-esr", "fonts-dejavu-core"],
    launch: Launch { file: "usr/lib/firefox-esr/firefox-esr", before: FONTS, arguments: "" },
};

const fn arm(name: &'static str, file: &'static str) -> Program {
    Program {
        name,
        why: "to build C for a controller and to look into the firmware",
        packages: &["gcc-arm-none-eabi", "libnewlib-arm-none-eabi"],
        launch: Launch {
            file,
            // Where gcc looks for newlib in a folder that was moved.
            before: "\
ln -sfn newlib \"$tree/usr/lib/arm-none-eabi/lib\"
ln -sfn ../../include/newlib \"$tree/usr/lib/arm-none-eabi/include\"
",
            arguments: "",
        },
    }
}

pub const ARM_GCC: Program = arm("arm-none-eabi-gcc", "usr/bin/arm-none-eabi-gcc");
pub const ARM_SIZE: Program = arm("arm-none-eabi-size", "usr/bin/arm-none-eabi-size");
pub const ARM_NM: Program = arm("arm-none-eabi-nm", "usr/bin/arm-none-eabi-nm");

/// A program that is not fetched.
const fn installed(name: &'static str, why: &'static str) -> Program {
    Program { name, why, packages: &[], launch: Launch::plain("") }
}

pub const NODE: Program = installed("node", "to make the page and to run WebAssembly (version 20 or newer)");
pub const NPM: Program = installed("npm", "to get what the page's tests are made with");
pub const GCC: Program = installed("gcc", "to build C for this machine");
pub const PYTHON: Program = installed("python3", "to try the Python package (version 3.10 or newer, with venv)");
pub const VALGRIND: Program = installed("valgrind", "to count instructions");

/// All that can be fetched, but for the compiler of other targets.
pub const FETCHED: [&Program; 6] = [&QEMU, &ARM_GCC, &ARM_SIZE, &ARM_NM, &CHROMIUM, &FIREFOX];

/// Something that is neither here nor to be had.
#[derive(Clone, Debug)]
pub struct Missing(pub String);

impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Missing {}

/// Says of an error that it comes from what is not on this machine.
pub fn missing(what: &str, why: &str, error: &anyhow::Error) -> Missing {
    Missing(format!("{what}, needed {why}: {error:#}"))
}

/// The folder for what is fetched.
pub fn folder() -> PathBuf {
    match std::env::var_os(FOLDER) {
        Some(folder) if !folder.is_empty() => std::path::absolute(&folder).unwrap_or_else(|_| folder.into()),
        _ => project::target_dir().join("programs"),
    }
}

impl Program {
    /// A command that starts the program, with no arguments yet.
    pub fn command(&self) -> Result<Command> {
        Ok(Command::new(self.path()?))
    }

    /// Where the program is, fetched if it has to be, after it has shown that it runs. An error is a [`Missing`].
    pub fn path(&self) -> Result<PathBuf> {
        // What could not be had is not asked for again in the same run.
        static FOUND: Mutex<Option<HashMap<&'static str, Result<PathBuf, Missing>>>> = Mutex::new(None);
        let mut found = FOUND.lock().map_err(|_| anyhow!("another search for a program failed"))?;
        let found = found.get_or_insert_default().entry(self.name).or_insert_with(|| self.find());
        Ok(found.clone()?)
    }

    fn find(&self) -> Result<PathBuf, Missing> {
        let installed = process::find_program(self.name).filter(|path| self.version(path).is_ok());
        installed.map_or_else(|| self.fetch().map_err(|error| missing(self.name, self.why, &error)), Ok)
    }

    /// The first line that the program says of itself.
    pub fn version(&self, path: &Path) -> Result<String> {
        let said = process::capture(Command::new(path).arg("--version"))?;
        Ok(said.lines().next().unwrap_or_default().trim().to_owned())
    }

    fn fetch(&self) -> Result<PathBuf> {
        if self.packages.is_empty() {
            return Err(anyhow!("not on the PATH, and not fetched; install it"));
        }
        let tree = Tree::fetch(self.packages, self.why, |_| None).with_context(|| format!("install a package that has `{}`", self.name))?;
        let path = tree.launcher(self.name, &self.launch)?;
        self.version(&path).with_context(|| format!("what was fetched into {} does not run here", tree.path().display()))?;
        Ok(path)
    }
}

/// Finds or fetches everything, and prints where it is.
pub fn list() -> Result<()> {
    for program in FETCHED.into_iter().chain([&NODE, &NPM, &GCC]) {
        let path = program.path()?;
        println!("{}: {}", path.display(), program.version(&path)?);
    }
    toolchain::setup()
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
