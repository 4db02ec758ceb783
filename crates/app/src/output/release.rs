//! Release of a solved folder that becomes part of another result, as those of the combinations of a sweep: percoat's own files
//! in it are removed.

use super::error::AtPath;
use super::files::Files;
use super::layout::{LIST, OWN, names};
use super::manifest::published;
use super::writer::Writer;
use super::{OutputError, disk, lock};
use std::io::ErrorKind;
use std::path::Path;

/// Releases a solved folder, and returns the files of its result. Foreign files in `.percoat` stay.
///
/// # Errors
/// [`OutputError`] with the path.
pub fn release(folder: &Path) -> Result<Files, OutputError> {
    let files = published(folder).filtered(|_, by| by == Writer::Solve);
    for path in [LIST, lock::NAME].map(|name| folder.join(name)).iter().filter(|path| disk::is_file(path)) {
        disk::remove(path).at(path)?;
    }
    let kept = folder.join(OWN);
    match disk::remove_folder(&kept) {
        Err(error) if [ErrorKind::NotFound, ErrorKind::DirectoryNotEmpty].contains(&error.kind()) => Ok(files),
        removed => removed.and_then(|()| disk::sync_folder(folder)).at(&kept).map(|()| files),
    }
}

/// Whether a folder was [released](release), also by a run killed halfway: it has a result and no list.
pub fn is_released(folder: &Path) -> bool {
    let is_result = |name: &String| *name != OWN && folder.join(name) != Writer::Solve.staging(folder);
    !disk::is_file(&folder.join(LIST)) && names(folder).is_ok_and(|names| names.iter().any(is_result))
}
