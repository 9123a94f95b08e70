//! A folder as one zip file, with the same bytes on every day and machine.

use std::fs::File;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
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

/// What is in a file: each file of a zip archive with its name, such as a wheel's, and of another file its bytes.
pub fn contents(sh: &Shell, file: &Path) -> Result<Vec<(String, Vec<u8>)>> {
    let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let Ok(mut archive) = ZipArchive::new(File::open(file)?) else { return Ok(vec![(name, sh.read_binary_file(file)?)]) };
    let length = archive.len();
    let inside = |at| {
        let (mut inside, mut bytes) = (archive.by_index(at)?, Vec::new());
        std::io::Read::read_to_end(&mut inside, &mut bytes)?;
        Ok((format!("{name}: {}", inside.name()?), bytes))
    };
    (0..length).map(inside).collect()
}
