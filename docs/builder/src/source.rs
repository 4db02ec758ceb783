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
        let directory = folder.join(&inside);
        for entry in fs::read_dir(&directory).with_context(|| directory.display().to_string())? {
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

/// Copies the pictures of the page `from` that stand in the repository outside of the book into the folder `repository` beside its
/// copy `to`; the page with its new paths.
pub fn with_pictures(text: &str, from: &Path, to: &Path) -> Result<String> {
    let folder = |file: &Path| file.parent().unwrap_or(Path::new("")).to_owned();
    let mut text = text.to_owned();
    for name in pictures(&text).into_iter().filter(|name| name.starts_with("../")) {
        let target = format!("repository/{}", name.trim_start_matches("../"));
        let copy = folder(to).join(&target);
        crate::make_parent(&copy)?;
        fs::copy(folder(from).join(&name), copy).with_context(|| name.clone())?;
        text = text.replace(&format!("({name})"), &format!("({target})"));
    }
    Ok(text)
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
