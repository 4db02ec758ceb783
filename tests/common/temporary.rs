//! Temporary folders in memory where it has room: thousands of files are synced there, and none waits for a disk.

use std::path::Path;
use tempfile::TempDir;

/// Bytes that must be free there: containers often have 64 MiB, too few for what tests write.
const ROOM: u64 = 1 << 30;

/// A folder that goes with its value.
pub fn folder() -> TempDir {
    let memory = Path::new("/dev/shm");
    let has_room = fs4::statvfs(memory).is_ok_and(|space| space.available_space() >= ROOM);
    let inside = has_room.then(|| tempfile::tempdir_in(memory).ok()).flatten();
    inside.unwrap_or_else(|| tempfile::tempdir().unwrap())
}
