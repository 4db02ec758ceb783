//! The calls of the system that change a disk. Unit tests have others instead, which keep a journal from which they compute
//! what a power cut may leave.

use std::fs::File;
use std::io;
use std::path::Path;

pub(crate) use std::fs::{create_dir, hard_link, remove_dir, remove_file, rename};

/// Creates a file that must not exist, to write and read it.
pub(crate) fn create_new(path: &Path) -> io::Result<File> {
    File::create_new(path)
}

/// Brings the content of a file to the disk.
pub(crate) fn sync(file: &File) -> io::Result<()> {
    file.sync_data()
}

/// Brings the names in a folder to the disk.
pub(crate) fn sync_folder(folder: &Path) -> io::Result<()> {
    // Elsewhere a folder cannot be opened.
    if cfg!(unix) { File::open(folder)?.sync_all() } else { Ok(()) }
}
