//! Names of files and folders in an output folder.

use super::error::AtPath;
use super::{OutputError, disk};
use std::fs;
use std::io;
use std::path::Path;

/// The folder of percoat's own files in an output folder.
pub(super) const OWN: &str = ".percoat";
/// The list of the published files.
pub(super) const LIST: &str = ".percoat/written.json";
/// A staging folder that is being removed.
pub(super) const RETIRED: &str = ".percoat/retired";
/// Marks a folder as a staging folder of percoat.
pub(super) const MARK: &str = ".percoat";
/// The list of a result that is to be published, beside its files.
pub(super) const DECIDED: &str = ".publish.json";
/// The combinations of a sweep that are done, one line each.
pub const SWEEP_LOG: &str = "sweep.jsonl";
/// The folder in which the combinations of a sweep keep their fields.
pub const COMBINATIONS: &str = "combinations";
/// Names of the archives of fields, without their ending.
pub(super) const CONTACT: &str = "contact";
pub(super) const STRESS: &str = "stress";
pub(super) const ARCHIVES: [&str; 2] = [CONTACT, STRESS];
/// The state of a life that is not finished.
pub(super) const LIFE_STATE: &str = "life-state.json";
/// The steps of the coarser grid while a finer one is solved.
pub(super) const COARSER: &str = "coarser";

/// Name of an archive.
pub(super) fn archive(name: &str) -> String {
    format!("{name}.npz")
}

/// Name of the folder in which the entries of an archive are until it is made of them.
pub(super) fn partial(archive: &str) -> String {
    format!("{archive}.partial")
}

/// Whether a name is that of the entries of an archive.
pub(super) fn is_partial(folder: &str) -> bool {
    ARCHIVES.iter().any(|archive| folder == partial(archive))
}

/// Whether a folder is a staging folder, also one that was moved after its run was killed.
pub fn is_staging(folder: &Path) -> bool {
    disk::is_file(&folder.join(MARK))
}

/// Names in a folder, sorted.
pub fn names(folder: &Path) -> Result<Vec<String>, OutputError> {
    let name = |entry: io::Result<fs::DirEntry>| Ok(entry?.file_name().to_string_lossy().into_owned());
    let mut names: Vec<String> = fs::read_dir(folder).and_then(|entries| entries.map(name).collect()).at(folder)?;
    names.sort();
    Ok(names)
}
