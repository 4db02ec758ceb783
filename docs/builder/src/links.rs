//! The links of the built book: every file and anchor that a page names is there.

use anyhow::Result;
use regex::Regex;
use std::collections::{HashMap, HashSet};
use std::fs;
use std::path::{Component, Path, PathBuf};

/// A text for each link that leads nowhere; `with_page`: whether the page that computes is built.
pub fn broken(book: &Path, with_page: bool) -> Result<Vec<String>> {
    let link = Regex::new(r#"(?:href|src)="([^"]*)""#)?;
    let anchor = Regex::new(r#"\bid="([^"]+)""#)?;
    let files = crate::source::files(book)?;
    let mut texts: HashMap<PathBuf, String> = HashMap::new();
    for path in files.iter().filter(|path| path.extension().is_some_and(|ending| ending == "html")) {
        // The page that computes has everything in itself.
        if !path.starts_with("page") {
            texts.insert(path.clone(), fs::read_to_string(book.join(path))?);
        }
    }
    let anchors: HashMap<&PathBuf, HashSet<&str>> = texts
        .iter()
        .map(|(path, text)| {
            (path, anchor.captures_iter(text).map(|found| found.get(1).map_or("", |name| name.as_str())).collect())
        })
        .collect();
    let there: HashSet<&PathBuf> = files.iter().collect();
    let mut broken = Vec::new();
    for (path, text) in &texts {
        for found in link.captures_iter(text) {
            let target = found[1].replace("&amp;", "&");
            let is_outside =
                ["http:", "https:", "mailto:", "data:", "javascript:"].iter().any(|scheme| target.starts_with(scheme));
            if is_outside || target.is_empty() {
                continue;
            }
            let (file, name) = target.split_once('#').unwrap_or((&target, ""));
            let file = file.split('?').next().unwrap_or_default();
            let file = if file.is_empty() { path.clone() } else { resolved(path, file) };
            if file.starts_with("page") && !with_page {
                continue;
            }
            let is_there = there.contains(&file)
                && (name.is_empty() || anchors.get(&file).is_none_or(|names| names.contains(name)));
            // The page for a missing address names the others from the root of a site.
            if !is_there && path.as_os_str() != "404.html" {
                broken.push(format!("{}: the link {target} leads nowhere", path.display()));
            }
        }
    }
    broken.sort();
    broken.dedup();
    Ok(broken)
}

/// The file that a link of a page means, relative to the book.
fn resolved(page: &Path, link: &str) -> PathBuf {
    let joined = page.parent().unwrap_or(Path::new("")).join(link);
    let mut path = PathBuf::new();
    for part in joined.components() {
        match part {
            Component::ParentDir => {
                path.pop();
            }
            Component::Normal(part) => path.push(part),
            _ => {}
        }
    }
    if link.ends_with('/') { path.join("index.html") } else { path }
}
