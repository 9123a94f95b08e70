//! The right to write a file, which one program has at a time.
//!
//! Whoever reads a file in order to write it again takes the claim first, and keeps it until the last write. So two people who teach one
//! robot do not overwrite each other's lessons: the second one is refused before the work begins.

use crate::whole_file::{followed, write_whole};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Error, ErrorKind, Result};
use std::path::{Path, PathBuf};

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
    pub fn take(path: &Path) -> Result<Self> {
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
    pub fn write(&self, bytes: &[u8]) -> Result<()> {
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
    let number = |found: Result<std::fs::Metadata>| found.ok().map(|it| (it.dev(), it.ino()));
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
