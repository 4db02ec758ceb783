//! `percoat merge`: the parts of a sweep, joined to the table of the whole.

use super::ending::{Ending, Failure};
use super::interruption;
use super::options::Saying;
use super::pictures::PictureOptions;
use super::sweep;
use super::terminal::{self, tell};
use crate::output::{RunFolder, SWEEP_LOG, disk};
use crate::plain;
use crate::sweep::{Asked, Row, description, join, read};
use serde_json::Value;
use std::path::{Path, PathBuf};

pub fn run(
    folders: &[PathBuf],
    output: Option<&Path>,
    pictures: &PictureOptions,
    saying: &Saying,
) -> Result<Ending, Failure> {
    let parts = folders.iter().map(|folder| part(folder)).collect::<Result<Vec<_>, _>>()?;
    let (descriptions, parts): (Vec<Value>, Vec<Vec<Row>>) = parts.into_iter().unzip();
    let first = &descriptions[0];
    let same = |key: &str| descriptions.iter().zip(folders).find(|(own, _)| own[key] != first[key]);
    for key in ["fingerprint", "case", "task", "of", "percoat"] {
        if let Some((_, other)) = same(key) {
            return Err(Failure::refused(format!(
                "{} and {} are not parts of one sweep: `{key}` in their sweep.json differs",
                plain::path(&folders[0]),
                plain::path(other)
            )));
        }
    }
    let rows = join(parts.into_iter()).map_err(Failure::refused)?;
    let folder = output.map_or_else(|| common_parent(folders), |folder| Ok(folder.to_owned()))?;
    interruption::watch();
    let claim = RunFolder::claim(&folder, sweep::plan(pictures))?;
    terminal::tell_aside(claim.set_aside(), saying.quiet);
    let text = |key: &str| first[key].as_str().unwrap_or_default();
    let seconds: f64 = descriptions.iter().filter_map(|own| own["timing"]["wall"].as_f64()).sum();
    let of = first["of"].as_u64().unwrap_or_default() as usize;
    let asked =
        Asked { title: text("title"), case: text("case"), task: text("task"), fingerprint: text("fingerprint"), of };
    let description = description(asked, &rows, seconds);
    sweep::finish(claim, &folder, &rows, &description, pictures, saying.quiet)?;
    sweep::print(&rows, &description, &folder, saying)?;
    if rows.len() < of {
        tell!("warning: {} of {of} combinations are missing: {}", of - rows.len(), missing(&rows, of));
        return Ok(Ending::NotConverged);
    }
    Ok(sweep::ending(&rows))
}

/// The description and the rows of a part, finished or not.
fn part(folder: &Path) -> Result<(Value, Vec<Row>), Failure> {
    let unfinished = folder.join("unfinished-sweep");
    if let Some(own) = disk::found(&unfinished).ok().flatten().filter(|own| !own.is_dir()) {
        return Err(Failure::refused(format!(
            "{} is {}, where percoat keeps a folder of its own: move it away",
            plain::path(&unfinished),
            disk::kind(&own)
        )));
    }
    match (read_part(folder)?, read_part(&unfinished)?) {
        (Some((finished, _)), Some((begun, _))) if finished["fingerprint"] != begun["fingerprint"] => {
            Err(Failure::refused(format!(
                "{} holds a finished sweep and an unfinished one of another: finish this with --resume, or move one away",
                plain::path(folder)
            )))
        }
        (Some((description, rows)), Some((_, more))) => {
            let rows = join([rows, more].into_iter()).map_err(Failure::refused)?;
            Ok((description, rows))
        }
        (Some(own), None) | (None, Some(own)) => Ok(own),
        (None, None) => Err(Failure::refused(format!(
            "{} holds no sweep: give the folders that `percoat sweep --shard` wrote",
            plain::path(folder)
        ))),
    }
}

/// Those in a place, if it has any.
fn read_part(place: &Path) -> Result<Option<(Value, Vec<Row>)>, Failure> {
    let path = place.join("sweep.json");
    if matches!(disk::found(&path), Ok(None)) {
        return Ok(None);
    }
    let text = disk::read_text(&path).map_err(|error| Failure::Input { path: path.clone(), error })?;
    let description = serde_json::from_str(&text)
        .map_err(|error| Failure::refused(format!("{} is no description of a sweep: {error}", plain::path(&path))))?;
    let log = place.join(SWEEP_LOG);
    // A part that was killed before its first combination has no log.
    let rows = if matches!(disk::found(&log), Ok(None)) {
        Vec::new()
    } else {
        read(&log).map_err(|error| Failure::Input { path: log, error })?
    };
    Ok(Some((description, rows)))
}

/// The folder in which all parts stand.
fn common_parent(folders: &[PathBuf]) -> Result<PathBuf, Failure> {
    let parents: Vec<Option<&Path>> = folders.iter().map(|folder| folder.parent()).collect();
    match parents[0] {
        // Names alone stand in the working folder.
        Some(parent) if parents.iter().all(|own| *own == parents[0]) => {
            Ok(if parent == Path::new("") { PathBuf::from(".") } else { parent.to_owned() })
        }
        _ => Err(Failure::refused("the parts stand in different folders: say with -o where the whole shall be")),
    }
}

/// The numbers of combinations that are not there, the first some.
fn missing(rows: &[Row], of: usize) -> String {
    /// Numbers told.
    const TOLD: usize = 12;
    let there: std::collections::BTreeSet<usize> = rows.iter().map(|row| row.combination).collect();
    let missing: Vec<String> = (1..=of).filter(|number| !there.contains(number)).map(|n| n.to_string()).collect();
    let more = if missing.len() > TOLD { ", …" } else { "" };
    missing[..missing.len().min(TOLD)].join(", ") + more
}
