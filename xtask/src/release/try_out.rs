//! What is in `dist/release`, installed by its own tools into empty folders, and used there.

use super::archive::{Texts, files};
use super::{FOLDER, Package, archive, npm, this_machine};
use crate::checks::step::Run;
use crate::process::{described, root, shell, target_dir};
use crate::programs::{CHROMIUM, GCC, GXX, NODE, VENV, npm_packages, on_path, python_with, python3};
use anyhow::{Context, Result, ensure};
use std::fs::File;
use std::path::{Path, PathBuf};
use xshell::{Shell, cmd};
use zip::ZipArchive;

/// Tries the chosen kinds of package that have a tool to install them.
pub fn run(sh: &Shell, from: &Path, packages: impl Iterator<Item = Package>) -> Result<()> {
    for package in packages {
        let above = sh.create_temp_dir()?;
        let _folder = sh.push_dir(above.path());
        let tried = match package {
            Package::Crates => library(sh, &the_one(sh, from, "goodbot-", ".crate")?),
            Package::Program => program(sh, from),
            Package::C => try_out(&c_library(sh, from)?),
            Package::Boards => {
                unpack(&the_one(sh, from, "goodbot-boards-", ".zip")?, above.path())?;
                try_out_boards(&above.path().join("goodbot"), &c_library(sh, from)?)
            }
            Package::Python => wheel(sh, &the_one(sh, from, "goodbot-", ".whl")?),
            Package::Npm => npm_packages().and_then(|()| npm::try_out(sh, &the_one(sh, from, "goodbot-", ".tgz")?, &mut Run::default())),
            Package::Guide => guide(sh, &the_one(sh, from, "goodbot-guide-", ".zip")?),
            // The page and the micro:bit's file are tried by the steps of their names of `cargo xtask test`.
            Package::Page | Package::Microbit | Package::Materials => continue,
        };
        let name = described(package).0;
        tried.with_context(|| format!("the package {name}, as its users have it"))?;
        println!("installed and used: {name}");
    }
    Ok(())
}

/// The package of this name. A number follows the beginning, where another package's name goes on by a letter.
fn the_one(sh: &Shell, from: &Path, beginning: &str, end: &str) -> Result<PathBuf> {
    let is_named = |file: &PathBuf| {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        name.ends_with(end) && name.strip_prefix(beginning).is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
    };
    let found: Vec<_> = sh.read_dir(from).unwrap_or_default().into_iter().filter(is_named).collect();
    ensure!(found.len() == 1, "{FOLDER} has {} packages `{beginning}VERSION{end}`; make one with `cargo xtask release`", found.len());
    Ok(found.into_iter().next().unwrap_or_default())
}

/// The library, as a dependency in an empty folder: its first example is a program there.
fn library(sh: &Shell, package: &Path) -> Result<()> {
    cmd!(sh, "tar --extract --gzip --file {package}").run()?;
    let folder = package.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let about = sh.read_file(Path::new(&folder).join("src/lib.rs"))?;
    let lines = about.lines().map_while(|line| line.strip_prefix("//!")).map(|line| line.strip_prefix(' ').unwrap_or(line));
    let example: Vec<_> = lines.skip_while(|line| *line != "```").skip(1).take_while(|line| *line != "```").collect();
    let example = example.iter().map(|line| line.strip_prefix("# ").unwrap_or(line)).collect::<Vec<_>>().join("\n");
    ensure!(example.contains("agent.hear("), "{folder} begins with no example");
    cmd!(sh, "cargo new --quiet --vcs none robot").run()?;
    sh.write_file("robot/src/main.rs", format!("fn main() -> Result<(), Box<dyn std::error::Error>> {{\n{example}\n}}\n"))?;
    let manifest = sh.read_file("robot/Cargo.toml")?;
    sh.write_file("robot/Cargo.toml", format!("{manifest}goodbot = {{ path = \"../{folder}\" }}\n"))?;
    Ok(cmd!(sh, "cargo run --quiet --manifest-path robot/Cargo.toml").env("CARGO_TARGET_DIR", target_dir().join("try-out")).run()?)
}

/// The C library for this machine, unpacked.
fn c_library(sh: &Shell, from: &Path) -> Result<PathBuf> {
    let (folder, end) = (sh.current_dir().join("c"), format!("-{}.zip", this_machine(sh)?));
    archive::unpack(&the_one(sh, from, "goodbot-c-", &end)?, &folder)?;
    Ok(folder)
}

/// The command line from Debian's package, or from the archive where there is no `dpkg`, and no file outside the package.
fn program(sh: &Shell, from: &Path) -> Result<()> {
    let share = if on_path("dpkg").is_some() {
        let package = the_one(sh, from, "goodbot_", ".deb")?;
        cmd!(sh, "dpkg --extract {package} installed").run()?;
        "installed/usr"
    } else {
        archive::unpack(&the_one(sh, from, "goodbot-", ".zip")?, &sh.current_dir().join("installed"))?;
        "installed"
    };
    let program = sh.current_dir().join(share).join("bin/goodbot");
    for file in ["man/man1/goodbot.1", "bash-completion/completions/goodbot", "fish/vendor_completions.d/goodbot.fish"] {
        ensure!(sh.path_exists(Path::new(share).join("share").join(file)), "share/{file} is missing");
    }
    sh.write_file("sessions.jsonl", cmd!(sh, "{program} example log").read()?)?;
    sh.write_file("home.json", cmd!(sh, "{program} example home").read()?)?;
    cmd!(sh, "{program} learn sessions.jsonl --out words.goodbot").run()?;
    let said = cmd!(sh, "{program} ask --with words.goodbot --environment home.json go to the red room").read()?;
    ensure!(said.contains("agentInRoom"), "it does not understand what it was taught: {said}");
    Ok(())
}

/// In an environment of Python's that has nothing but pip.
fn wheel(sh: &Shell, package: &Path) -> Result<()> {
    let python = python3()?;
    cmd!(sh, "{python} -m venv installed").run()?;
    let programs = sh.current_dir().join("installed").join(VENV);
    cmd!(sh, "{programs}/python -m pip install --quiet --disable-pip-version-check {package}").run()?;
    let lesson = "import goodbot\n\
        home = goodbot.Home.random(seed=1)\n\
        agent, trainer = goodbot.Agent(), goodbot.Trainer('punish-only')\n\
        trainer.teach(agent, home, home.start, 'go to the red room', home.tasks()[0])\n\
        print(goodbot.__file__)\n";
    let place = cmd!(sh, "{programs}/python -c {lesson}").read()?;
    // Folders for temporary files may be links.
    ensure!(Path::new(&place).canonicalize()?.starts_with(sh.current_dir().canonicalize()?), "another goodbot was used: {place}");
    let version = cmd!(sh, "{programs}/goodbot --version").read()?;
    ensure!(version.starts_with("goodbot "), "`goodbot --version` says {version}");
    Ok(())
}

/// Each page that the contents name is there, and so is each file of the guide that a page shows or leads to; the belief moves in a
/// browser, where there is one.
fn guide(sh: &Shell, package: &Path) -> Result<()> {
    unpack(package, &sh.current_dir())?;
    let all = files(sh, &sh.current_dir())?;
    let index = all.iter().find(|file| file.ends_with("index.html")).context("the guide has no first page")?;
    let folder = index.parent().unwrap_or(index);
    let contents = sh.read_file(root().join("docs/SUMMARY.md"))?;
    let pages: Vec<_> = contents.split("](").skip(1).filter_map(|rest| rest.split_once(".md)")).map(|(name, _)| name).collect();
    ensure!(pages.len() > 20, "the contents name {} pages", pages.len());
    let mut dead: Vec<_> =
        pages.iter().filter(|name| **name != "README" && !folder.join(format!("{name}.html")).is_file()).map(ToString::to_string).collect();
    for page in all.iter().filter(|file| file.extension().is_some_and(|end| end == "html")) {
        let text = sh.read_file(page)?;
        let targets =
            ["src=\"", "href=\""].into_iter().flat_map(|before| text.split(before).skip(1)).filter_map(|rest| rest.split('"').next());
        let of_guide = targets.filter(|target| !target.contains(':') && !target.starts_with(['#', '/']));
        let path = |target: &str| page.parent().unwrap_or(page).join(target.split(['#', '?']).next().unwrap_or_default());
        dead.extend(of_guide.filter(|target| !path(target).exists()).map(|target| format!("{} in {}", target, page.display())));
    }
    ensure!(dead.is_empty(), "the guide lacks: {}", dead.join(", "));
    let chromium = match CHROMIUM.path() {
        Ok(chromium) => chromium,
        Err(missing) => {
            eprintln!("remark: the belief in the guide was not tried in a browser: {missing:#}");
            return Ok(());
        }
    };
    let (node, tests) = (NODE.path()?, root().join("wasm/npm-tests/guide.test.mjs"));
    npm_packages()?;
    Ok(cmd!(sh, "{node} --test --test-reporter=spec {tests}").env("GOODBOT_GUIDE", folder).env("GOODBOT_CHROMIUM", chromium).run()?)
}

fn unpack(archive: &Path, to: &Path) -> Result<()> {
    Ok(ZipArchive::new(File::open(archive)?)?.extract(to)?)
}

const TESTS: &str = "capi/tests/packages";
/// A lesson to the lift, and a question.
const LESSON: &str = "up to the roof\n+\n+\n!\nup to the roof\n?\n+\n";
/// Two lessons by one button; the lift is where the second one wants it.
const TWO_LESSONS: &str = "up to the roof\nup to the roof\n";

fn tools() -> Result<PathBuf> {
    python_with(&format!("--requirement={TESTS}/requirements.txt"), "python-packages")
}

/// The library for this machine, in the folder where its package was unpacked.
pub fn try_out(package: &Path) -> Result<()> {
    let (sh, gcc, gxx, programs) = (shell()?, GCC.path()?, GXX.path()?, tools()?);
    let (above, texts) = (sh.create_temp_dir()?, Texts::new(&sh)?);
    let examples = package.join("examples");
    let (project, built) = (sh.create_dir(above.path().join("project"))?, above.path().join("built"));
    texts.copy(&sh, &Path::new(TESTS).join("CMakeLists.txt"), &project.join("CMakeLists.txt"))?;
    let compilers = [format!("-DCMAKE_C_COMPILER={}", gcc.display()), format!("-DCMAKE_CXX_COMPILER={}", gxx.display())];
    cmd!(sh, "{programs}/cmake -S {project} -B {built} -DCMAKE_PREFIX_PATH={package} -DEXAMPLES={examples} {compilers...}").run()?;
    cmd!(sh, "{programs}/cmake --build {built}").run()?;
    for program in ["in_c", "in_cpp", "in_both"] {
        let program = built.join(program);
        cmd!(sh, "{program}").run()?;
    }

    let found = cmd!(sh, "{programs}/pkgconf --cflags --libs goodbot").env("PKG_CONFIG_PATH", package.join("lib/pkgconfig")).read()?;
    let (found, program) = (found.split_whitespace(), built.join("by_pkg_config"));
    cmd!(sh, "{gcc} -std=c11 -Wall -Werror {examples}/lift.c -o {program}").args(found).run()?;
    Ok(cmd!(sh, "{program}").run()?)
}

/// Builds an example of the package for boards with a stub of Arduino, and runs it. Returns what it says.
fn run_sketch(name: &str, typed: &str, boards: &Path, library: &Path) -> Result<String> {
    let (sh, gxx) = (shell()?, GXX.path()?);
    let folder = sh.create_temp_dir()?;
    let sketch = folder.path().join("sketch");
    let warnings = ["-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsanitize=address,undefined"];
    let compile = cmd!(sh, "{gxx} {warnings...} -I {TESTS} -I {boards}/src -include Arduino.h -x c++ {boards}/examples/{name}/{name}.ino");
    compile.args(["-x", "none"]).arg(library).arg("-o").arg(&sketch).run()?;
    let said = cmd!(sh, "{sketch}").stdin(typed).read()?;
    println!("{said}");
    Ok(said)
}

/// The package for boards, unpacked; its sketches run here, with the library for this machine.
pub fn try_out_boards(boards: &Path, package: &Path) -> Result<()> {
    let (sh, programs) = (shell()?, tools()?);
    cmd!(sh, "{programs}/python {TESTS}/platformio.py {boards}").run()?;
    let library = package.join("lib/libgoodbot.a");
    let said = run_sketch("Lift", LESSON, boards, &library)?;
    ensure!(
        said.contains("learned") && said.lines().filter(|line| line.ends_with('%')).count() == 3,
        "the lift did not learn by its serial line"
    );
    let said = run_sketch("OneButton", TWO_LESSONS, boards, &library)?;
    let (_, second) = said.split_once("learned").unwrap_or_default();
    ensure!(second.contains("learned") && !second.contains("down"), "the lift did not learn by its one button");
    Ok(())
}
