//! What stands where in an output folder, and whose it is.

use super::manifest::{Manifest, Standing, Writer};
use super::{OutputError, disk};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// What percoat keeps for itself in an output folder.
pub(super) const OWN: &str = ".percoat";
/// Marks a folder as one in which a run of percoat gathers its result.
pub(super) const MARK: &str = ".percoat";
/// The list of a result that is to be published, beside its files.
pub(super) const DECIDED: &str = ".publish.json";
/// The combinations of a sweep that are done, one line each.
pub const SWEEP_LOG: &str = "sweep.jsonl";
/// Where the combinations of a sweep keep their fields.
pub const COMBINATIONS: &str = "combinations";
/// Where the coarser grid's steps stand while a finer one is solved.
pub(super) const COARSER: &str = "coarser";

/// Why a folder cannot be had.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    /// What the run would replace is not percoat's.
    #[error("{} {reason}, and this run would replace it: choose another folder with -o, or move it away", path.display())]
    Foreign {
        /// The file or folder.
        path: PathBuf,
        /// Whose it is.
        reason: &'static str,
    },
    /// Something stands where percoat keeps what is its own, and cannot be percoat's.
    #[error("{} is {found}, where percoat keeps {place} of its own: move it away, or choose another folder with -o", path.display())]
    Stranger {
        /// Where.
        path: PathBuf,
        /// What it is.
        found: &'static str,
        /// What has its place there.
        place: &'static str,
    },
    /// Another run has the folder.
    #[error("another run ({owner}) is writing into {}: wait for it, or choose another folder with -o", folder.display())]
    Busy {
        /// The folder.
        folder: PathBuf,
        /// Which run.
        owner: String,
    },
    /// It cannot be read or written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

/// Where percoat keeps something for itself in an output folder.
pub(super) fn own(folder: &Path, name: &str) -> PathBuf {
    folder.join(OWN).join(name)
}

/// Where a writer gathers its result.
pub(super) fn staging(folder: &Path, writer: Writer) -> PathBuf {
    match writer {
        Writer::Solve => folder.join("unfinished"),
        Writer::Sweep => folder.join("unfinished-sweep"),
        // Here nothing stands that is worth a look before all of it is there.
        Writer::Check => own(folder, "check"),
        Writer::Compare => own(folder, "compare"),
        Writer::Limit => own(folder, "limit"),
        Writer::Validate => own(folder, "validate"),
        Writer::Report => own(folder, "report"),
    }
}

/// Where the place in which a writer has gathered its result stands after that is published, until it is removed.
pub(super) fn retired(folder: &Path, writer: Writer) -> PathBuf {
    let name = match writer {
        Writer::Solve => "retired",
        Writer::Check => "retired-check",
        Writer::Compare => "retired-compare",
        Writer::Limit => "retired-limit",
        Writer::Validate => "retired-validate",
        Writer::Sweep => "retired-sweep",
        Writer::Report => "retired-report",
    };
    own(folder, name)
}

/// Whether a file of a folder is as percoat wrote it there beside its `result`. Where no list has the result, as in a copy,
/// every file is.
///
/// # Errors
/// When the file cannot be read.
pub fn is_beside(result: &str, folder: &Path, name: &str) -> io::Result<bool> {
    let list = Manifest::read(&own(folder, "written.json"));
    Ok(!list.has(result) || list.standing(folder, name)? == Standing::Written)
}

/// Whether a folder is one in which a run gathers its result, or did so when it was killed, wherever it has been moved since.
pub fn is_gathering(folder: &Path) -> bool {
    disk::is_file(&folder.join(MARK))
}

/// Why a name is not percoat's, if it is somebody else's.
pub(super) fn foreign(standing: Standing) -> Option<&'static str> {
    match standing {
        Standing::Absent | Standing::Written => None,
        Standing::Changed => Some("was changed since percoat wrote it"),
        Standing::Foreign => Some("is not listed as a result of percoat (in .percoat/written.json)"),
    }
}

/// Names of what is in a folder, sorted.
pub(super) fn names(folder: &Path) -> Result<Vec<String>, OutputError> {
    let name = |entry: io::Result<fs::DirEntry>| Ok(entry?.file_name().to_string_lossy().into_owned());
    let names = fs::read_dir(folder).and_then(|entries| entries.map(name).collect());
    let mut names: Vec<String> = names.map_err(|error| OutputError::new(folder, error))?;
    names.sort();
    Ok(names)
}
