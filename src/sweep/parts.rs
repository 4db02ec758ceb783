//! Parts of a sweep, read and joined to the whole.

use super::log::{Damage, Logged, read};
use super::row::Row;
use super::table::Description;
use crate::output::{SWEEP_LOG, disk, is_staging};
use crate::plain;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::io;
use std::path::{Path, PathBuf};

/// Why a part cannot be read, or does not belong to the sweep of another.
#[derive(Debug, thiserror::Error)]
pub enum PartError {
    /// A file cannot be read.
    #[error("cannot read {}: {error}", plain::path(path))]
    Input {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        error: io::Error,
    },
    /// A file was changed since the sweep wrote it.
    #[error("{}{reason}; {advice}", plain::path(path), advice = advice(path))]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// Two parts have different results of one combination.
    #[error(
        "{first} and {second} have different results of {named}: they are not parts of one sweep, or were solved by \
         processors of different kinds, which differ in the last digits; give one of both"
    )]
    Unlike {
        /// One log and its line.
        first: String,
        /// The other log and its line.
        second: String,
        /// The combination.
        named: String,
    },
}

/// Advice for a damaged part.
fn advice(path: &Path) -> &'static str {
    let is_begun = path.parent().is_some_and(|place| place.ends_with(UNFINISHED));
    if is_begun {
        "give the command of this part again with --resume, which solves again what is damaged"
    } else {
        "move it away and give the command of this part again"
    }
}

/// Name of the staging folder of a sweep.
pub const UNFINISHED: &str = "unfinished-sweep";

/// A part of a sweep in a folder, finished or not.
#[derive(Debug)]
pub struct Part {
    /// Its `sweep.json`.
    pub description: Description,
    log: PathBuf,
    lines: Vec<Logged>,
}

impl Part {
    /// Reads the part in a folder; `None` where there is none. Every line of its log must be undamaged and of the described sweep, and
    /// their number that of a finished part.
    ///
    /// # Errors
    /// [`PartError`] with the file, and its line.
    pub fn read(place: &Path) -> Result<Option<Self>, PartError> {
        let (path, log) = (place.join("sweep.json"), place.join(SWEEP_LOG));
        if matches!(disk::found(&path), Ok(None)) {
            return Ok(None);
        }
        let input = |path: &Path, error| PartError::Input { path: path.to_owned(), error };
        let damaged = |path: &Path, reason: String| PartError::Damaged { path: path.to_owned(), reason };
        let bytes = disk::read(&path).map_err(|error| input(&path, error))?;
        let description: Description = serde_json::from_slice(&bytes)
            .map_err(|error| damaged(&path, format!(" is no description of a sweep: {error}")))?;
        // A part that was killed before its first combination has no log.
        let lines = match disk::found(&log) {
            Ok(None) => Vec::new(),
            _ => read(&log).map_err(|error| input(&log, error))?,
        };
        let (whole, identity) = (lines.len(), description.identity());
        let line = |own: Result<Logged, Damage>| {
            let own = own.map_err(|damage| damaged(&log, format!(", {damage}")))?;
            let (number, combination) = (own.line, own.row.combination);
            if own.sweep != identity {
                let reason = format!(
                    ", line {number}: combination {combination} is not of the sweep that sweep.json beside it describes"
                );
                return Err(damaged(&log, reason));
            }
            if combination > description.of {
                let of = description.of;
                return Err(damaged(&log, format!(", line {number}: there is no combination {combination} of {of}")));
            }
            Ok(own)
        };
        let lines = lines.into_iter().map(line).collect::<Result<Vec<_>, _>>()?;
        if !is_staging(place) && whole != description.combinations {
            let wanted = description.combinations;
            return Err(damaged(&log, format!(" has {whole} lines, and sweep.json beside it tells of {wanted}")));
        }
        Ok(Some(Self { description, log, lines }))
    }
}

impl Part {
    /// Rows of the part, by ascending number.
    pub fn rows(self) -> Vec<Row> {
        let mut rows: Vec<Row> = self.lines.into_iter().map(|own| own.row).collect();
        rows.sort_by_key(|row| row.combination);
        rows
    }
}

/// Rows of several parts, one a combination, by ascending number; and the number of rows that occur in two parts.
///
/// # Errors
/// [`PartError::Unlike`] where two parts have different results of one combination.
pub fn join(parts: Vec<Part>) -> Result<(Vec<Row>, usize), PartError> {
    let (mut rows, mut twice): (BTreeMap<usize, (String, Row)>, _) = (BTreeMap::new(), 0);
    for Part { log, lines, .. } in parts {
        for Logged { line, row, .. } in lines {
            let at = format!("{}, line {line}", plain::path(&log));
            match rows.entry(row.combination) {
                Entry::Vacant(place) => drop(place.insert((at, row))),
                Entry::Occupied(mut there) => {
                    let (first, own) = there.get();
                    let is_same_case = own.fingerprint == row.fingerprint && own.settings == row.settings;
                    // Results of one combination are equal, unless one of them failed.
                    let is_alike = own.results.is_empty() || row.results.is_empty() || own.results == row.results;
                    if !is_same_case || !is_alike {
                        let (first, named) = (first.clone(), row.named());
                        return Err(PartError::Unlike { first, second: at, named });
                    }
                    twice += usize::from(!own.results.is_empty() && !row.results.is_empty());
                    if own.results.is_empty() {
                        there.insert((at, row));
                    }
                }
            }
        }
    }
    Ok((rows.into_values().map(|(_, row)| row).collect(), twice))
}
