//! Whether a package has the same bytes wherever it is made.

use std::collections::BTreeSet;
use std::path::Path;

use anyhow::{Result, ensure};
use xshell::{Shell, cmd};
use zip::ZipArchive;

use super::{CHECKSUMS, FOLDER, Options};
use crate::process::target_dir;
use crate::programs::programs;

/// The copy is made of what is committed; so must the first packages be.
pub fn is_possible(sh: &Shell) -> Result<()> {
    let changed = cmd!(sh, "git status --porcelain --untracked-files=no").quiet().read()?;
    ensure!(changed.is_empty(), "packages can be compared of what is committed only; commit first:\n{changed}");
    Ok(())
}

/// Makes the packages of a copy, in a folder of another name and with nothing built before, and compares them with these.
pub fn compare(sh: &Shell, options: &Options, to: &Path) -> Result<()> {
    println!("\n== twice: the same packages, of a copy in another folder");
    let above = sh.create_temp_dir()?;
    let copy = above.path().join("copy");
    cmd!(sh, "git clone --quiet . {copy}").run()?;
    let again = copy.join(FOLDER);
    {
        let _folder = sh.push_dir(&copy);
        let only = options.packages().flat_map(|package| ["--only".to_owned(), package.described().0]);
        let target = options.target.iter().flat_map(|target| ["--target", target]);
        let make = cmd!(sh, "cargo xtask release").args(only).args(target);
        make.env("CARGO_TARGET_DIR", above.path().join("target")).env("GOODBOT_PROGRAMS", programs()).run()?;
    }
    let mut differing = Vec::new();
    for file in sh.read_dir(&again)? {
        let name = file.file_name().unwrap_or_default();
        let (first, second) = (sh.read_binary_file(to.join(name))?, sh.read_binary_file(&file)?);
        if name != CHECKSUMS {
            let name = name.to_string_lossy();
            println!("{} {name}", if first == second { "same     " } else { "DIFFERENT" });
            differing.extend((first != second).then(|| format!("{name}: {}", difference(&first, &second))));
        }
    }
    ensure!(differing.is_empty(), "not the same bytes; compare {FOLDER} with {}:\n{}", kept(sh, &again)?.display(), differing.join("\n"));
    Ok(())
}

/// Keeps the second packages, to be looked at.
fn kept(sh: &Shell, again: &Path) -> Result<std::path::PathBuf> {
    let kept = target_dir().join("release-again");
    sh.remove_path(&kept)?;
    sh.create_dir(&kept)?;
    sh.read_dir(again)?.iter().try_for_each(|file| sh.copy_file(file, &kept))?;
    Ok(kept)
}

/// Where two files differ: the files inside, if they are archives, else the first byte.
fn difference(first: &[u8], second: &[u8]) -> String {
    let inside = |bytes| -> Result<BTreeSet<(String, u32)>> {
        let mut archive = ZipArchive::new(std::io::Cursor::new(bytes))?;
        let length = archive.len();
        let file = |at| {
            let file = archive.by_index(at)?;
            Ok((file.name()?.into_owned(), file.crc32()))
        };
        (0..length).map(file).collect()
    };
    if let (Ok(first), Ok(second)) = (inside(first), inside(second)) {
        let names: BTreeSet<_> = first.symmetric_difference(&second).map(|(name, _)| name.as_str()).collect();
        if !names.is_empty() {
            return names.into_iter().collect::<Vec<_>>().join(", ");
        }
    }
    let at = first.iter().zip(second).position(|(first, second)| first != second);
    format!("from byte {} on, of {} and {}", at.unwrap_or(first.len().min(second.len())), first.len(), second.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::process::shell;
    use crate::release::archive::pack;

    #[test]
    fn what_differs_in_two_packages_is_named() {
        let sh = shell().unwrap();
        let above = sh.create_temp_dir().unwrap();
        let packed = |text: &str| {
            let folder = above.path().join("package");
            sh.write_file(folder.join("same"), "same").unwrap();
            sh.write_file(folder.join("other"), text).unwrap();
            pack(&sh, &folder, &above.path().join("package.zip")).unwrap();
            sh.read_binary_file(above.path().join("package.zip")).unwrap()
        };
        assert_eq!(packed("one"), packed("one"));
        assert_eq!(difference(&packed("one"), &packed("two")), "package/other");
        assert_eq!(difference(b"abcd", b"abXd"), "from byte 2 on, of 4 and 4");
        assert_eq!(difference(b"ab", b"abc"), "from byte 2 on, of 2 and 3");
    }
}
