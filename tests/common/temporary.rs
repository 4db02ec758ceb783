//! Temporary folders in memory where there are any: thousands of files are synced there, and none waits for a disk.

use std::path::Path;
use tempfile::TempDir;

/// A folder that goes with its value.
pub fn folder() -> TempDir {
    let memory = tempfile::tempdir_in(Path::new("/dev/shm"));
    memory.or_else(|_| tempfile::tempdir()).unwrap()
}
