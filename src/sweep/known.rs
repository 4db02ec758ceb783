use super::row::Row;
use super::study::{Study, folder_of};
use crate::output::{self, COMBINATIONS, OutputError, disk};
use crate::plain;
use std::collections::{HashMap, HashSet};
use std::io;
use std::path::Path;

/// Rows of an earlier sweep, sorted by whether they can be used.
#[derive(Debug, Default)]
pub struct Known {
    /// Combinations that are not solved again.
    pub rows: Vec<Row>,
    /// Damaged files of other rows, each with what is wrong with it.
    pub damaged: Vec<String>,
}

impl Study<'_> {
    /// The rows that are results of this sweep, under its numbers. Combinations that failed are not known; with fields neither are
    /// those whose files in the folder `from` of the rows are missing, under another number, or damaged ([`Known::damaged`]).
    pub fn known(&self, rows: &[Row], from: &Path) -> Known {
        let by_print: HashMap<&str, &Row> =
            rows.iter().filter(|row| !row.results.is_empty()).map(|row| (row.fingerprint.as_str(), row)).collect();
        let mut found = Known::default();
        for planned in &self.planned {
            let combination = &self.combinations.all[planned.index];
            let Some(row) = by_print.get(planned.fingerprint.as_str()) else { continue };
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
            let settings = self.settings(combination);
            found.rows.push(Row { combination: combination.number, settings, ..Row::clone(row) });
        }
        found
    }

    /// Whether a combination that is not `known` has files in the folder `from`: it was killed before its row was written, or the row
    /// is lost. The files would be in the way of its solution.
    pub fn has_unlogged(&self, known: &[Row], from: &Path) -> bool {
        let known: HashSet<usize> = known.iter().map(|row| row.combination).collect();
        let numbers = self.planned.iter().map(|planned| self.combinations.all[planned.index].number);
        let unlogged = |number: usize| !known.contains(&number) && output::is_released(&from.join(folder_of(number)));
        self.keeps_fields && numbers.into_iter().any(unlogged)
    }

    /// Gives the files of known combinations a second name in the staging folder `to`.
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
            let planned = self.planned.iter().find(|own| self.combinations.all[own.index].number == row.combination);
            for name in planned.map_or(&[][..], |planned| &planned.files) {
                let [old, new] = [from, to].map(|place| place.join(&folder).join(name));
                if row.files.has(name) && disk::link(&old, &new).is_err() {
                    output::write_file(&new, |writer| io::copy(&mut disk::open(&old)?, writer).map(|_| ()))?;
                }
            }
            disk::sync_folder(&place).map_err(|error| OutputError::new(&place, error))?;
        }
        // The names are on the disk before the log lists them.
        let all = to.join(COMBINATIONS);
        let synced =
            if known.is_empty() { Ok(()) } else { disk::sync_folder(&all).and_then(|()| disk::sync_folder(to)) };
        synced.map_err(|error| OutputError::new(&all, error))
    }
}
