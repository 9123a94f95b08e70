//! A folder as one zip file, with the same bytes on every day and machine; and the texts in it, filled with the version and other facts.

use crate::process::packages;
use anyhow::{Context, Result};
use std::fs::File;
use std::path::{Path, PathBuf};
use xshell::Shell;
use zip::read::root_dir_common_filter;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter};

/// All files of a folder and of those below it, in order.
pub fn files(sh: &Shell, folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for path in sh.read_dir(folder)? {
        if path.is_dir() {
            found.extend(files(sh, &path)?);
        } else {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

/// Packs a folder, its own name included. Files in a folder `bin` can be run where they are unpacked.
pub fn pack(sh: &Shell, folder: &Path, to: &Path) -> Result<()> {
    let above = folder.parent().context("a folder to pack is in another")?;
    let mut archive = ZipWriter::new(File::create(to).with_context(|| format!("{} cannot be written", to.display()))?);
    for path in files(sh, folder)? {
        let is_program = path.parent().is_some_and(|parent| parent.ends_with("bin"));
        let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated).last_modified_time(DateTime::default());
        archive.start_file_from_path(path.strip_prefix(above)?, options.unix_permissions(if is_program { 0o755 } else { 0o644 }))?;
        std::io::copy(&mut File::open(&path)?, &mut archive)?;
    }
    archive.finish()?;
    Ok(())
}

/// Unpacks what [`pack`] packed, under another name of the folder.
pub fn unpack(from: &Path, folder: &Path) -> Result<()> {
    Ok(ZipArchive::new(File::open(from)?)?.extract_unwrapped_root_dir(folder, root_dir_common_filter)?)
}

/// Places such as `@VERSION@`, and what is put there.
pub struct Texts(Vec<(&'static str, String)>);

impl Texts {
    /// The facts of the workspace.
    pub fn new(sh: &Shell) -> Result<Self> {
        let packages = packages(sh, "Cargo.toml")?;
        let core = packages.iter().find(|package| package["name"] == "goodbot").context("there is no crate goodbot")?;
        let version = core["version"].as_str().unwrap_or_default();
        let minor = version.rsplit_once('.').map_or(version, |(minor, _)| minor);
        let repository = core["repository"].as_str().unwrap_or_default();
        Ok(Self(vec![("@VERSION@", version.into()), ("@MINOR@", minor.into()), ("@REPOSITORY@", repository.into())]))
    }

    pub fn with(mut self, place: &'static str, text: String) -> Self {
        self.0.push((place, text));
        self
    }

    /// What is put at a place.
    pub fn text(&self, place: &str) -> &str {
        self.0.iter().find(|(name, _)| *name == place).map_or("", |(_, text)| text)
    }

    /// Copies a file.
    pub fn copy(&self, sh: &Shell, from: &Path, to: &Path) -> Result<()> {
        let text = sh.read_file(from)?;
        Ok(sh.write_file(to, self.0.iter().fold(text, |text, (place, filled)| text.replace(place, filled)))?)
    }

    /// Copies all files of a folder.
    pub fn copy_all(&self, sh: &Shell, from: &Path, to: &Path) -> Result<()> {
        let from = sh.current_dir().join(from);
        for file in files(sh, &from)? {
            self.copy(sh, &file, &to.join(file.strip_prefix(&from)?))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::process::shell;
    use serde_json::Value;

    #[test]
    fn whatever_is_published_from_its_folder_has_both_licences_there() {
        let sh = shell().unwrap();
        let published = |package: &Value| package["publish"].is_null() || package["name"] == "goodbot-python";
        let folders = packages(&sh, "Cargo.toml")
            .unwrap()
            .into_iter()
            .filter(published)
            .map(|package| Path::new(package["manifest_path"].as_str().unwrap()).parent().unwrap().to_owned());
        let folders: Vec<_> = folders.collect();
        assert!(folders.len() > 5);
        for file in folders.iter().flat_map(|folder| ["LICENSE-APACHE", "LICENSE-MIT"].map(|file| folder.join(file))) {
            assert!(file.is_file(), "{} is missing: link it to the file of the top folder", file.display());
        }
    }
}
