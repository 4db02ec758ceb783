//! What percoat wrote into an output folder as finished results: `.percoat/written.json`.
//!
//! A file is percoat's as long as its length and checksum are those listed. Everything else is its owner's: a file that
//! is not listed, one that was changed since, and a folder or a link in its place.

use super::checksum::{Checksum, checksum};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io;
use std::path::{Component, Path};

use super::disk::{self, found};

/// A command that leaves a result in an output folder. Each replaces its own files alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Writer {
    /// `percoat solve`.
    Solve,
    /// `percoat check`.
    Check,
    /// `percoat compare`.
    Compare,
    /// `percoat limit`.
    Limit,
    /// `percoat validate`.
    Validate,
    /// `percoat sweep`, and `percoat merge`.
    Sweep,
    /// `percoat report`.
    Report,
}

impl Writer {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Solve, Self::Check, Self::Compare, Self::Limit, Self::Validate, Self::Sweep, Self::Report];

    /// Whose files go when this one's result is replaced: its own, and the report, which shows the old one.
    pub(super) fn takes_along(self) -> &'static [Self] {
        match self {
            Self::Solve => &[Self::Solve, Self::Report],
            Self::Check => &[Self::Check],
            Self::Compare => &[Self::Compare],
            Self::Limit => &[Self::Limit, Self::Report],
            Self::Validate => &[Self::Validate],
            Self::Sweep => &[Self::Sweep, Self::Report],
            Self::Report => &[Self::Report],
        }
    }
}

/// The list of files, by name.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Manifest {
    percoat: String,
    files: BTreeMap<String, Written>,
}

/// A file as it was written.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Written {
    by: Writer,
    bytes: u64,
    checksum: String,
}

/// Earlier files of a writer that its new result replaces, by the beginnings of their names.
#[derive(Debug, Clone, Default)]
pub struct Scope {
    /// How all of them begin; every name does where it is empty.
    pub within: String,
    /// How those begin that stay as they are.
    pub except: Vec<String>,
}

impl Scope {
    pub(super) fn contains(&self, name: &str) -> bool {
        name.starts_with(&self.within) && !self.except.iter().any(|kept| name.starts_with(kept))
    }
}

/// Whose a name in the folder is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Standing {
    /// Nobody's: there is nothing of that name.
    Absent,
    /// As percoat wrote it.
    Written,
    /// Written by percoat and changed since.
    Changed,
    /// Not written by percoat as a finished result.
    Foreign,
}

impl Manifest {
    /// A list without files.
    pub(super) fn empty() -> Self {
        Self { percoat: env!("CARGO_PKG_VERSION").to_owned(), files: BTreeMap::new() }
    }

    /// The list at `path`; an empty one where there is none that can be read, so that in doubt no file is percoat's.
    pub(super) fn read(path: &Path) -> Self {
        Self::at(path).unwrap_or_else(Self::empty)
    }

    /// The list at `path`, if there is one that can be read.
    pub(super) fn at(path: &Path) -> Option<Self> {
        let mut list: Self = serde_json::from_str(&disk::read_text(path).ok()?).ok()?;
        // Nothing outside the folder, whoever wrote the list.
        list.files.retain(|name, _| is_inside(name));
        Some(list)
    }

    /// As indented JSON.
    pub(super) fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("names, checksums and writers are texts") + "\n"
    }

    /// The files of all other writers, and those of this one whose names are not in `scope`.
    pub(super) fn without(&self, writer: Writer, scope: &Scope) -> Self {
        let mut others = self.clone();
        others.percoat = Self::empty().percoat;
        others.files.retain(|name, file| file.by != writer || !scope.contains(name));
        others
    }

    /// Whether it has a file of that name.
    pub(super) fn has(&self, name: &str) -> bool {
        self.files.contains_key(name)
    }

    /// Whether it has a file as this one, under any name.
    pub(super) fn holds(&self, file: &Written) -> bool {
        self.files.values().any(|own| own == file)
    }

    /// Adds a file.
    pub(super) fn add(&mut self, name: &str, file: Written) {
        self.files.insert(name.to_owned(), file);
    }

    /// Names of a writer's files, sorted.
    pub(super) fn names(&self, writer: Writer) -> impl Iterator<Item = &str> {
        self.files.iter().filter(move |(_, file)| file.by == writer).map(|(name, _)| name.as_str())
    }

    /// A writer's files, sorted by their names.
    pub(super) fn files(&self, writer: Writer) -> impl Iterator<Item = (&String, &Written)> {
        self.files.iter().filter(move |(_, file)| file.by == writer)
    }

    /// Whose the name is in `folder`.
    pub(super) fn standing(&self, folder: &Path, name: &str) -> io::Result<Standing> {
        let path = folder.join(name);
        // Folders that lead to it, outermost first; a link or a file in the place of one is somebody else's.
        let mut above: Vec<&Path> = Path::new(name).ancestors().skip(1).filter(|part| *part != Path::new("")).collect();
        above.reverse();
        for part in above {
            match found(&folder.join(part))? {
                None => return Ok(Standing::Absent),
                Some(part) if !part.is_dir() => return Ok(Standing::Foreign),
                Some(_) => {}
            }
        }
        let Some(found) = found(&path)? else { return Ok(Standing::Absent) };
        let Some(listed) = self.files.get(name) else { return Ok(Standing::Foreign) };
        let same = found.is_file() && found.len() == listed.bytes && Written::of(&path, listed.by)? == *listed;
        Ok(if same { Standing::Written } else { Standing::Changed })
    }
}

/// Whether a name stands in the folder, or in one below it.
pub(super) fn is_inside(name: &str) -> bool {
    !name.is_empty() && Path::new(name).components().all(|part| matches!(part, Component::Normal(_)))
}

impl Written {
    /// The file at `path` as it is now.
    pub(super) fn of(path: &Path, by: Writer) -> io::Result<Self> {
        let (bytes, checksum) = checksum(&mut disk::open(path)?)?;
        Ok(Self { by, bytes, checksum: format!("{checksum:016x}") })
    }

    /// The file that has been added to a checksum while it was written.
    pub(super) fn added(sum: Checksum, by: Writer) -> Self {
        let (bytes, checksum) = sum.finish();
        Self { by, bytes, checksum: format!("{checksum:016x}") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn only_what_is_listed_and_unchanged_is_percoats() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let mut manifest = Manifest::empty();
        for name in ["kept", "changed", "replaced", "gone"] {
            fs::write(path(name), "content").unwrap();
            manifest.add(name, Written::of(&path(name), Writer::Solve).unwrap());
        }
        fs::write(path("changed"), "CONTENT").unwrap();
        fs::remove_file(path("replaced")).unwrap();
        fs::create_dir(path("replaced")).unwrap();
        fs::remove_file(path("gone")).unwrap();
        fs::write(path("mine"), "content").unwrap();
        for name in ["mine/below", "linked/below", "folder/below"] {
            manifest.add(name, Written::of(&path("kept"), Writer::Solve).unwrap());
        }
        fs::create_dir(path("folder")).unwrap();
        #[cfg(unix)]
        std::os::unix::fs::symlink(path("folder"), path("linked")).unwrap();
        #[cfg(not(unix))]
        fs::write(path("linked"), "").unwrap();
        let standing = |name: &str| manifest.standing(folder.path(), name).unwrap();
        let found = ["kept", "changed", "replaced", "gone", "mine"].map(standing);
        let below = ["mine/below", "linked/below", "folder/below"].map(standing);
        use Standing::{Absent, Changed, Foreign, Written as AsWritten};
        assert_eq!(found, [AsWritten, Changed, Changed, Absent, Foreign]);
        assert_eq!(below, [Foreign, Foreign, Absent], "below a file, a link and a folder");
    }

    #[test]
    fn a_list_survives_json_and_a_broken_or_reaching_one_owns_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("written.json");
        fs::write(&file, "content").unwrap();
        let mut manifest = Manifest::empty();
        for name in ["a", "../b", "/c", "d/e", "d/../../f", "..", ""] {
            manifest.add(name, Written::of(&file, Writer::Compare).unwrap());
        }
        fs::write(&file, manifest.to_json()).unwrap();
        assert_eq!(Manifest::read(&file).names(Writer::Compare).collect::<Vec<_>>(), ["a", "d/e"]);
        assert_eq!(Manifest::read(&file).names(Writer::Solve).count(), 0);
        fs::write(&file, &manifest.to_json()[..40]).unwrap();
        assert_eq!(Manifest::read(&file).names(Writer::Compare).count(), 0);
    }
}
