//! What stands where percoat keeps something of its own and is not percoat's: a link, a folder in the place of a file, a
//! pipe. It is refused, before anything is written.

use super::disk::{self, found, kind};
use super::gathered::{Place, is_known, is_number, place_of};
use super::layout::{FolderError, OWN, names, own, retired, staging};
use super::manifest::{Manifest, Writer};
use super::{OutputError, lock};
use std::path::Path;

/// Refuses what is in the way of a writer in an output folder, whatever the run is going to write.
///
/// # Errors
/// [`FolderError`].
pub(super) fn refuse(folder: &Path, writer: Writer) -> Result<(), FolderError> {
    expect(&folder.join(OWN), Place::Folder)?;
    let (list, lock) = (own(folder, "written.json"), own(folder, lock::NAME));
    for path in [&list, &lock] {
        expect(path, Place::File)?;
    }
    for path in [own(folder, "new"), staging(folder, writer), retired(folder, writer)] {
        expect(&path, Place::Folder)?;
    }
    let foreign = |path: &Path| FolderError::Foreign { path: path.to_owned(), reason: "is not of percoat" };
    if disk::is_file(&list) && Manifest::at(&list).is_none() {
        return Err(foreign(&list));
    }
    if lock::is_foreign(&lock) { Err(foreign(&lock)) } else { Ok(()) }
}

/// Refuses what somebody has put in the place of percoat's own where a result is gathered, before a run goes on with it.
/// What has other names stays there, whatever it is.
///
/// # Errors
/// [`FolderError`].
pub(super) fn refuse_in(folder: &Path) -> Result<(), FolderError> {
    for name in names(folder)? {
        let path = folder.join(&name);
        let Some(place) = place_of(&name) else { continue };
        expect(&path, place)?;
        // The folder of a combination is a run's own, which looks into it when it begins there.
        if place == Place::Folder && is_known(&name) && !is_number(&name) {
            refuse_in(&path)?;
        }
    }
    Ok(())
}

/// Refuses anything but what has its place there, or nothing.
fn expect(path: &Path, place: Place) -> Result<(), FolderError> {
    let there = found(path).map_err(|error| OutputError::new(path, error))?;
    let is_own = |place: Place, own: &std::fs::Metadata| match place {
        Place::File => own.is_file(),
        Place::Folder => own.is_dir(),
    };
    match there.filter(|own| !is_own(place, own)) {
        None => Ok(()),
        Some(own) => Err(FolderError::Stranger { path: path.to_owned(), found: kind(&own), place: place.in_words() }),
    }
}
