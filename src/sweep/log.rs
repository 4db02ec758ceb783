//! `sweep.jsonl`: every combination that is done, one line each, appended when it is.
//!
//! Whatever ends the sweep, every line that ends is a whole one; what a kill left of one more is cut off when the sweep goes on.

use super::row::Row;
use crate::output::disk::{self, Appended};
use crate::output::{OutputError, SWEEP_LOG as LOG, whole_lines, write_text};
use crate::plain;
use std::io;
use std::path::{Path, PathBuf};

/// The log of a sweep that goes on.
#[derive(Debug)]
pub struct Log {
    path: PathBuf,
    /// Open from the first row on.
    file: Option<Appended>,
}

impl Log {
    /// Begins the log in a folder, with the rows that are known already. The file is there from the first row on.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn begin(folder: &Path, known: &[Row]) -> Result<Self, OutputError> {
        let mut log = Self { path: folder.join(LOG), file: None };
        if !known.is_empty() {
            log.open(&known.iter().map(line).collect::<String>())?;
        }
        Ok(log)
    }

    /// Appends a combination.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn add(&mut self, row: &Row) -> Result<(), OutputError> {
        match &mut self.file {
            Some(file) => file.add(line(row).as_bytes()).map_err(|error| OutputError::new(&self.path, error)),
            None => self.open(&line(row)),
        }
    }

    /// The file and its first lines come at once.
    fn open(&mut self, text: &str) -> Result<(), OutputError> {
        write_text(&self.path, text)?;
        let failed = |error| OutputError::new(&self.path, error);
        self.file = Some(Appended::open(&self.path).map_err(failed)?);
        self.path.parent().map_or(Ok(()), disk::sync_folder).map_err(failed)
    }
}

fn line(row: &Row) -> String {
    serde_json::to_string(row).expect("a row is numbers and texts under names") + "\n"
}

/// The rows of a log, those of whole lines.
///
/// # Errors
/// When it cannot be read, or a whole line is none of a log.
pub fn read(path: &Path) -> io::Result<Vec<Row>> {
    let whole = whole_lines(path)?;
    let row = |(number, line): (usize, &String)| {
        serde_json::from_str(line).map_err(|error| {
            let reason = format!("{}, line {number} is none of a sweep: {error}", plain::path(path));
            io::Error::new(io::ErrorKind::InvalidData, reason)
        })
    };
    (1..).zip(&whole).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::super::row::Status;
    use super::*;
    use serde_json::json;

    fn row(combination: usize) -> Row {
        Row {
            combination,
            settings: vec![("a.b".to_owned(), "0.1".to_owned())],
            fingerprint: "00".to_owned(),
            status: Status::Done,
            reason: None,
            warnings: vec!["thin".to_owned()],
            results: vec![json!({"mean_pressure": 0.1 + 0.2})],
            seconds: 1.5,
        }
    }

    #[test]
    fn a_log_is_read_back_bit_for_bit_but_for_what_a_kill_left_of_a_line() {
        let folder = tempfile::tempdir().unwrap();
        let mut log = Log::begin(folder.path(), &[row(1)]).unwrap();
        log.add(&row(2)).unwrap();
        // Killed within a letter.
        log.file.as_mut().unwrap().add(&"{\"combination\": 3, \"µ".as_bytes()[..21]).unwrap();
        let path = folder.path().join(LOG);
        assert_eq!(read(&path).unwrap(), [row(1), row(2)]);
        // Going on cuts it off.
        let mut log = Log::begin(folder.path(), &read(&path).unwrap()).unwrap();
        log.add(&row(3)).unwrap();
        assert_eq!(read(&path).unwrap(), [row(1), row(2), row(3)]);
        std::fs::write(&path, "{\"steps\": 3}\n").unwrap();
        assert!(read(&path).unwrap_err().to_string().contains("line 1"));
    }
}
