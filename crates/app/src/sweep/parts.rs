//! Parts of a sweep, read and joined to the whole.

use super::log::{Damage, Logged, read};
use super::row::Row;
use super::table::Description;
use crate::output::{SWEEP_LOG, disk, is_staging};
use percoat_common::plain;
use serde_json::json;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::io;
use std::path::{Path, PathBuf};

/// Why a folder is no part of a sweep, or two are not of the same one.
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
        /// The damage of the file, as the words behind its name.
        reason: String,
    },
    /// Two parts have different results of one combination.
    #[error(
        "{first} and {second} have different results of {named}: they are not parts of one sweep, or were solved by \
         processors of different kinds, which differ in the last digits; give one of both"
    )]
    Unlike {
        /// Log and line of one of them.
        first: String,
        /// Log and line of the other.
        second: String,
        /// Number and settings of the combination.
        named: String,
    },
}

/// The advice on a damaged file.
fn advice(path: &Path) -> &'static str {
    let is_begun = path.parent().is_some_and(|place| place.ends_with(UNFINISHED));
    if is_begun {
        "give the command of this part again with --resume, which solves again what is damaged"
    } else {
        "move it away and give the command of this part again"
    }
}

/// Folder of a sweep that is not finished, in the folder of its result.
pub const UNFINISHED: &str = "unfinished-sweep";

/// A part of a sweep in a folder, finished or not.
#[derive(Debug)]
pub struct Part {
    /// The content of its `sweep.json`.
    pub description: Description,
    log: PathBuf,
    lines: Vec<Logged>,
}

impl Part {
    /// The part in a folder; `None` without `sweep.json`. Every line of its log must be as it was written and of the sweep of
    /// `sweep.json`, which for a finished part also has the number of lines.
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
        let lines = read(&log).map_err(|error| input(&log, error))?;
        if !is_staging(place) && description.combinations > 0 && matches!(disk::found(&log), Ok(None)) {
            return Err(damaged(&log, ", which has the rows of the sweep, is missing".to_owned()));
        }
        let (whole, identity) = (lines.len(), description.identity());
        let line = |logged: Result<Logged, Damage>| {
            let logged = logged.map_err(|damage| damaged(&log, format!(", {damage}")))?;
            let (number, combination) = (logged.line, logged.row.combination);
            if logged.sweep != identity {
                let reason = format!(
                    ", line {number}: combination {combination} is not of the sweep that sweep.json beside it describes"
                );
                return Err(damaged(&log, reason));
            }
            if combination > description.of {
                let of = description.of;
                return Err(damaged(&log, format!(", line {number}: there is no combination {combination} of {of}")));
            }
            Ok(logged)
        };
        let lines = lines.into_iter().map(line).collect::<Result<Vec<_>, _>>()?;
        if !is_staging(place) && whole != description.combinations {
            let wanted = description.combinations;
            return Err(damaged(&log, format!(" has {whole} lines, and sweep.json beside it tells of {wanted}")));
        }
        Ok(Some(Self { description, log, lines }))
    }

    /// Rows of the part, by ascending number.
    pub fn rows(self) -> Vec<Row> {
        let mut rows: Vec<Row> = self.lines.into_iter().map(|logged| logged.row).collect();
        rows.sort_by_key(|row| row.combination);
        rows
    }
}

/// Rows of several parts, one for each combination, by ascending number; and the number of combinations with equal results in
/// two parts.
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
                    let (first, known) = there.get();
                    let is_same_case = known.fingerprint == row.fingerprint && known.settings == row.settings;
                    // Two solutions have the same results, unless one of them failed. In JSON a number that is none equals itself.
                    let is_equal = || json!(known.results) == json!(row.results);
                    let is_alike = known.results.is_empty() || row.results.is_empty() || is_equal();
                    if !is_same_case || !is_alike {
                        let (first, named) = (first.clone(), row.named());
                        return Err(PartError::Unlike { first, second: at, named });
                    }
                    twice += usize::from(!known.results.is_empty() && !row.results.is_empty());
                    if known.results.is_empty() {
                        there.insert((at, row));
                    }
                }
            }
        }
    }
    Ok((rows.into_values().map(|(_, row)| row).collect(), twice))
}

#[cfg(test)]
mod tests {
    use super::super::examples::{row, step};
    use super::super::result::SweepResult;
    use super::*;
    use percoat_core::spectral::Stop;

    /// One row of a part, with one step.
    fn logged(penetration: f64) -> Logged {
        let mut record = step(0.2, None, 0.5);
        (record.reading.penetration, record.stop) = (penetration, Stop::NotANumber);
        Logged { line: 1, sweep: String::new(), row: row(1, &[], vec![SweepResult::Step(Box::new(record))]) }
    }

    #[test]
    fn equal_results_are_joined_where_a_number_is_none() {
        let description = || Description::new("", "", super::super::Task::Solve, String::new(), 1);
        let part = |line| Part { description: description(), log: PathBuf::new(), lines: vec![line] };
        assert_eq!(join(vec![part(logged(f64::NAN)), part(logged(f64::NAN))]).unwrap().1, 1);
        assert!(join(vec![part(logged(f64::NAN)), part(logged(0.1))]).is_err());
    }
}
