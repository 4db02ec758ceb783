//! The calls of the system that change a disk, each noted in the journal of its folder. Nothing is synced but there.

use super::journal::{Change, note, refuses_links};
use std::fs::{self, File};
use std::io;
use std::path::Path;

pub(crate) fn create_new(path: &Path) -> io::Result<File> {
    let file = File::create_new(path)?;
    note(Change::Created(path));
    Ok(file)
}

pub(crate) fn create_dir(path: &Path) -> io::Result<()> {
    fs::create_dir(path)?;
    note(Change::CreatedFolder(path));
    Ok(())
}

pub(crate) fn hard_link(file: &Path, second: &Path) -> io::Result<()> {
    if refuses_links(second) {
        return Err(io::ErrorKind::Unsupported.into());
    }
    fs::hard_link(file, second)?;
    note(Change::Linked(file, second));
    Ok(())
}

pub(crate) fn remove_dir(path: &Path) -> io::Result<()> {
    fs::remove_dir(path)?;
    note(Change::Removed(path));
    Ok(())
}

pub(crate) fn remove_file(path: &Path) -> io::Result<()> {
    fs::remove_file(path)?;
    note(Change::Removed(path));
    Ok(())
}

pub(crate) fn rename(from: &Path, to: &Path) -> io::Result<()> {
    fs::rename(from, to)?;
    note(Change::Moved(from, to));
    Ok(())
}

pub(crate) fn sync(file: &File) -> io::Result<()> {
    note(Change::Synced(file));
    Ok(())
}

pub(crate) fn sync_folder(folder: &Path) -> io::Result<()> {
    note(Change::SyncedFolder(folder));
    Ok(())
}
