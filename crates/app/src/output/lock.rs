//! `.percoat/lock`: the file that a run locks so that no other run writes into its output folder. Its content is the number of
//! the process.
//!
//! percoat writes only into a lock file that it has just created, or that contains the number of a process, or the beginning of
//! one, and has no second name.

use super::OutputError;
use super::disk;
use super::folder_error::FolderError;
use std::fs::{File, TryLockError};
use std::io::{self, ErrorKind, Read, Seek, Write};
use std::path::Path;

/// Name of the file in an output folder.
pub(super) const NAME: &str = ".percoat/lock";
/// The text before the number.
const BEFORE: &str = "process ";
/// Bytes of the longest content.
const LONGEST: u64 = 40;

/// Locks a folder for this process as long as the file is open; the system releases the lock when the process ends.
///
/// # Errors
/// [`FolderError`], also where the file is a user's.
pub(super) fn lock(folder: &Path) -> Result<File, FolderError> {
    let path = folder.join(NAME);
    let failed = |error| OutputError::new(&path, error);
    let opened = match disk::create(&path) {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => disk::open_to_change(&path),
        created => created,
    };
    let mut file = opened.map_err(failed)?;
    match file.try_lock() {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => {
            let owner = content(&file).ok().filter(|content| is_own(content));
            let owner = owner.map(|content| String::from_utf8_lossy(&content).trim().to_owned()).unwrap_or_default();
            return Err(FolderError::Busy { folder: folder.to_owned(), owner });
        }
        // Some network file systems have no locks: there a second run is not refused.
        Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => {}
        Err(TryLockError::Error(error)) => return Err(failed(error).into()),
    }
    if !content(&file).map_err(failed)?.is_empty() && is_foreign(&path) {
        return Err(FolderError::Foreign { path, reason: "is not of percoat" });
    }
    let written = file.set_len(0).and_then(|()| file.rewind());
    written.and_then(|()| writeln!(file, "{BEFORE}{}", std::process::id())).map_err(failed)?;
    Ok(file)
}

/// Whether the lock file is a user's: by its content, or because it has a second name.
pub(super) fn is_foreign(path: &Path) -> bool {
    let Ok(file) = disk::open(path) else { return false };
    disk::has_other_name(&file) || !content(&file).is_ok_and(|content| is_own(&content))
}

/// The content of a lock; of another file its beginning.
fn content(mut file: &File) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.rewind()?;
    file.take(LONGEST).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Whether the content is the number of a process, also one cut off by a kill or a power cut.
fn is_own(content: &[u8]) -> bool {
    let whole = content.len() < LONGEST as usize;
    let Ok(text) = str::from_utf8(content) else { return false };
    let text = text.trim_matches('\0').trim_end_matches('\n');
    let number = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    whole && (BEFORE.starts_with(text) || text.strip_prefix(BEFORE).is_some_and(number))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_users_file_in_the_place_of_the_lock_is_recognised_by_its_content_and_by_its_other_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lock");
        let foreign = |content: &str| {
            fs::write(&path, content).unwrap();
            is_foreign(&path)
        };
        for content in ["", "process 4711\n", "process 1", "proc", "\0\0\0\0\0", "process \n"] {
            assert!(!foreign(content), "{content:?}");
        }
        for other in ["mine", "process of my own\n", "\n\nprocess 1\n", "process 1\nmine", &"1".repeat(100), "é"] {
            assert!(foreign(other), "{other:?}");
        }
        assert!(!foreign("process 1\n"));
        fs::hard_link(&path, folder.path().join("mine")).unwrap();
        assert!(cfg!(not(unix)) || is_foreign(&path));
    }
}
