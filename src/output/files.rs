//! Files that belong together, each with its length and checksum: what a step or a combination has left.

use super::checksum::Checksum;
use super::layout::own;
use super::manifest::{Manifest, Standing, Writer, Written};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io;
use std::path::Path;

/// Files by their names within a folder, as they were written.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Files(BTreeMap<String, Written>);

impl Files {
    /// Those that a writer has published in a folder.
    pub(super) fn published(folder: &Path, writer: Writer) -> Self {
        let list = Manifest::read(&own(folder, "written.json"));
        Self(list.files(writer).map(|(name, file)| (name.clone(), file.clone())).collect())
    }

    /// Adds a file of a step whose bytes have been added to a checksum.
    pub(super) fn add(&mut self, name: String, sum: Checksum) {
        self.0.insert(name, Written::added(sum, Writer::Solve));
    }

    /// Adds those of another list.
    pub(super) fn append(&mut self, mut other: Self) {
        self.0.append(&mut other.0);
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether there is one of this name.
    pub fn has(&self, name: &str) -> bool {
        self.0.contains_key(name)
    }

    /// Their names, sorted.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// The first one that is not in the folder as it was written, and what is the matter with it.
    pub fn damaged(&self, folder: &Path) -> Option<(&str, String)> {
        let mut list = Manifest::empty();
        self.0.iter().for_each(|(name, file)| list.add(name, file.clone()));
        self.names().find_map(|name| Some((name, damage(list.standing(folder, name))?)))
    }
}

/// What is the matter with a file that percoat wrote; one that the disk does not give any more is damaged too.
fn damage(standing: io::Result<Standing>) -> Option<String> {
    match standing {
        Ok(Standing::Written) => None,
        Ok(Standing::Absent) => Some("is missing".to_owned()),
        Ok(Standing::Changed | Standing::Foreign) => {
            Some("is not as it was written: its length or checksum is another one".to_owned())
        }
        Err(error) => Some(format!("cannot be read: {error}")),
    }
}

/// Files that percoat has published in the folder itself, not below it, and that do not stand there as it wrote them, each with
/// what is the matter with it.
pub fn unlike_published(folder: &Path) -> Vec<(String, String)> {
    let list = Manifest::read(&own(folder, "written.json"));
    let writers = Writer::ALL.into_iter().filter(|writer| *writer != Writer::Report);
    let names = writers.flat_map(|writer| list.names(writer)).filter(|name| !name.contains('/'));
    names.filter_map(|name| Some((name.to_owned(), damage(list.standing(folder, name))?))).collect()
}
