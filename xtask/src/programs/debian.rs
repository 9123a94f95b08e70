//! Debian's packages, unpacked into a folder: nothing is installed, and it takes no root.
//!
//! apt is given folders of its own, and a list of installed packages that is empty: so it finds everything that a program needs, whatever
//! the system has, holds back or would not go together with. A package that the system has in just that version is left out.

use std::collections::HashSet;
use std::fs::{self, File};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result, bail};

use super::folder;
use crate::process;

/// The system's own: the loader of programs must fit it, and is not taken from elsewhere.
const SYSTEM: [&str; 2] = ["libc6", "libc-bin"];

/// How a program is started from its folder.
#[derive(Debug)]
pub struct Launch {
    /// The program in the packages.
    pub file: &'static str,
    /// Lines of shell before it; `$tree` is the folder.
    pub before: &'static str,
    /// Arguments before all others.
    pub arguments: &'static str,
}

impl Launch {
    /// With nothing but the libraries.
    pub const fn plain(file: &'static str) -> Self {
        Self { file, before: "", arguments: "" }
    }
}

/// One file of a package, as apt names it.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Package {
    name: String,
    version: String,
    file: String,
    bytes: u64,
}

/// Some packages and what they need, unpacked. The folder can be moved.
#[derive(Debug)]
pub struct Tree(PathBuf);

impl Tree {
    /// The folder that has the packages, fetched and unpacked if that has not been done.
    /// `one_more` may name another, by the names of all that are needed.
    pub fn fetch(packages: &[&str], why: &str, one_more: impl Fn(&[&str]) -> Option<String>) -> Result<Self> {
        let tree = Self(folder().join(packages.first().context("no package is named")?));
        if tree.list().is_file() {
            return Ok(tree);
        }
        if process::find_program("apt-get").is_none() || process::find_program("dpkg-deb").is_none() {
            bail!("only Debian's packages can be fetched, and there is no apt-get here");
        }
        let apt = Apt::prepare()?;
        let mut needed = apt.resolve(packages)?;
        let names: Vec<_> = needed.iter().map(|package| package.name.as_str()).collect();
        if let Some(more) = one_more(&names) {
            needed = apt.resolve(&[packages, &[&more]].concat())?;
        }
        let wanted = missing(needed)?;
        let megabytes = wanted.iter().map(|package| package.bytes).sum::<u64>() / 1_000_000;
        eprintln!("fetching {}, needed {why}: {} packages, {megabytes} MB, into {}", packages.join(" "), wanted.len(), tree.0.display());
        apt.download(&wanted)?;
        tree.unpack(&apt, &wanted)?;
        Ok(tree)
    }

    /// Whether the folder that has the packages is there.
    pub fn is_fetched(packages: &[&str]) -> bool {
        packages.first().is_some_and(|name| Self(folder().join(name)).list().is_file())
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// What is in it; written last.
    fn list(&self) -> PathBuf {
        self.0.join("packages")
    }

    fn unpack(&self, apt: &Apt, packages: &[Package]) -> Result<()> {
        let unfinished = self.0.with_extension("unfinished");
        let _ = fs::remove_dir_all(&unfinished);
        fs::create_dir_all(&unfinished)?;
        for (position, package) in packages.iter().enumerate() {
            eprintln!("unpacking {} of {}: {} {}", position + 1, packages.len(), package.name, package.version);
            let file = apt.archives().join(&package.file);
            process::capture(Command::new("dpkg-deb").arg("--extract").arg(&file).arg(&unfinished))?;
            fs::remove_file(file)?;
        }
        let mut libraries = Vec::new();
        find_libraries(&unfinished, Path::new(""), &mut libraries)?;
        libraries.sort();
        fs::write(unfinished.join("libraries"), libraries.join("\n") + "\n")?;
        let _ = fs::remove_dir_all(&self.0);
        fs::rename(&unfinished, &self.0)?;
        let listed: String = packages.iter().map(|package| format!("{} {}\n", package.name, package.version)).collect();
        Ok(fs::write(self.list(), listed)?)
    }

    /// Writes a program's launcher, and returns where it is.
    pub fn launcher(&self, name: &str, launch: &Launch) -> Result<PathBuf> {
        let libraries = fs::read_to_string(self.0.join("libraries"))?;
        let libraries: Vec<_> = libraries.lines().map(|folder| format!("$tree/{folder}")).collect();
        let Launch { file, before, arguments } = launch;
        let script = format!(
            "#!/bin/sh\ntree=$(CDPATH= cd -- \"$(dirname -- \"$0\")/..\" && pwd)\n\
             export LD_LIBRARY_PATH=\"{}${{LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}}\"\n{before}exec \"$tree/{file}\" {arguments} \"$@\"\n",
            libraries.join(":")
        );
        let path = self.0.join("launch").join(name);
        if fs::read_to_string(&path).is_ok_and(|kept| kept == script) {
            return Ok(path);
        }
        fs::create_dir_all(self.0.join("launch"))?;
        fs::write(&path, script).with_context(|| format!("{} cannot be written", path.display()))?;
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755))?;
        Ok(path)
    }
}

/// The folders, relative to `root`, that have shared libraries in them.
fn find_libraries(root: &Path, below: &Path, found: &mut Vec<String>) -> Result<()> {
    let mut has = false;
    for entry in fs::read_dir(root.join(below))? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if entry.file_type()?.is_dir() {
            find_libraries(root, &below.join(&name), found)?;
        } else {
            has |= name.starts_with("lib") && (name.ends_with(".so") || name.contains(".so."));
        }
    }
    if has {
        found.push(below.to_string_lossy().into_owned());
    }
    Ok(())
}

/// apt with folders of its own. Another process that fetches into the same folder waits.
struct Apt {
    folder: PathBuf,
    _lock: File,
}

impl Apt {
    fn prepare() -> Result<Self> {
        let folder = folder().join("apt");
        for below in ["state/lists/partial", "cache/archives/partial", "archives"] {
            fs::create_dir_all(folder.join(below)).with_context(|| format!("{} cannot be made", folder.display()))?;
        }
        let lock = File::create(folder.join("lock"))?;
        lock.lock()?;
        fs::write(folder.join("status"), "")?;
        let apt = Self { folder, _lock: lock };
        static UPDATED: AtomicBool = AtomicBool::new(false);
        if !UPDATED.load(Ordering::Relaxed) {
            eprintln!("reading Debian's lists of packages");
            process::capture(apt.get().arg("update")).context("Debian's lists of packages cannot be had")?;
            UPDATED.store(true, Ordering::Relaxed);
        }
        Ok(apt)
    }

    /// Where the packages' files are.
    fn archives(&self) -> PathBuf {
        self.folder.join("archives")
    }

    fn get(&self) -> Command {
        let mut command = Command::new("apt-get");
        let folder = self.folder.display();
        command.args(["-o", &format!("Dir::State={folder}/state"), "-o", &format!("Dir::Cache={folder}/cache")]);
        command.args(["-o", &format!("Dir::State::status={folder}/status"), "-o", "Debug::NoLocking=1"]);
        command.args(["-o", "APT::Install-Recommends=0", "-o", "APT::Sandbox::User=", "-o", "Acquire::Retries=3"]);
        command.args(["-o", "Acquire::ForceHash=SHA256", "--quiet=1"]);
        command
    }

    /// The packages and all that they need.
    fn resolve(&self, packages: &[&str]) -> Result<Vec<Package>> {
        let listed = process::capture(self.get().args(["install", "--yes", "--print-uris"]).args(packages))?;
        let resolved: Vec<_> = listed.lines().filter_map(Package::read).collect();
        if resolved.len() < packages.len() {
            bail!("apt-get does not know where to get {}", packages.join(" "));
        }
        Ok(resolved)
    }

    /// Fetches the files, which apt compares with the checksums in the signed lists.
    fn download(&self, packages: &[Package]) -> Result<()> {
        let mut command = self.get();
        command.arg("download").current_dir(self.archives()).stdin(Stdio::null()).stdout(std::io::stderr());
        process::run(command.args(packages.iter().map(|package| format!("{}={}", package.name, package.version))))
    }
}

impl Package {
    /// From a line `'ADDRESS' NAME_VERSION_ARCHITECTURE.deb BYTES CHECKSUM`.
    fn read(line: &str) -> Option<Self> {
        let mut words = line.strip_prefix('\'')?.split_whitespace().skip(1);
        let file = words.next()?;
        let bytes = words.next()?.parse().ok()?;
        let mut parts = file.strip_suffix(".deb")?.split('_');
        let (name, version) = (parts.next()?.to_owned(), parts.next()?.replace("%3a", ":"));
        Some(Self { name, version, file: file.to_owned(), bytes })
    }
}

/// The packages that the system does not have in the same version.
fn missing(mut packages: Vec<Package>) -> Result<Vec<Package>> {
    let mut query = Command::new("dpkg-query");
    let installed = process::capture(query.args(["--show", "--showformat=${db:Status-Status} ${Package} ${Version}\\n"]))?;
    let installed: HashSet<_> = installed.lines().filter_map(|line| line.strip_prefix("installed ")).collect();
    packages.retain(|Package { name, version, .. }| {
        !SYSTEM.contains(&name.as_str()) && !installed.contains(format!("{name} {version}").as_str())
    });
    Ok(packages)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_package_is_read_from_apts_line() {
        let line = "'http://mirror/pool/q/qemu-system-arm_7.2%2bdfsg_amd64.deb' qemu-system-arm_1%3a7.2+dfsg_amd64.deb 8909200 SHA256:12";
        let package = Package::read(line).unwrap();
        assert_eq!((package.name.as_str(), package.version.as_str(), package.bytes), ("qemu-system-arm", "1:7.2+dfsg", 8_909_200));
        assert_eq!(package.file, "qemu-system-arm_1%3a7.2+dfsg_amd64.deb");
        assert_eq!(Package::read("Reading package lists..."), None);
    }
}
