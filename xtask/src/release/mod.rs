//! The packages of a release, as their users get them, in `dist/release`. Nothing is uploaded.

mod archive;
mod boards;
mod book;
mod debian;
mod npm;
mod try_out;

pub use npm::make_and_try;

use crate::capi::{ALL_FEATURES, FEATURES, headers_beside, library};
use crate::process::{described, folder_named_by, packages, root, shell, target_dir};
use crate::programs::{installed_by_cargo, on_path, python_with};
use crate::toolchain::{TARGETS, WASM};
use anyhow::{Context, Result};
use archive::{Texts, files, pack, unpack};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use xshell::{Shell, cmd};

/// Where the packages go.
const FOLDER: &str = "dist/release";
const CHECKSUMS: &str = "SHA256SUMS";

/// One kind of package.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Package {
    /// the crates, each built from its packed file
    Crates,
    /// the command line for this machine, with its manual and its completions; for Linux also as Debian's package, where `dpkg-deb` is
    Program,
    /// the C library for this machine and for each processor, for CMake and pkg-config
    C,
    /// the C library for Arduino, PlatformIO, ESP-IDF and Zephyr
    Boards,
    /// a wheel for this machine, and the sources, for Python
    Python,
    /// the trainer page
    Page,
    /// the robot for JavaScript, with types, and the page by `npx goodbot`
    Npm,
    /// the file for a micro:bit
    Microbit,
    /// the documents as web pages
    Guide,
    /// what the command line, the wheel, the C library and the module for JavaScript are made of, in CycloneDX's form
    Materials,
}

/// Which packages to make.
#[derive(Args)]
pub struct Options {
    /// Makes this package only; can be given more than once
    #[arg(long, value_name = "PACKAGE")]
    only: Vec<Package>,
    /// Builds the command line for this target, such as x86_64-unknown-linux-musl, after `rustup target add`
    #[arg(long)]
    target: Option<String>,
    /// Makes nothing: installs what is in dist/release by its own tools, each in an empty folder, and uses it
    #[arg(long)]
    try_out: bool,
}

impl Options {
    /// The chosen packages: all, where none was named.
    fn packages(&self) -> impl Iterator<Item = Package> {
        Package::value_variants().iter().copied().filter(|package| self.only.is_empty() || self.only.contains(package))
    }
}

/// Makes the packages, and the list of their checksums.
pub fn run(options: &Options) -> Result<()> {
    let (sh, to) = (shell()?, root().join(FOLDER));
    if options.try_out {
        return try_out::run(&sh, &to, options.packages());
    }
    sh.create_dir(&to)?;
    let texts = Texts::new(&sh)?;
    if texts.text("@REPOSITORY@").is_empty() {
        eprintln!("remark: `[workspace.package]` names no `repository`; registries ask for its address, so set it before you upload");
    }
    // The day of what was released, not of the build.
    sh.set_var("SOURCE_DATE_EPOCH", cmd!(sh, "git log -1 --format=%ct").quiet().read()?);
    for package in options.packages() {
        let (name, about) = described(package);
        println!("\n== {name}: {about}");
        package.make(&sh, &texts, &to, options.target.as_deref())?;
    }
    checksums(&sh, &to)
}

impl Package {
    fn make(self, sh: &Shell, texts: &Texts, to: &Path, target: Option<&str>) -> Result<()> {
        match self {
            Self::Crates => crates(sh, texts, to),
            Self::Program => program(sh, texts, to, target),
            Self::C => c(sh, texts, to),
            Self::Boards => {
                let above = sh.create_temp_dir()?;
                let folder = boards::make(sh, above.path())?;
                pack(sh, &folder, &to.join(format!("goodbot-boards-{}.zip", texts.text("@VERSION@"))))
            }
            Self::Python => python(sh, to),
            Self::Page => {
                crate::page::build()?;
                Ok(sh.copy_file("dist/goodbot.html", to)?)
            }
            Self::Npm => {
                crate::page::build()?;
                npm::make(sh, texts, to).map(drop)
            }
            Self::Microbit => Ok(sh.copy_file(crate::firmware::deliver()?, to)?),
            Self::Guide => book::make(sh, texts, to),
            Self::Materials => materials(sh, to),
        }
    }
}

/// Those that are public. Cargo packs what is committed, and builds each from its packed file.
fn crates(sh: &Shell, texts: &Texts, to: &Path) -> Result<()> {
    let packages = packages(sh, "Cargo.toml")?;
    let public: Vec<&str> =
        packages.iter().filter(|package| package["publish"].is_null()).filter_map(|package| package["name"].as_str()).collect();
    let named = public.iter().flat_map(|name| ["--package", name]);
    cmd!(sh, "cargo package --quiet --locked").args(named).run()?;
    for name in public {
        sh.copy_file(target_dir().join("package").join(format!("{name}-{}.crate", texts.text("@VERSION@"))), to)?;
    }
    Ok(())
}

/// With its manual page and completions, which the program of this machine prints.
fn program(sh: &Shell, texts: &Texts, to: &Path, target: Option<&str>) -> Result<()> {
    let name = format!("goodbot{}", std::env::consts::EXE_SUFFIX);
    let build = cmd!(sh, "cargo build --quiet --locked --profile dist --package goodbot-cli").env("RUSTFLAGS", without_places()?);
    build.args(target.iter().flat_map(|target| ["--target", target])).run()?;
    let built = target_dir().join(target.unwrap_or_default()).join("dist").join(name);
    let above = sh.create_temp_dir()?;
    let machine = target.map_or_else(|| this_machine(sh), |target| Ok(target.to_owned()))?;
    let folder = above.path().join(format!("goodbot-{}-{machine}", texts.text("@VERSION@")));
    let bin = sh.create_dir(folder.join("bin"))?;
    sh.copy_file(&built, bin)?;
    sh.write_file(folder.join("share/man/man1/goodbot.1"), cmd!(sh, "{built} man").quiet().read()?)?;
    let places = [
        ("bash", "bash-completion/completions/goodbot"),
        ("zsh", "zsh/site-functions/_goodbot"),
        ("fish", "fish/vendor_completions.d/goodbot.fish"),
    ];
    for (name, place) in places {
        sh.write_file(folder.join("share").join(place), cmd!(sh, "{built} completions {name}").quiet().read()?)?;
    }
    sh.copy_file("README.md", &folder)?;
    licences(sh, &folder)?;
    if machine.contains("linux") && on_path("dpkg-deb").is_some() {
        debian::make(sh, texts, &folder, &machine, to)?;
    }
    pack(sh, &folder, &to.join(name_of(&folder)?))
}

/// The pages that the C header names.
const PAGES: [&str; 3] = ["docs/footprint.md", "docs/robot.md", "docs/talk.md"];

fn c(sh: &Shell, texts: &Texts, to: &Path) -> Result<()> {
    let mut targets = std::iter::once(None).chain(TARGETS.into_iter().filter(|target| *target != WASM).map(Some));
    targets.try_for_each(|target| c_archive(sh, texts, target, to).map(drop))
}

/// The C library for one target, in the folder where its user has unpacked the package.
pub fn unpacked_c(sh: &Shell, target: Option<&str>, folder: &Path) -> Result<()> {
    let to = sh.create_temp_dir()?;
    unpack(&c_archive(sh, &Texts::new(sh)?, target, to.path())?, folder)
}

/// The C library for one target, packed: CMake and pkg-config find it.
fn c_archive(sh: &Shell, texts: &Texts, target: Option<&str>, to: &Path) -> Result<PathBuf> {
    let above = sh.create_temp_dir()?;
    let machine = target.map_or_else(|| this_machine(sh), |target| Ok(target.to_owned()))?;
    let folder = above.path().join(format!("goodbot-c-{}-{machine}", texts.text("@VERSION@")));
    let (include, lib) = (sh.create_dir(folder.join("include"))?, sh.create_dir(folder.join("lib"))?);
    // A computer has room for talk.
    let features: &[&str] = if target.is_some() { FEATURES } else { &ALL_FEATURES };
    headers_beside(sh, features, &include)?;
    sh.copy_file(library(target, features)?, lib.join("libgoodbot.a"))?;
    let sources = Path::new("capi/packages/archive");
    for file in ["goodbotConfig.cmake", "goodbotConfigVersion.cmake"] {
        texts.copy(sh, &sources.join(file), &lib.join("cmake/goodbot").join(file))?;
    }
    texts.copy(sh, &sources.join("goodbot.pc"), &lib.join("pkgconfig/goodbot.pc"))?;
    let docs = sh.create_dir(folder.join("docs"))?;
    PAGES.iter().try_for_each(|page| sh.copy_file(page, &docs))?;
    texts.copy_all(sh, Path::new("capi/examples"), &folder.join("examples"))?;
    licences(sh, &folder)?;
    let packed = to.join(name_of(&folder)?);
    pack(sh, &folder, &packed)?;
    Ok(packed)
}

/// The oldest Linux that the wheel runs on, by its C library: that of 2014. Zig links with it.
const MANYLINUX: &str = "manylinux_2_17";

fn python(sh: &Shell, to: &Path) -> Result<()> {
    let programs = python_with("--requirement=python/release.txt", "python-release")?;
    let built = target_dir().join("python-release/built");
    sh.remove_path(&built)?;
    let is_linux = cfg!(target_os = "linux");
    {
        let _folder = sh.push_dir("python");
        let target = target_dir();
        // Apart: the sources have fewer crates than the lock file names.
        cmd!(sh, "{programs}/maturin sdist --out {built}").run()?;
        let build = cmd!(sh, "{programs}/maturin build --quiet --locked --out {built} --interpreter {programs}/python");
        let build = build.args(["--zig", "--compatibility", MANYLINUX].iter().filter(|_| is_linux));
        // Maturin looks for zig where Python's programs are.
        let path = std::env::var_os("PATH").unwrap_or_default();
        let places = std::iter::once(programs.clone()).chain(std::env::split_paths(&path));
        build.env("PATH", std::env::join_paths(places)?).env("CARGO_TARGET_DIR", target).env("RUSTFLAGS", without_places()?).run()?;
    }
    let packages = sh.read_dir(&built)?;
    cmd!(sh, "{programs}/twine check --strict").args(&packages).run()?;
    packages.iter().try_for_each(|package| Ok(sh.copy_file(package, to)?))
}

/// What is shipped, and the crate that it is built of.
const SHIPPED: [(&str, &str); 4] = [("goodbot", "host-cli"), ("goodbot-python", "python"), ("goodbot-c", "capi"), ("goodbot-npm", "wasm")];

/// In a copy, because the lists are written beside the manifests.
fn materials(sh: &Shell, to: &Path) -> Result<()> {
    let path = installed_by_cargo(sh, "cargo-cyclonedx")?;
    let copy = sh.create_temp_dir()?;
    let sources = copy.path().join("goodbot.tar");
    cmd!(sh, "git archive --output {sources} HEAD").run()?;
    let _folder = sh.push_dir(copy.path());
    cmd!(sh, "tar --extract --file goodbot.tar").run()?;
    for (name, folder) in SHIPPED {
        let list = cmd!(sh, "{path} cyclonedx --quiet --format json --override-filename {name}.cdx --manifest-path {folder}/Cargo.toml");
        list.env("CARGO_TARGET_DIR", target_dir()).run()?;
        let file = format!("{name}.cdx.json");
        let list = sh.read_file(Path::new(folder).join(&file))?;
        // It names each crate of the workspace by its folder.
        sh.write_file(to.join(file), list.replace(&*copy.path().to_string_lossy(), "/goodbot"))?;
    }
    Ok(())
}

/// Lists every package's SHA-256, as `sha256sum --check` reads it.
fn checksums(sh: &Shell, to: &Path) -> Result<()> {
    let _folder = sh.push_dir(to);
    let names: Vec<String> =
        files(sh, to)?.iter().map(|file| file.file_name().unwrap_or_default().to_string_lossy().into_owned()).collect();
    let packages = names.iter().filter(|name| *name != CHECKSUMS);
    // macOS has the one, and Linux and Windows' bash the other.
    let has_sha256sum = cmd!(sh, "sha256sum --version").ignore_stdout().ignore_stderr().quiet().run().is_ok();
    let sum = if has_sha256sum { cmd!(sh, "sha256sum") } else { cmd!(sh, "shasum --algorithm 256") };
    let sums = sum.args(packages).quiet().read()? + "\n";
    println!("\n{sums}");
    sh.write_file(CHECKSUMS, sums)?;
    println!("written: {FOLDER}");
    Ok(())
}

/// Flags by which what is built does not name folders of this machine: then it has the same bytes on another.
fn without_places() -> Result<String> {
    let home = std::env::var_os("HOME").map_or_else(PathBuf::new, PathBuf::from).join(".cargo");
    let home = folder_named_by("CARGO_HOME").unwrap_or(home);
    let registry = home.join("registry/src");
    // Below it each registry has a folder, whose name is a number of its address.
    let folders = shell()?.read_dir(&registry).unwrap_or_default();
    let places = folders.iter().map(|folder| (folder.as_path(), "/crates")).chain([(root(), "/goodbot")]);
    Ok(places.map(|(place, name)| format!("--remap-path-prefix={}={name}", place.display())).collect::<Vec<_>>().join(" "))
}

/// The target that programs for this machine are built for.
fn this_machine(sh: &Shell) -> Result<String> {
    let about = cmd!(sh, "rustc -vV").quiet().read()?;
    Ok(about.lines().find_map(|line| line.strip_prefix("host: ")).context("`rustc -vV` names no host")?.to_owned())
}

fn licences(sh: &Shell, folder: &Path) -> Result<()> {
    ["LICENSE-APACHE", "LICENSE-MIT"].into_iter().try_for_each(|file| Ok(sh.copy_file(file, folder)?))
}

/// The name of the packed folder.
fn name_of(folder: &Path) -> Result<String> {
    Ok(format!("{}.zip", folder.file_name().context("a folder has a name")?.to_string_lossy()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pages_that_the_header_names_are_packed_with_it() {
        let header = shell().unwrap().read_file(crate::capi::HEADERS[0]).unwrap();
        let names = header.split(|c: char| c.is_whitespace() || "`,()".contains(c));
        let named: std::collections::BTreeSet<_> = names.filter(|name| name.starts_with("docs/")).collect();
        assert!(named.into_iter().eq(PAGES));
    }
}
