//! Lists of files with lengths and checksums: those of a step, a combination or a whole result.
//!
//! A file is percoat's while its length and checksum are those listed. Any other is a user's: a file that is not listed, one
//! that was changed since, and a folder or a link in its place.

use super::OutputError;
use super::checksum::{Checksum, checksum};
use super::disk::{self, found};
use super::error::AtPath;
use super::writer::Writer;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io;
use std::path::{Component, Path};

/// Files by their names within a folder, as they were written.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Files(BTreeMap<String, FileRecord>);

/// A file as it was written: the command, its length in bytes and its checksum.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct FileRecord {
    by: Writer,
    bytes: u64,
    checksum: String,
}

/// Owner of a name in a folder, by a list of files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ownership {
    /// No file of this name.
    Absent,
    /// The file is as percoat wrote it.
    AsWritten,
    /// Written by percoat and changed since.
    Changed,
    /// Not listed as a file of percoat.
    Foreign,
}

impl FileRecord {
    /// The file at `path` as it is now.
    pub(super) fn of(path: &Path, by: Writer) -> io::Result<Self> {
        Ok(Self::new(checksum(&mut disk::open(path)?)?, by))
    }

    fn new((bytes, checksum): (u64, u64), by: Writer) -> Self {
        Self { by, bytes, checksum: format!("{checksum:016x}") }
    }
}

impl Ownership {
    /// Why a new file cannot take the name; `None` where it can.
    pub(super) fn refusal(self) -> Option<&'static str> {
        match self {
            Self::Absent | Self::AsWritten => None,
            Self::Changed => Some("was changed since percoat wrote it"),
            Self::Foreign => Some("is not listed as a result of percoat (in .percoat/written.json)"),
        }
    }
}

impl Files {
    /// Adds a file of a step by the checksum of its bytes.
    pub(super) fn add(&mut self, name: String, sum: Checksum) {
        self.0.insert(name, FileRecord::new(sum.finish(), Writer::Solve));
    }

    /// Adds a file, or replaces the one of its name.
    pub(super) fn insert(&mut self, name: &str, file: FileRecord) {
        self.0.insert(name.to_owned(), file);
    }

    /// Adds the files of another list.
    pub(super) fn append(&mut self, mut other: Self) {
        self.0.append(&mut other.0);
    }

    /// The files whose name and writer fulfil a condition.
    pub(super) fn filtered(mut self, condition: impl Fn(&str, Writer) -> bool) -> Self {
        self.0.retain(|name, file| condition(name, file.by));
        self
    }

    /// Whether the list has no file.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether the list has a file of this name.
    pub fn has(&self, name: &str) -> bool {
        self.0.contains_key(name)
    }

    /// Names of the files, sorted.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// Owner of the name in `folder`.
    pub(super) fn ownership(&self, folder: &Path, name: &str) -> io::Result<Ownership> {
        // A link or a file in the place of a parent folder is a user's.
        for part in parents(name) {
            if found(&folder.join(part))?.is_some_and(|there| !there.is_dir()) {
                return Ok(Ownership::Foreign);
            }
        }
        let path = folder.join(name);
        Ok(match (found(&path)?, self.0.get(name)) {
            (None, _) => Ownership::Absent,
            (Some(_), None) => Ownership::Foreign,
            (Some(there), Some(file)) => {
                let is_same = there.is_file() && there.len() == file.bytes && FileRecord::of(&path, file.by)? == *file;
                if is_same { Ownership::AsWritten } else { Ownership::Changed }
            }
        })
    }

    /// Names of the files that are in `folder` as they were written.
    pub(super) fn as_written(&self, folder: &Path) -> Result<Vec<&str>, OutputError> {
        let mut names = Vec::new();
        for name in self.names() {
            if self.ownership(folder, name).at(&folder.join(name))? == Ownership::AsWritten {
                names.push(name);
            }
        }
        Ok(names)
    }

    /// Damage of a file that was changed since it was written, is missing or cannot be read; `None` for one as written.
    pub(super) fn damage(&self, folder: &Path, name: &str) -> Option<String> {
        match self.ownership(folder, name) {
            Ok(Ownership::AsWritten) => None,
            Ok(Ownership::Absent) => Some("is missing".to_owned()),
            Ok(Ownership::Changed | Ownership::Foreign) => {
                Some("is not as it was written: its length or checksum is another one".to_owned())
            }
            Err(error) => Some(format!("cannot be read: {error}")),
        }
    }

    /// The first file that is not in `folder` as it was written, and what is wrong with it.
    pub fn damaged(&self, folder: &Path) -> Option<(&str, String)> {
        self.names().find_map(|name| Some((name, self.damage(folder, name)?)))
    }
}

/// The parent folders of a name, innermost first, relative to the folder of the list.
pub(super) fn parents(name: &str) -> impl Iterator<Item = &Path> {
    Path::new(name).ancestors().skip(1).filter(|part| !part.as_os_str().is_empty())
}

/// Whether a name is a relative path that stays within its folder.
pub(super) fn is_inside(name: &str) -> bool {
    !name.is_empty() && Path::new(name).components().all(|part| matches!(part, Component::Normal(_)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn only_what_is_listed_and_unchanged_is_percoats() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let mut files = Files::default();
        for name in ["kept", "changed", "replaced", "gone"] {
            fs::write(path(name), "content").unwrap();
            files.insert(name, FileRecord::of(&path(name), Writer::Solve).unwrap());
        }
        fs::write(path("changed"), "CONTENT").unwrap();
        fs::remove_file(path("replaced")).unwrap();
        fs::create_dir(path("replaced")).unwrap();
        fs::remove_file(path("gone")).unwrap();
        fs::write(path("mine"), "content").unwrap();
        for name in ["mine/below", "linked/below", "folder/below"] {
            files.insert(name, FileRecord::of(&path("kept"), Writer::Solve).unwrap());
        }
        fs::create_dir(path("folder")).unwrap();
        #[cfg(unix)]
        std::os::unix::fs::symlink(path("folder"), path("linked")).unwrap();
        #[cfg(not(unix))]
        fs::write(path("linked"), "").unwrap();
        let ownership = |name: &str| files.ownership(folder.path(), name).unwrap();
        let found = ["kept", "changed", "replaced", "gone", "mine"].map(ownership);
        let below = ["mine/below", "linked/below", "folder/below"].map(ownership);
        use Ownership::{Absent, AsWritten, Changed, Foreign};
        assert_eq!(found, [AsWritten, Changed, Changed, Absent, Foreign]);
        assert_eq!(below, [Foreign, Foreign, Absent], "below a file, a link and a folder");
    }
}
