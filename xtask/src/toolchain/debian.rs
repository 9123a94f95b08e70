//! Debian's packages.

use std::process::Command;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result, bail};

use super::say;
use crate::process;

/// Installs those of the packages that are missing, and says so. `why` goes on
/// after "needed", as in "needed to run the firmware".
pub fn apt_install(packages: &[&str], why: &str) -> Result<()> {
    let missing: Vec<&str> = packages.iter().copied().filter(|package| !are_installed(&[package])).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let names = missing.join(" ");
    if process::find_program("apt-get").is_none() {
        bail!(
            "needed {why}: {names}. There is no apt-get here. On Debian, the command is \
             `apt-get install --no-install-recommends {names}`; elsewhere, install what has \
             the same programs"
        );
    }
    say(&format!("installing Debian packages, needed {why}: {names}"));
    update().with_context(|| by_hand(&names))?;
    let mut install = apt_get()?;
    // Nothing that is installed is taken away to make room for these.
    install.args(["install", "--yes", "--no-install-recommends", "--no-remove"]).args(&missing);
    process::run(quiet(&mut install)).with_context(|| by_hand(&names))
}

/// Makes sure that a program is on the `PATH`: from the packages, if it is not.
#[allow(dead_code)]
pub fn need_program(program: &str, packages: &[&str], why: &str) -> Result<()> {
    if process::find_program(program).is_some() {
        return Ok(());
    }
    apt_install(packages, why)?;
    if process::find_program(program).is_none() {
        bail!("`{program}`, needed {why}, is not on the PATH, though {} is installed", packages.join(" "));
    }
    Ok(())
}

/// Whether dpkg has all the packages installed.
pub fn are_installed(packages: &[&str]) -> bool {
    let mut query = Command::new("dpkg-query");
    query.args(["--show", "--showformat=${db:Status-Status}\\n"]).args(packages);
    process::capture(&mut query).is_ok_and(|list| list.lines().count() == packages.len() && list.lines().all(|line| line == "installed"))
}

/// Gets the list of packages, once in a run of this program.
fn update() -> Result<()> {
    static DONE: AtomicBool = AtomicBool::new(false);
    if DONE.swap(true, Ordering::Relaxed) {
        return Ok(());
    }
    let mut update = apt_get()?;
    process::run(quiet(update.arg("update")))
}

/// `apt-get` as root, which asks nothing and waits its turn.
fn apt_get() -> Result<Command> {
    let user = process::capture(Command::new("id").arg("-u"))?;
    let mut command = if user.trim() == "0" {
        Command::new("env")
    } else if process::find_program("sudo").is_some() {
        let mut sudo = Command::new("sudo");
        sudo.arg("env");
        sudo
    } else {
        bail!("this takes root, and there is no sudo here");
    };
    command.args(["DEBIAN_FRONTEND=noninteractive", "apt-get"]);
    command.args(["--option", "DPkg::Lock::Timeout=300"]);
    command.args(["--option", "Dpkg::Use-Pty=0"]);
    Ok(command)
}

/// Less to read, and all of it on standard error.
fn quiet(command: &mut Command) -> &mut Command {
    command.arg("--quiet").stdout(std::io::stderr()).stdin(std::process::Stdio::null())
}

fn by_hand(names: &str) -> String {
    format!(
        "these Debian packages could not be installed: {names}. By hand: \
         `apt-get update && apt-get install --no-install-recommends {names}`"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_package_that_does_not_exist_is_not_installed() {
        assert!(!are_installed(&["no-such-package-here"]));
        if process::find_program("dpkg-query").is_some() {
            assert!(are_installed(&["dpkg"]));
            assert!(!are_installed(&["dpkg", "no-such-package-here"]));
        }
    }

    #[test]
    fn nothing_is_done_for_what_is_there() {
        apt_install(&[], "for nothing").unwrap();
        need_program("cargo", &["no-such-package-here"], "for nothing").unwrap();
    }
}
