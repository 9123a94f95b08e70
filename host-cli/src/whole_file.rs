//! Files that are written whole or not at all.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Writes a file so that it has its old content or the new one, whenever the power goes: a new file beside it takes its name when it is
/// whole and on the disk.
///
/// # Errors
/// What the file system says; the file is then as before.
pub fn write_whole(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let folder = folder_of(path);
    let mut builder = tempfile::Builder::new();
    // As any new file; a temporary one would be for its owner alone.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(path).map_err(|error| error.error)?;
    // The new name is on the disk when the folder is. Not every system can do that with a folder.
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
    Ok(())
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// The name of a file that is to be written, as it is typed: what cannot be written is better known before the work than after it.
///
/// # Errors
/// Why no file of this name can be written.
pub fn new_file(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if path.is_dir() || path.file_name().is_none() {
        return Err("this is a folder; name a file in it".to_owned());
    }
    match tempfile::tempfile_in(folder_of(&path)) {
        Ok(_) => Ok(path),
        Err(error) => Err(format!("no file can be written in {}: {error}", folder_of(&path).display())),
    }
}
