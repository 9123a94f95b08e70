//! Looks for the programs that the project's tests use: on the path, and among those that `cargo xtask programs` fetched.

use super::{Finding, State};
use std::path::{Path, PathBuf};

/// Each program, and its use.
const PROGRAMS: [(&str, &str); 12] = [
    ("git", "style checks"),
    ("gcc", "the C interface"),
    ("g++", "the C interface from C++"),
    ("node", "the page"),
    ("npm", "the page"),
    ("python3", "the package for Python"),
    ("qemu-system-arm", "the firmware"),
    ("qemu-system-riscv32", "the firmware on RISC-V"),
    ("arm-none-eabi-gcc", "C on controllers"),
    ("clang", "the C header's layout"),
    ("chromium-headless-shell", "the page"),
    ("firefox-esr", "the page"),
];

/// The place of each program.
pub fn found() -> Vec<Finding> {
    let fetched_into = std::env::var_os("GOODBOT_PROGRAMS").unwrap_or_else(|| "target/programs".into());
    let mut folders: Vec<_> = std::env::var_os("PATH").map(|path| std::env::split_paths(&path).collect()).unwrap_or_default();
    folders.extend(launchers(fetched_into.as_ref()));
    let mut findings: Vec<Finding> = PROGRAMS.iter().map(|(name, why)| look_for(name, why, &folders)).collect();
    if findings.iter().any(|finding| finding.state == State::Missing) {
        findings.push(Finding::new(State::Fine, "cargo xtask programs fetches those that it can, and names the others"));
    }
    findings
}

/// The folders of the launchers of fetched programs.
fn launchers(fetched_into: &Path) -> impl Iterator<Item = PathBuf> {
    std::fs::read_dir(fetched_into).into_iter().flatten().flatten().map(|program| program.path().join("launch"))
}

fn look_for(name: &str, why: &str, folders: &[impl AsRef<Path>]) -> Finding {
    let file = format!("{name}{}", std::env::consts::EXE_SUFFIX);
    match folders.iter().map(|folder| folder.as_ref().join(&file)).find(|path| path.is_file()) {
        Some(path) => Finding::new(State::Fine, format!("{name}: {}", path.display())),
        None => Finding::new(State::Missing, format!("{name}, for {why}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_program_that_the_tests_fetch_is_looked_for() {
        let page = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../CONTRIBUTING.md")).unwrap();
        let (_, fetched) = page.split_once(" GB unpacked: ").unwrap();
        let (fetched, _) = fetched.split_once("and Rust's targets").unwrap();
        let named: Vec<&str> = fetched.split('`').skip(1).step_by(2).collect();
        assert!(named.contains(&"qemu-system-arm"), "{named:?}");
        for name in named {
            assert!(PROGRAMS.iter().any(|(known, _)| *known == name), "{name}");
        }
    }

    #[test]
    fn a_program_is_found_in_a_folder_of_the_path_or_told_with_what_it_is_for() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join(format!("node{}", std::env::consts::EXE_SUFFIX));
        std::fs::write(&file, "").unwrap();
        assert_eq!(look_for("node", "the page", &[folder.path()]).state, State::Fine);
        assert_eq!(look_for("npm", "the page", &[folder.path()]), Finding::new(State::Missing, "npm, for the page"));
    }

    #[test]
    fn a_program_that_was_fetched_is_found_by_its_launcher() {
        let folder = tempfile::tempdir().unwrap();
        let launch = folder.path().join("qemu-system-misc/launch");
        std::fs::create_dir_all(&launch).unwrap();
        std::fs::write(launch.join(format!("qemu-system-riscv32{}", std::env::consts::EXE_SUFFIX)), "").unwrap();
        let folders: Vec<_> = launchers(folder.path()).collect();
        assert_eq!(look_for("qemu-system-riscv32", "the firmware", &folders).state, State::Fine);
        assert_eq!(launchers(&launch.join("missing")).count(), 0);
    }
}
