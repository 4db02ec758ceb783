//! Foreign files under percoat's names: a link, a folder in the place of a file, a pipe, a result that was edited. They are
//! refused before anything is written.

use super::disk::{self, found, kind};
use super::error::AtPath;
use super::files::Files;
use super::folder_error::FolderError;
use super::layout::{LIST, OWN, RETIRED, is_staging, names};
use super::plan::Plan;
use super::staging::{Item, entries};
use super::writer::Writer;
use super::{lock, manifest};
use std::fs::Metadata;
use std::path::Path;

/// Reason of a refusal.
const NOT_OWN: &str = "is not of percoat";

/// Refuses foreign files at the paths that percoat keeps for itself, for any plan.
pub(super) fn refuse_in_own_places(folder: &Path, writer: Writer) -> Result<(), FolderError> {
    let [list, lock] = [LIST, lock::NAME].map(|name| folder.join(name));
    let folders = [folder.join(OWN), folder.join(RETIRED), writer.staging(folder)];
    let places = folders.iter().map(|path| (path, Item::Folder)).chain([&list, &lock].map(|path| (path, Item::File)));
    for (path, item) in places {
        found(path).at(path)?.map_or(Ok(()), |there| expect(path, &there, item))?;
    }
    let is_no_list = disk::is_file(&list) && manifest::read(&list).is_none();
    match (is_no_list, lock::is_foreign(&lock)) {
        (true, _) => Err(FolderError::Foreign { path: list, reason: NOT_OWN }),
        (_, true) => Err(FolderError::Foreign { path: lock, reason: NOT_OWN }),
        _ => Ok(()),
    }
}

/// Refuses paths in a staging folder that have the name of an item of percoat and are of another kind, before a run is resumed
/// there. Files of other names stay.
pub(super) fn refuse_in_staging(staging: &Path) -> Result<(), FolderError> {
    let entries = entries(staging)?;
    let owned = entries.iter().filter_map(|entry| Some((entry, entry.item?)));
    owned.into_iter().try_for_each(|(entry, item)| expect(&staging.join(&entry.path), &entry.there, item))
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
    let staging = plan.writer.staging(folder);
    if disk::is_folder(&staging) && !is_staging(&staging) && !names(&staging)?.is_empty() {
        return Err(FolderError::Foreign { path: staging, reason: NOT_OWN });
    }
    Ok(())
}

/// Refuses anything but an item of percoat.
fn expect(path: &Path, there: &Metadata, item: Item) -> Result<(), FolderError> {
    if item.is(there) {
        return Ok(());
    }
    let expected = if item == Item::Folder { "a folder" } else { "a file" };
    Err(FolderError::WrongKind { path: path.to_owned(), found: kind(there), expected })
}
