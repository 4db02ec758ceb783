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

/// The words and numbers of a picture in SVG, a line each.
pub fn words(svg: &str) -> String {
    let word = Regex::new(r"<text[^>]*>([^<]*)").expect("a regular expression");
    word.captures_iter(svg).map(|found| format!("{}\n", &found[1])).collect()
}

/// A path in a page, beside its file.
pub fn beside(page: &Path, name: &str) -> PathBuf {
    page.parent().unwrap_or(Path::new("")).join(name)
}

/// Copies a file into a folder that is made.
pub fn copy(from: &Path, to: &Path) -> Result<()> {
    crate::make_parent(to)?;
    fs::copy(from, to).with_context(|| from.display().to_string())?;
    Ok(())
}

/// Copies the pictures of the page `from` that stand in the repository outside of the book into the folder `repository` beside its
/// copy `to`; the page with its new paths.
pub fn with_pictures(text: &str, from: &Path, to: &Path) -> Result<String> {
    let mut text = text.to_owned();
    for name in pictures(&text).into_iter().filter(|name| name.starts_with("../")) {
        let target = format!("repository/{}", name.trim_start_matches("../"));
        copy(&beside(from, &name), &beside(to, &target))?;
        text = text.replace(&format!("({name})"), &format!("({target})"));
    }
    Ok(text)
}

/// Copies a folder with everything in it.
pub fn copy_folder(from: &Path, to: &Path) -> Result<()> {
    for path in files(from)? {
        copy(&from.join(&path), &to.join(&path))?;
    }
    Ok(())
}
