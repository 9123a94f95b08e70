//! Reads and writes whole files. A file is written completely or not at all.
//!
//! Whoever reads a file in order to write it again [claims](Claim) it first, and keeps the claim until the last write. So two people who teach
//! one robot do not overwrite each other's lessons: the second one is refused before the work begins.

use crate::load::input::Content;
use crate::outcome::Failure;
use goodbot::Options;
use goodbot::snapshot::Contents;
use std::fs::{DirEntry, File, OpenOptions, TryLockError};
use std::io::{Error, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The most bytes of a model or a home: endless input is not read to its end.
pub const MOST_BYTES: u64 = 64 << 20;

/// The suffix of unfinished files.
const TORN_SUFFIX: &str = ".part";
/// The most letters of a file's name in the name of its unfinished file. Even with four bytes each, the name is not too long.
const MOST_LETTERS: usize = 50;
/// An unfinished file that is older than this was abandoned: no file takes as long to write.
const LONGEST_WRITING: Duration = Duration::from_secs(60);

/// The bytes of a model.
///
/// # Errors
/// A [`Failure`] that names the file and says what to do.
pub fn read_model(path: &Path) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|file| file.take(MOST_BYTES + 1).read_to_end(&mut bytes));
    read.map_err(|error| Failure::of(path, format_args!("cannot be read ({error}); check its name")))?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(Failure::of(path, format_args!("has more than {} MiB, too much for a model; check its name", MOST_BYTES >> 20)));
    }
    let content = Content::of(&bytes);
    if !matches!(content, Content::Model | Content::Environment)
        || content == Content::Environment && bytes.trim_ascii_start().starts_with(b"{")
    {
        let message = format!("this is {}, not a model; name a model (goodbot learn writes one)", content.name());
        return Err(Failure::of(path, message));
    }
    Ok(bytes)
}

/// The options of a model file's robot.
///
/// # Errors
/// The errors of [`read_model`], and the fault of a damaged model.
pub fn options_of_model(file: &Path) -> Result<Options, Failure> {
    let bytes = read_model(file)?;
    let contents = Contents::read(&bytes).map_err(|error| Failure::of(file, error))?;
    Ok(contents.options)
}

/// The file that a path leads to. Links are followed, and one may lead to a file that is not there yet.
///
/// # Errors
/// An error if links lead in a circle.
pub fn followed(path: &Path) -> std::io::Result<PathBuf> {
    const MOST_LINKS: usize = 40;
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        match std::fs::read_link(&path) {
            Ok(target) => path = folder_of(&path).join(target),
            Err(_) => return Ok(path),
        }
    }
    Err(std::io::Error::other("its links lead in a circle"))
}

/// Writes a file so that it has its old or its new content, even after a power cut. A new file is written beside it to the disk, and then
/// renamed. Links are followed. Pipes and devices are written to directly.
///
/// # Errors
/// The file system's error. An ordinary file is then unchanged.
pub fn write_whole(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let path = &followed(path)?;
    let there = std::fs::metadata(path).ok();
    if there.as_ref().is_some_and(|there| !there.is_file()) {
        return std::fs::OpenOptions::new().write(true).open(path)?.write_all(bytes);
    }
    let folder = folder_of(path);
    let mut builder = tempfile::Builder::new();
    remove_torn(path, LONGEST_WRITING);
    let prefix = torn_prefix(path);
    builder.prefix(&prefix).suffix(TORN_SUFFIX);
    // The permissions of any new file. A temporary file would be its owner's alone.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder)?;
    if let Some(there) = there {
        file.as_file().set_permissions(there.permissions())?;
    }
    // The error of the temporary file itself would name that file.
    file.as_file_mut().write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(path).map_err(|error| error.error)?;
    // The new name is on the disk after the folder is synced. Not every system can sync a folder.
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
    Ok(())
}

/// Removes the unfinished files of stopped programs beside a file, if they are at least this old. Returns their number.
pub fn remove_torn(path: &Path, age: Duration) -> usize {
    let prefix = torn_prefix(path);
    let is_torn = |entry: &DirEntry| {
        let name = entry.file_name();
        let is_named = name.to_str().is_some_and(|name| name.starts_with(&prefix) && name.ends_with(TORN_SUFFIX));
        let is_old = || entry.metadata().and_then(|it| it.modified()).is_ok_and(|at| at.elapsed().unwrap_or_default() >= age);
        is_named && is_old()
    };
    let Ok(entries) = std::fs::read_dir(folder_of(path)) else { return 0 };
    entries.flatten().filter(is_torn).filter(|entry| std::fs::remove_file(entry.path()).is_ok()).count()
}

/// Whether this is the name of an unfinished file.
pub fn is_unfinished(path: &Path) -> bool {
    path.file_name().and_then(|name| name.to_str()).is_some_and(|name| name.starts_with('.') && name.ends_with(TORN_SUFFIX))
}

/// The prefix of unfinished files: the file's own name, cut to length.
fn torn_prefix(path: &Path) -> String {
    let name: String = path.file_name().unwrap_or_default().to_string_lossy().chars().take(MOST_LETTERS).collect();
    format!(".{name}.")
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A file that no other goodbot writes, as long as this value lives.
///
/// The lock is on an empty file beside it, because the file itself may be missing, and gets another inode with each write. A lock ends with
/// its program, however that ends; the empty file is removed, or used again by the next one.
#[derive(Debug)]
pub struct Claim {
    path: PathBuf,
    /// The lock; `None` where files cannot be locked: other programs are not kept out there.
    lock: Option<(PathBuf, File)>,
}

impl Claim {
    /// Claims a file, which may still be missing. Links are followed. Pipes and devices need no claim.
    ///
    /// # Errors
    /// [`ErrorKind::ResourceBusy`] if another program has claimed it; otherwise the file system's error: nothing can be written there.
    pub fn take(path: &Path) -> std::io::Result<Self> {
        let path = followed(path)?;
        if path.exists() && !path.is_file() {
            return Ok(Self { path, lock: None });
        }
        let name = path.file_name().ok_or(ErrorKind::InvalidInput)?;
        let mut lock_name = std::ffi::OsString::from(".");
        lock_name.push(name);
        lock_name.push(".lock");
        let beside = path.with_file_name(lock_name);
        loop {
            let file = OpenOptions::new().write(true).create(true).truncate(false).open(&beside)?;
            match file.try_lock() {
                Err(TryLockError::WouldBlock) => {
                    return Err(Error::new(
                        ErrorKind::ResourceBusy,
                        "another program is writing it; wait for that one, or leave it, first",
                    ));
                }
                Err(TryLockError::Error(_)) => return Ok(Self { path, lock: None }),
                // The program before may have removed this file between the two calls: then the lock keeps nobody out.
                Ok(()) if !is_at(&file, &beside) => {}
                Ok(()) => return Ok(Self { path, lock: Some((beside, file)) }),
            }
        }
    }

    /// Writes the claimed file, as [`write_whole`] does.
    ///
    /// # Errors
    /// The errors of [`write_whole`].
    pub fn write(&self, bytes: &[u8]) -> std::io::Result<()> {
        write_whole(&self.path, bytes)
    }
}

/// Removes the file of the lock, while it is still locked.
impl Drop for Claim {
    fn drop(&mut self) {
        // On other systems a file that is open keeps its name for a while, so it stays and is used again.
        #[cfg(unix)]
        if let Some((beside, _)) = &self.lock {
            let _ = std::fs::remove_file(beside);
        }
    }
}

/// Whether this opened file is the one that has this name now.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let number = |found: std::io::Result<std::fs::Metadata>| found.ok().map(|it| (it.dev(), it.ino()));
    number(file.metadata()).is_some_and(|ours| number(std::fs::metadata(path)) == Some(ours))
}

#[cfg(not(unix))]
const fn is_at(_: &File, _: &Path) -> bool {
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn a_file_is_claimed_once_at_a_time_whatever_it_is_called_and_nothing_is_left_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("m");
        let claim = Claim::take(&path).unwrap();
        for other in [path.clone(), folder.path().join(".").join("m")] {
            assert_eq!(Claim::take(&other).unwrap_err().kind(), ErrorKind::ResourceBusy);
        }
        claim.write(b"first").unwrap();
        claim.write(b"second").unwrap();
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("m", folder.path().join("link")).unwrap();
            assert_eq!(Claim::take(&folder.path().join("link")).unwrap_err().kind(), ErrorKind::ResourceBusy);
            std::fs::remove_file(folder.path().join("link")).unwrap();
        }
        drop(claim);
        drop(Claim::take(&path).unwrap());
        if cfg!(unix) {
            assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
        }
    }

    /// Each thread adds one to the number in a file, many times. Without the comparison of inodes, two threads hold the lock of two files of
    /// one name, and numbers are lost.
    #[test]
    fn nobody_overwrites_what_another_wrote_between() {
        const TIMES: usize = 200;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("number");
        std::fs::write(&path, "0").unwrap();
        let inside = AtomicUsize::new(0);
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    let mut added = 0;
                    while added < TIMES {
                        let Ok(_claim) = Claim::take(&path) else { continue };
                        assert_eq!(inside.fetch_add(1, Ordering::SeqCst), 0, "two hold the claim");
                        let number: usize = std::fs::read_to_string(&path).unwrap().parse().unwrap();
                        std::fs::write(&path, (number + 1).to_string()).unwrap();
                        inside.fetch_sub(1, Ordering::SeqCst);
                        added += 1;
                    }
                });
            }
        });
        assert_eq!(std::fs::read_to_string(&path).unwrap(), (4 * TIMES).to_string());
    }

    #[test]
    #[cfg(unix)]
    fn a_device_needs_no_claim() {
        let (one, other) = (Claim::take(Path::new("/dev/null")).unwrap(), Claim::take(Path::new("/dev/null")).unwrap());
        one.write(b"gone").unwrap();
        other.write(b"gone").unwrap();
    }
}

#[cfg(all(test, unix))]
mod tests_of_links {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};

    #[test]
    fn a_link_is_followed_and_a_file_keeps_who_may_read_it() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("model"), folder.path().join("link"));
        std::fs::write(&file, b"old").unwrap();
        std::fs::set_permissions(&file, PermissionsExt::from_mode(0o600)).unwrap();
        symlink(&file, &link).unwrap();
        write_whole(&link, b"new").unwrap();
        assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(std::fs::read(&file).unwrap(), b"new");
        assert_eq!(std::fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o600);
    }

    #[test]
    fn a_link_to_a_file_that_is_not_there_yet_stays_a_link_to_it() {
        let folder = tempfile::tempdir().unwrap();
        let [file, link, other] = ["model", "link", "other"].map(|name| folder.path().join(name));
        symlink("model", &link).unwrap();
        symlink(&link, &other).unwrap();
        write_whole(&other, b"new").unwrap();
        assert!([&link, &other].iter().all(|link| std::fs::symlink_metadata(link).unwrap().is_symlink()));
        assert_eq!(std::fs::read(&file).unwrap(), b"new");
    }

    #[test]
    fn links_in_a_circle_are_refused_and_kept() {
        let folder = tempfile::tempdir().unwrap();
        let [one, other] = ["one", "other"].map(|name| folder.path().join(name));
        symlink(&one, &other).unwrap();
        symlink(&other, &one).unwrap();
        assert!(write_whole(&one, b"new").unwrap_err().to_string().contains("circle"));
        assert!(std::fs::symlink_metadata(&one).unwrap().is_symlink());
    }

    #[test]
    fn a_device_is_written_to_and_stays_a_device() {
        write_whole(Path::new("/dev/null"), b"gone").unwrap();
        assert!(!std::fs::metadata("/dev/null").unwrap().is_file());
    }
}
