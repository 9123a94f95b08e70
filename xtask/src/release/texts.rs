//! The texts of packages, which are filled with the version and other facts.

use std::path::Path;

use anyhow::{Context, Result};
use serde_json::Value;
use xshell::{Shell, cmd};

use super::archive::files;

/// The crates of the workspace, as cargo tells them.
pub fn packages(sh: &Shell) -> Result<Vec<Value>> {
    let metadata = cmd!(sh, "cargo metadata --offline --no-deps --format-version 1").quiet().read()?;
    let metadata: Value = serde_json::from_str(&metadata)?;
    Ok(metadata["packages"].as_array().context("cargo tells packages")?.clone())
}

/// Places such as `@VERSION@`, and what is put there.
pub struct Texts(Vec<(&'static str, String)>);

impl Texts {
    /// The facts of the workspace.
    pub fn new(sh: &Shell) -> Result<Self> {
        let packages = packages(sh)?;
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

    #[test]
    fn whatever_is_published_from_its_folder_has_both_licences_there() {
        let sh = shell().unwrap();
        let published = |package: &Value| package["publish"].is_null() || package["name"] == "goodbot-python";
        let folders = packages(&sh)
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
