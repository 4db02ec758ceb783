//! `steps.jsonl`: every step of an unfinished run, one line each, appended as it is done.
//!
//! A line is the step as it will stand in `summary.json`. Whatever ends the run, the lines that end are whole steps, and
//! the file has one at least: where it stands, a step is finished.

use super::{OutputError, write_text};
use crate::run::StepRecord;
use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Name of the file.
pub(super) const NAME: &str = "steps.jsonl";

/// The steps of an unfinished run.
#[derive(Debug)]
pub(super) struct StepsLog {
    path: PathBuf,
    /// Open from the first step on.
    file: Option<File>,
}

impl StepsLog {
    /// No steps yet; `folder` is where the result is gathered.
    pub(super) fn new(folder: &Path) -> Self {
        Self { path: folder.join(NAME), file: None }
    }

    /// Appends a step. Refused when the first one finds steps there already.
    pub(super) fn add(&mut self, record: &StepRecord) -> Result<(), OutputError> {
        let line = serde_json::to_string(record).expect("a step is numbers and texts under names") + "\n";
        let failed = |error| OutputError::new(&self.path, error);
        match &mut self.file {
            Some(file) => file.write_all(line.as_bytes()).map_err(failed),
            None if self.path.exists() => Err(failed(io::ErrorKind::AlreadyExists.into())),
            None => {
                // The first line and the file come at once.
                write_text(&self.path, &line)?;
                self.file = Some(OpenOptions::new().append(true).open(&self.path).map_err(failed)?);
                Ok(())
            }
        }
    }
}
