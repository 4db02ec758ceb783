//! The staging folder, in which a run gathers its result, and the names that percoat uses there. Files of other names are foreign:
//! they are neither published nor removed.
//!
//! A staging folder always has a [mark](MARK) with the names that the run may write. Files are recognised as percoat's by their
//! names only in a marked folder. A folder that is given up is moved to `.percoat/retired` and removed there; finished steps and
//! foreign files are kept in `interrupted-1/` or the next free number.

use super::disk::{self, found};
use super::draft::is_temporary;
use super::error::AtPath;
use super::files::is_inside;
use super::layout::{COARSER, DECIDED, LIFE_STATE, MARK, OWN, RETIRED, SWEEP_LOG, is_partial, is_staging};
use super::{OutputError, checkpoint, steps_log, write_text};
use serde::Serialize;
use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs::{self, Metadata};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Kind of an item of percoat in a staging folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Item {
    File,
    Folder,
}

/// The item of percoat at a path relative to a staging folder, by the parts of the path: a file of a `planned` name, one that a run
/// keeps while it goes on, a folder on the way to them, or a temporary file; `None` where the path is foreign.
fn item(parts: &[&str], planned: &BTreeSet<String>) -> Option<Item> {
    match *parts {
        [COARSER, ref rest @ ..] if !rest.is_empty() => item(rest, planned),
        [COARSER] => Some(Item::Folder),
        [name] if is_partial(name) => Some(Item::Folder),
        [MARK | DECIDED | checkpoint::NAME | steps_log::NAME | SWEEP_LOG | LIFE_STATE] => Some(Item::File),
        [folder, name] if is_partial(folder) && name.ends_with(".npy") => Some(Item::File),
        [.., name] if is_temporary(name) => Some(Item::File),
        _ => {
            let name = parts.join("/");
            if planned.contains(&name) {
                return Some(Item::File);
            }
            let folder = name + "/";
            let first = planned.range(folder.clone()..).next();
            first.is_some_and(|name| name.starts_with(&folder)).then_some(Item::Folder)
        }
    }
}

impl Item {
    /// Whether metadata are those of a regular file, or of a folder.
    pub(super) fn is(self, there: &Metadata) -> bool {
        if self == Self::Folder { there.is_dir() } else { there.is_file() }
    }
}

/// A file or folder in a staging folder.
#[derive(Debug)]
pub(super) struct Entry {
    /// Path relative to the staging folder.
    pub(super) path: PathBuf,
    /// Metadata, links not followed.
    pub(super) there: Metadata,
    /// The item of percoat at that path; `None` where it is foreign.
    pub(super) item: Option<Item>,
}

impl Entry {
    /// Whether it is the temporary file of an interrupted write.
    pub(super) fn is_temporary(&self) -> bool {
        self.is_own() && self.path.file_name().and_then(OsStr::to_str).is_some_and(is_temporary)
    }

    /// Whether it is percoat's: a regular file or folder where percoat keeps one.
    pub(super) fn is_own(&self) -> bool {
        self.item.is_some_and(|item| item.is(&self.there))
    }
}

/// Creates a staging folder for files of the `planned` names.
pub(super) fn create(staging: &Path, planned: &[String]) -> Result<(), OutputError> {
    disk::create_folder(staging).at(staging)?;
    let mark = staging.join(MARK);
    let mut file = disk::create(&mark).at(&mark)?;
    file.write_all(marking(&planned).as_bytes()).and_then(|()| disk::sync(&file)).at(&mark)?;
    // The mark is on the disk before any other file.
    disk::sync_folder(staging).at(staging)?;
    staging.parent().map_or(Ok(()), disk::sync_folder).at(staging)
}

/// Adds names to those that are planned in a staging folder.
pub(super) fn plan_more(staging: &Path, names: &[String]) -> Result<(), OutputError> {
    let mut planned = planned(staging);
    let before = planned.len();
    planned.extend(names.iter().cloned());
    if planned.len() == before { Ok(()) } else { write_text(&staging.join(MARK), &marking(&planned)) }
}

/// The content of a mark.
fn marking(planned: &impl Serialize) -> String {
    let names = serde_json::to_string(planned).expect("names are texts");
    format!("A run of percoat {} that is not finished.\n{names}\n", env!("CARGO_PKG_VERSION"))
}

/// The names in the mark of a staging folder.
fn planned(staging: &Path) -> BTreeSet<String> {
    let text = disk::read_text(&staging.join(MARK)).unwrap_or_default();
    let names = text.split_once('\n').and_then(|(_, names)| serde_json::from_str::<Vec<String>>(names).ok());
    names.unwrap_or_default().into_iter().filter(|name| is_inside(name)).collect()
}

/// The entries of a staging folder, the content of a folder before the folder; foreign folders are not entered. In a folder
/// without a mark every entry is foreign.
pub(super) fn entries(staging: &Path) -> Result<Vec<Entry>, OutputError> {
    let (planned, is_marked) = (planned(staging), is_staging(staging));
    let item = |path: &Path| {
        let parts: Option<Vec<&str>> = path.iter().map(OsStr::to_str).collect();
        item(&parts.filter(|_| is_marked)?, &planned)
    };
    let mut entries = Vec::new();
    if disk::is_folder(staging) {
        walk(staging, Path::new(""), &item, &mut entries).at(staging)?;
    }
    Ok(entries)
}

fn walk(root: &Path, below: &Path, item: &dyn Fn(&Path) -> Option<Item>, entries: &mut Vec<Entry>) -> io::Result<()> {
    for name in fs::read_dir(root.join(below))? {
        let path = below.join(name?.file_name());
        let Some(there) = found(&root.join(&path))? else { continue };
        let entry = Entry { item: item(&path), path, there };
        if entry.there.is_dir() && entry.is_own() {
            walk(root, &entry.path, item, entries)?;
        }
        entries.push(entry);
    }
    Ok(())
}

/// Removes percoat's items in a staging folder at the path `within` and below (empty: all of it). Returns whether nothing foreign
/// is left, so that the folder is removed.
pub(super) fn remove_own(staging: &Path, within: &str) -> Result<bool, OutputError> {
    let mut is_gone = true;
    let is_within = |entry: &&Entry| entry.path.starts_with(within) && entry.path != Path::new(MARK);
    for entry in entries(staging)?.iter().filter(is_within) {
        let path = staging.join(&entry.path);
        if !entry.is_own() {
            is_gone = false;
        } else if entry.there.is_file() {
            disk::remove(&path).at(&path)?;
        } else {
            match disk::remove_folder(&path) {
                Err(error) if error.kind() == io::ErrorKind::DirectoryNotEmpty => is_gone = false,
                removed => removed.at(&path)?,
            }
        }
    }
    if is_gone && within.is_empty() {
        // The mark is removed last, so that a folder that is removed halfway is still recognised.
        if is_staging(staging) {
            disk::sync_folder(staging).and_then(|()| disk::remove(&staging.join(MARK))).at(staging)?;
        }
        disk::remove_folder(staging).at(staging)?;
    }
    Ok(is_gone)
}

/// Removes percoat's items in a staging folder at the path `within` and below. Returns the folder to which it was moved if it has
/// foreign files.
pub(super) fn remove_or_set_aside(staging: &Path, within: &str, output: &Path) -> Result<Option<PathBuf>, OutputError> {
    if remove_own(staging, within)? { Ok(None) } else { set_aside(&staging.join(within), output).map(Some) }
}

/// Removes a staging folder, in one move. Returns the folder to which it was moved if it has foreign files.
pub(super) fn discard(staging: &Path, output: &Path) -> Result<Option<PathBuf>, OutputError> {
    disk::move_to(staging, &output.join(RETIRED)).at(staging)?;
    // The move is on the disk before `.publish.json` is removed: a power cut must not make the result seem undecided.
    disk::sync_folder(output).and_then(|()| disk::sync_folder(&output.join(OWN))).at(staging)?;
    remove_retired(output)
}

/// Completes the removal of a staging folder.
pub(super) fn remove_retired(output: &Path) -> Result<Option<PathBuf>, OutputError> {
    let retired = output.join(RETIRED);
    if disk::is_folder(&retired) { remove_or_set_aside(&retired, "", output) } else { Ok(None) }
}

/// Moves a folder to `interrupted-1/` in the output folder, or the next free number, and returns its path.
pub(super) fn set_aside(folder: &Path, output: &Path) -> Result<PathBuf, OutputError> {
    let mut paths = (1..).map(|number: usize| output.join(format!("interrupted-{number}")));
    let aside = paths.find(|path| fs::symlink_metadata(path).is_err()).expect("numbers are not used up");
    disk::move_to(folder, &aside).and_then(|()| disk::sync_folder(output)).at(&aside)?;
    Ok(aside)
}
