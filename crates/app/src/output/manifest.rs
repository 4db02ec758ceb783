//! `.percoat/written.json`: the list of the files of finished results in an output folder.

use super::files::{Files, Ownership, is_inside};
use super::layout::LIST;
use super::writer::Writer;
use super::{OutputError, disk, draft, write_text};
use serde::{Deserialize, Serialize};
use std::io;
use std::path::Path;

/// The content of the list.
#[derive(Serialize, Deserialize)]
struct Manifest {
    /// The version that wrote it.
    percoat: String,
    files: Files,
}

/// The files of a list; `None` where it cannot be read. Names that lead outside the folder are left out.
pub(super) fn read(path: &Path) -> Option<Files> {
    let list: Manifest = serde_json::from_str(&disk::read_text(path).ok()?).ok()?;
    Some(list.files.filtered(|name, _| is_inside(name)))
}

/// Writes a list, as indented JSON.
pub(super) fn write(path: &Path, files: Files) -> Result<(), OutputError> {
    let list = Manifest { percoat: env!("CARGO_PKG_VERSION").to_owned(), files };
    let text = serde_json::to_string_pretty(&list).expect("names, checksums and writers are texts");
    write_text(path, &(text + "\n"))
}

/// Removes what killed runs have left of a list that they were writing.
pub(super) fn remove_drafts(folder: &Path) {
    draft::remove_drafts(&folder.join(LIST), "{\n  \"percoat\": \"");
}

/// The published files of an output folder; none where its list cannot be read, so that in doubt no file is percoat's.
pub(super) fn published(folder: &Path) -> Files {
    read(&folder.join(LIST)).unwrap_or_default()
}

/// Whether a file of a folder is as percoat wrote it with its `result`; always true where no list has the result, as in a copy.
///
/// # Errors
/// When the file cannot be read.
pub fn is_beside(result: &str, folder: &Path, name: &str) -> io::Result<bool> {
    let files = published(folder);
    Ok(!files.has(result) || files.ownership(folder, name)? == Ownership::AsWritten)
}

/// Published files of the folder itself, not of folders in it, that are missing or were changed, each with what is wrong with it.
/// Reports are left out.
pub fn damaged_results(folder: &Path) -> Vec<(String, String)> {
    let files = published(folder).filtered(|name, by| by != Writer::Report && !name.contains('/'));
    files.names().filter_map(|name| Some((name.to_owned(), files.damage(folder, name)?))).collect()
}

#[cfg(test)]
mod tests {
    use super::super::files::FileRecord;
    use super::super::layout::OWN;
    use super::*;
    use std::fs;

    #[test]
    fn a_list_survives_json_and_a_broken_or_reaching_one_owns_nothing() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join(OWN)).unwrap();
        let file = folder.path().join(LIST);
        fs::write(&file, "content").unwrap();
        let mut files = Files::default();
        for name in ["a", "../b", "/c", "d/e", "d/../../f", "..", ""] {
            files.insert(name, FileRecord::of(&file, Writer::Compare).unwrap());
        }
        write(&file, files).unwrap();
        assert_eq!(published(folder.path()).names().collect::<Vec<_>>(), ["a", "d/e"]);
        assert!(published(folder.path()).filtered(|_, by| by == Writer::Solve).is_empty());
        let text = fs::read_to_string(&file).unwrap();
        fs::write(&file, &text[..40]).unwrap();
        assert!(published(folder.path()).is_empty());
    }
}
