//! The sources of the book: their files, and the pictures that they show.

use anyhow::{Context, Result};
use regex::Regex;
use std::fs;
use std::path::{Path, PathBuf};

/// All files of a folder, relative to it, sorted.
pub fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    let mut folders = vec![PathBuf::new()];
    while let Some(inside) = folders.pop() {
        let own = folder.join(&inside);
        for entry in fs::read_dir(&own).with_context(|| own.display().to_string())? {
            let entry = entry?;
            let path = inside.join(entry.file_name());
            if entry.file_type()?.is_dir() { folders.push(path) } else { files.push(path) }
        }
    }
    files.sort();
    Ok(files)
}

/// The pictures that a page shows, by their paths in it.
pub fn pictures(text: &str) -> Vec<String> {
    let picture = Regex::new(r"!\[[^\]]*\]\(([^)\s]+)\)").expect("a regular expression");
    picture.captures_iter(text).map(|found| found[1].to_owned()).collect()
}

/// Copies the pictures of the page `from` that stand in the repository outside of the book beside its copy `to`, under the same paths.
pub fn copy_pictures(text: &str, from: &Path, to: &Path) -> Result<()> {
    let beside = |file: &Path, name: &str| file.parent().unwrap_or(Path::new("")).join(name);
    for name in pictures(text).into_iter().filter(|name| name.starts_with("..")) {
        let (own, copy) = (beside(from, &name), beside(to, &name));
        crate::make_parent(&copy)?;
        fs::copy(&own, &copy).with_context(|| own.display().to_string())?;
    }
    Ok(())
}

/// Copies a folder with everything in it.
pub fn copy_folder(from: &Path, to: &Path) -> Result<()> {
    for path in files(from)? {
        let copy = to.join(&path);
        crate::make_parent(&copy)?;
        fs::copy(from.join(&path), copy)?;
    }
    Ok(())
}
