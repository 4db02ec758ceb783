//! `percoat merge`: the parts of a sweep, joined to the table of the whole.

use super::ending::{Ending, Failure};
use super::options::Saying;
use super::pictures::PictureOptions;
use super::results::Results;
use super::sweep_files::{finish, may_write};
use super::terminal::tell;
use percoat_app::output::{SWEEP_LOG, Writer, damaged_results, disk};
use percoat_app::sweep::{Description, Part, PartError, Row, UNFINISHED, join};
use percoat_common::plain;
use std::path::{Path, PathBuf};

impl From<PartError> for Failure {
    fn from(error: PartError) -> Self {
        match error {
            PartError::Input { path, error } => Self::Input { path, error },
            refused => Self::refused(refused),
        }
    }
}

pub fn run(
    folders: &[PathBuf],
    output: Option<&Path>,
    pictures: &PictureOptions,
    saying: Saying,
) -> Result<Ending, Failure> {
    let parts: Vec<Vec<Part>> = folders.iter().map(|folder| parts(folder)).collect::<Result<_, _>>()?;
    let first = parts[0][0].description.clone();
    for (found, folder) in parts.iter().zip(folders) {
        if let Some(key) = found.iter().find_map(|part| difference(&part.description, &first)) {
            return Err(Failure::refused(format!(
                "{} and {} are not parts of one sweep: `{key}` in their sweep.json differs",
                plain::path(&folders[0]),
                plain::path(folder)
            )));
        }
    }
    if first.percoat != env!("CARGO_PKG_VERSION") {
        return Err(Failure::refused(format!(
            "{} was written by percoat {}, and this is {}: merge its parts with that version, or compute them again",
            plain::path(&folders[0]),
            first.percoat,
            env!("CARGO_PKG_VERSION")
        )));
    }
    let parts: Vec<Part> = parts.into_iter().flatten().collect();
    let seconds: f64 = parts.iter().map(|part| part.description.timing.wall).sum();
    let (rows, twice) = join(parts)?;
    if twice > 0 && !saying.quiet {
        tell!("note: {twice} combinations stand in several parts, with the same results");
    }
    let folder = output.map_or_else(|| common_parent(folders), |folder| Ok(folder.to_owned()))?;
    let results = Results::claim(folder, may_write(Writer::Merge, pictures), saying)?;
    let of = first.of;
    let ending = finish(results, &rows, &first.after(&rows, seconds), pictures)?;
    if rows.len() < of {
        tell!("warning: {} of {of} combinations are missing: {}", of - rows.len(), missing(&rows, of));
        return Ok(Ending::NotConverged);
    }
    Ok(ending)
}

/// The first key of `sweep.json` that describes the whole sweep and differs between two parts.
fn difference(one: &Description, other: &Description) -> Option<&'static str> {
    let [one, other] = [one, other].map(|it| {
        let of = it.of.to_string();
        [
            ("fingerprint", it.fingerprint.clone()),
            ("case", it.case.clone()),
            ("title", it.title.clone()),
            ("task", it.task.name().to_owned()),
            ("of", of),
            ("percoat", it.percoat.clone()),
        ]
    });
    one.iter().zip(&other).find(|(one, other)| one != other).map(|((key, _), _)| *key)
}

/// The parts of a sweep in a folder: a finished one, an unfinished one, or both of the same sweep.
fn parts(folder: &Path) -> Result<Vec<Part>, Failure> {
    let unfinished = folder.join(UNFINISHED);
    if let (Some((name, reason)), true) = (damaged(folder), disk::is_file(&folder.join("sweep.json"))) {
        let path = folder.join(name);
        let first = if path.exists() { "move it away and " } else { "" };
        let path = plain::path(&path);
        return Err(Failure::refused(format!("{path} {reason}; {first}give the command of this part again")));
    }
    if let Some(there) = disk::found(&unfinished).ok().flatten().filter(|there| !there.is_dir()) {
        return Err(Failure::refused(format!(
            "{} is {}, where percoat keeps a folder of its own: move it away",
            plain::path(&unfinished),
            disk::kind(&there)
        )));
    }
    let found: Vec<Part> = [Part::read(folder)?, Part::read(&unfinished)?].into_iter().flatten().collect();
    match &found[..] {
        [] => Err(Failure::refused(format!(
            "{} holds no sweep: give the folders that `percoat sweep --shard` wrote",
            plain::path(folder)
        ))),
        [finished, begun] if finished.description.fingerprint != begun.description.fingerprint => {
            Err(Failure::refused(format!(
                "{} holds a finished sweep and an unfinished one of another: finish this with --resume, or move one away",
                plain::path(folder)
            )))
        }
        _ => Ok(found),
    }
}

/// Name and damage of a file of a finished part that is not as percoat wrote it there.
fn damaged(folder: &Path) -> Option<(String, String)> {
    damaged_results(folder).into_iter().find(|(name, _)| ["sweep.json", SWEEP_LOG].contains(&name.as_str()))
}

/// The folder that holds the folders of all parts.
fn common_parent(folders: &[PathBuf]) -> Result<PathBuf, Failure> {
    let parents: Vec<Option<&Path>> = folders.iter().map(|folder| folder.parent()).collect();
    match parents[0] {
        // Names alone stand in the working folder.
        Some(parent) if parents.iter().all(|parent| *parent == parents[0]) => {
            Ok(if parent == Path::new("") { PathBuf::from(".") } else { parent.to_owned() })
        }
        _ => Err(Failure::refused("the parts are in different folders: give the folder of the whole with -o")),
    }
}

/// The numbers of missing combinations, the first twelve of them.
fn missing(rows: &[Row], of: usize) -> String {
    const LISTED: usize = 12;
    let there: std::collections::BTreeSet<usize> = rows.iter().map(|row| row.combination).collect();
    let missing: Vec<String> = (1..=of).filter(|number| !there.contains(number)).map(|n| n.to_string()).collect();
    let more = if missing.len() > LISTED { ", …" } else { "" };
    missing[..missing.len().min(LISTED)].join(", ") + more
}
