//! The combinations of an earlier sweep that are not solved again.

use super::log::read;
use super::row::Row;
use super::study::{Study, folder_of};
use crate::output::{self, COMBINATIONS, OutputError, SWEEP_LOG, disk};
use percoat_common::plain;
use std::collections::{HashMap, HashSet};
use std::io;
use std::path::Path;

/// The part of an earlier sweep that this one goes on with.
#[derive(Debug, Default)]
pub struct Known {
    /// Combinations that are not solved again, under the numbers of this sweep.
    pub rows: Vec<Row>,
    /// Number of combinations with results in the log, of this sweep or not.
    pub solved: usize,
    /// Damaged lines of the log, then damaged files of combinations, each with its path and damage.
    pub damaged: Vec<String>,
    /// Whether the log has results, and all of them are of another sweep.
    pub is_foreign: bool,
}

impl Study<'_> {
    /// The combinations of this sweep with results in the log of the folder `from`. A combination that failed is solved
    /// again; where fields are kept, so is one without files under its number in that folder, or with
    /// [damaged](Known::damaged) ones.
    ///
    /// # Errors
    /// When the log cannot be read.
    pub fn known(&self, from: &Path) -> io::Result<Known> {
        let (mut found, mut by_print, log) = (Known::default(), HashMap::new(), from.join(SWEEP_LOG));
        for line in read(&log)? {
            match line {
                Ok(logged) if logged.row.results.is_empty() => {}
                Ok(logged) => {
                    found.solved += 1;
                    by_print.insert(logged.row.fingerprint.clone(), logged.row);
                }
                Err(damage) => found.damaged.push(format!("{}, {damage}", plain::path(&log))),
            }
        }
        let damaged_lines = found.damaged.len();
        for planned in &self.planned {
            let combination = planned.combination;
            let Some(row) = by_print.get(&planned.fingerprint) else { continue };
            if self.keeps_fields {
                // A row without files is of a sweep without fields.
                if row.combination != combination.number || row.files.is_empty() {
                    continue;
                }
                let fields = from.join(folder_of(combination.number));
                if let Some((name, reason)) = row.files.damaged(&fields) {
                    found.damaged.push(format!("{} {reason}", plain::path(&fields.join(name))));
                    continue;
                }
            }
            let settings = self.combinations.named_values(combination);
            found.rows.push(Row { combination: combination.number, settings, ..Row::clone(row) });
        }
        found.is_foreign = found.rows.is_empty() && found.solved > 0 && found.damaged.len() == damaged_lines;
        Ok(found)
    }

    /// Whether a combination that is none of the `known` ones has files in the folder `from`: the sweep was killed before the
    /// row of the combination was written, or the row is lost. These files would be in the way of the solution.
    pub fn has_unlogged(&self, known: &[Row], from: &Path) -> bool {
        let known: HashSet<usize> = known.iter().map(|row| row.combination).collect();
        let numbers = self.planned.iter().map(|planned| planned.combination.number);
        let unlogged = |number: usize| !known.contains(&number) && output::is_released(&from.join(folder_of(number)));
        self.keeps_fields && numbers.into_iter().any(unlogged)
    }

    /// Links or copies the files of `known` combinations from one folder to another.
    ///
    /// # Errors
    /// [`OutputError`] with the path.
    pub fn take_over(&self, known: &[Row], from: &Path, to: &Path) -> Result<(), OutputError> {
        if !self.keeps_fields || from == to {
            return Ok(());
        }
        for row in known {
            let folder = folder_of(row.combination);
            let place = to.join(&folder);
            output::make_folder(&place)?;
            let planned = self.planned.iter().find(|planned| planned.combination.number == row.combination);
            for name in planned.map_or(&[][..], |planned| &planned.files) {
                let [old, new] = [from, to].map(|place| place.join(&folder).join(name));
                if row.files.has(name) && disk::link(&old, &new).is_err() {
                    output::write_file(&new, |writer| io::copy(&mut disk::open(&old)?, writer).map(|_| ()))?;
                }
            }
            disk::sync_folder(&place).map_err(|error| OutputError::new(&place, error))?;
        }
        // The log will name them as finished.
        let all = to.join(COMBINATIONS);
        let synced =
            if known.is_empty() { Ok(()) } else { disk::sync_folder(&all).and_then(|()| disk::sync_folder(to)) };
        synced.map_err(|error| OutputError::new(&all, error))
    }
}
