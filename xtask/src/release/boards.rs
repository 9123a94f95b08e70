//! The C library as Arduino, PlatformIO, ESP-IDF and Zephyr look for it: one folder, with an archive for each processor.

use super::archive::Texts;
use crate::capi::{FEATURES, headers_beside, library};
use crate::toolchain::{CORTEX_M0, CORTEX_M3, CORTEX_M4, CORTEX_M4F, CORTEX_M33F, RISCV, RISCV_C3};
use anyhow::Result;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use xshell::Shell;

const SOURCES: &str = "capi/packages/boards";

/// The folders below `src`, by Arduino's names of processors and floating-point units, and the target of each archive. Where the unit has
/// no folder, calls pass floats in whole registers.
const ARCHIVES: [(&str, &str); 16] = [
    ("cortex-m0", CORTEX_M0),
    ("cortex-m0plus", CORTEX_M0),
    ("rp2040", CORTEX_M0),
    ("cortex-m3", CORTEX_M3),
    ("cortex-m4", CORTEX_M4),
    ("cortex-m4/fpv4-sp-d16-softfp", CORTEX_M4),
    ("cortex-m4/fpv4-sp-d16-hard", CORTEX_M4F),
    ("cortex-m7", CORTEX_M4),
    ("cortex-m7/fpv5-d16-softfp", CORTEX_M4),
    ("cortex-m7/fpv5-d16-hard", CORTEX_M4F),
    // Not every Cortex-M33 has the instructions that a Cortex-M4 has more than an M3.
    ("cortex-m33", CORTEX_M3),
    ("cortex-m33/fpv5-sp-d16-hard", CORTEX_M33F),
    ("esp32c3", RISCV_C3),
    ("esp32c2", RISCV_C3),
    ("esp32c6", RISCV),
    ("esp32h2", RISCV),
];

/// Makes the folder below `above`.
pub fn make(sh: &Shell, above: &Path) -> Result<PathBuf> {
    let mut built = BTreeMap::new();
    for (_, target) in ARCHIVES {
        if !built.contains_key(target) {
            // The next target's library may be built in the same place.
            let kept = above.join(format!("{target}.a"));
            sh.copy_file(library(Some(target), FEATURES)?, &kept)?;
            built.insert(target, kept);
        }
    }
    let folder = above.join("goodbot");
    describe(sh, &folder)?;
    for (processor, target) in ARCHIVES {
        let place = sh.create_dir(folder.join("src").join(processor))?;
        sh.copy_file(&built[target], place.join("libgoodbot.a"))?;
    }
    Ok(folder)
}

/// Everything but the archives.
fn describe(sh: &Shell, folder: &Path) -> Result<()> {
    let espressif: Vec<String> =
        ARCHIVES.iter().filter(|(name, _)| name.starts_with("esp32")).map(|(name, _)| format!("  - {name}")).collect();
    let processors: Vec<String> = ARCHIVES.iter().filter(|(name, _)| !name.contains('/')).map(|(name, _)| format!("`{name}`")).collect();
    let texts = Texts::new(sh)?.with("@ESP_TARGETS@", espressif.join("\n")).with("@PROCESSORS@", processors.join(", "));
    texts.copy_all(sh, Path::new(SOURCES), folder)?;
    let src = sh.create_dir(folder.join("src"))?;
    headers_beside(sh, FEATURES, &src)?;
    super::licences(sh, folder)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::process::shell;
    use crate::release::archive::files;

    fn described() -> (xshell::TempDir, Shell) {
        let sh = shell().unwrap();
        let folder = sh.create_temp_dir().unwrap();
        describe(&sh, folder.path()).unwrap();
        (folder, sh)
    }

    #[test]
    fn each_tool_finds_the_file_that_it_looks_for() {
        let (folder, sh) = described();
        let expected = [
            "CMakeLists.txt",
            "LICENSE-APACHE",
            "LICENSE-MIT",
            "README.md",
            "examples/Lift/Lift.ino",
            "examples/OneButton/OneButton.ino",
            "idf_component.yml",
            "library.json",
            "library.properties",
            "platformio.py",
            "src/goodbot.h",
            "src/goodbot.hpp",
            "zephyr/CMakeLists.txt",
            "zephyr/Kconfig",
            "zephyr/module.yml",
        ];
        let found = files(&sh, folder.path()).unwrap();
        assert_eq!(found.iter().map(|file| file.strip_prefix(folder.path()).unwrap()).collect::<Vec<_>>(), expected.map(Path::new));
    }

    #[test]
    fn no_text_has_a_place_that_was_not_filled() {
        let (folder, sh) = described();
        for file in files(&sh, folder.path()).unwrap() {
            let text = sh.read_file(&file).unwrap();
            let is_left = |word: &str| word.len() > 2 && word.bytes().all(|c| c.is_ascii_uppercase() || c == b'_');
            let left: Vec<_> = text.split('@').filter(|word| is_left(word)).collect();
            assert!(left.is_empty(), "{}: {left:?}", file.display());
        }
    }

    #[test]
    fn a_manifest_of_arduino_names_the_archive_and_that_there_are_no_sources() {
        let (folder, sh) = described();
        let text = sh.read_file(folder.path().join("library.properties")).unwrap();
        let fields: BTreeMap<_, _> = text.lines().filter_map(|line| line.split_once('=')).collect();
        for field in ["name", "version", "author", "maintainer", "sentence", "paragraph", "category", "url", "architectures"] {
            assert!(fields.contains_key(field), "{field}");
        }
        assert_eq!((fields["precompiled"], fields["ldflags"], fields["includes"]), ("full", "-lgoodbot", "goodbot.h"));
    }

    #[test]
    fn zephyr_asks_for_no_archive_that_is_not_made() {
        let sh = shell().unwrap();
        let text = sh.read_file(Path::new(SOURCES).join("zephyr/CMakeLists.txt")).unwrap();
        let asked: Vec<_> = text.lines().filter_map(|line| line.trim().strip_prefix("set(processor ")?.strip_suffix(')')).collect();
        assert!(asked.len() > 5);
        for processor in asked {
            assert!(ARCHIVES.iter().any(|(name, _)| *name == processor), "{processor}");
        }
    }
}
