//! Foreign files under percoat's names: a link, a folder in the place of a file, a pipe, a result that was edited. They are
//! refused before anything is written.

use super::disk::{self, found, kind};
use super::error::AtPath;
use super::files::Files;
use super::folder_error::FolderError;
use super::layout::{LIST, OWN, RETIRED, is_staging, names, staging};
use super::plan::Plan;
use super::staging::{Entry, Item, entries};
use super::writer::Writer;
use super::{lock, manifest};
use std::fs::Metadata;
use std::path::Path;

/// Reason of a refusal.
const NOT_OWN: &str = "is not of percoat";

/// Refuses foreign files at the paths that percoat keeps for itself, for any plan.
pub(super) fn refuse_in_own_places(folder: &Path, writer: Writer) -> Result<(), FolderError> {
    let [list, lock] = [LIST, lock::NAME].map(|name| folder.join(name));
    let folders = [folder.join(OWN), folder.join(RETIRED), staging(folder, writer)];
    let places = folders.iter().map(|path| (path, true)).chain([&list, &lock].map(|path| (path, false)));
    for (path, is_folder) in places {
        if let Some(there) = found(path).at(path)? {
            expect(path, &there, is_folder)?;
        }
    }
    let is_no_list = disk::is_file(&list) && manifest::read(&list).is_none();
    for (path, is_foreign) in [(&list, is_no_list), (&lock, lock::is_foreign(&lock))] {
        if is_foreign {
            return Err(FolderError::Foreign { path: path.clone(), reason: NOT_OWN });
        }
    }
    Ok(())
}

/// Refuses paths in a staging folder that have the name of an item of percoat and are of another kind, before a run is resumed
/// there. Files of other names stay.
pub(super) fn refuse_in_staging(staging: &Path) -> Result<(), FolderError> {
    for Entry { path, there, item } in entries(staging)? {
        if let Some(item) = item {
            expect(&staging.join(path), &there, item == Item::Folder)?;
        }
    }
    Ok(())
}

/// Refuses foreign files that the plan would replace, or the removal of the writer's earlier files would remove. `listed` are
/// percoat's.
pub(super) fn refuse_planned(folder: &Path, listed: &Files, plan: &Plan) -> Result<(), FolderError> {
    let replaced = listed.clone().filtered(|name, by| plan.replaces(name, by));
    let earlier = replaced.names().filter(|name| !plan.names.iter().any(|planned| planned == name));
    for name in plan.names.iter().map(String::as_str).chain(earlier) {
        let path = folder.join(name);
        let is_same_case = || name == "case.toml" && plan.case.is_some() && disk::read_text(&path).ok() == plan.case;
        let refusal = listed.ownership(folder, name).at(&path)?.refusal();
        if let Some(reason) = refusal.filter(|_| !is_same_case()) {
            return Err(FolderError::Foreign { path, reason });
        }
    }
    let staging = staging(folder, plan.writer);
    if disk::is_folder(&staging) && !is_staging(&staging) && !names(&staging)?.is_empty() {
        return Err(FolderError::Foreign { path: staging, reason: NOT_OWN });
    }
    Ok(())
}

/// Refuses anything but a folder (`is_folder`) or a regular file.
fn expect(path: &Path, there: &Metadata, is_folder: bool) -> Result<(), FolderError> {
    if if is_folder { there.is_dir() } else { there.is_file() } {
        return Ok(());
    }
    let expected = if is_folder { "a folder" } else { "a file" };
    Err(FolderError::WrongKind { path: path.to_owned(), found: kind(there), expected })
}
