//! `steps.jsonl`: every step of an unfinished run, one line each, appended as it is done.
//!
//! A line is the step as it will stand in `summary.json`. Whatever ends the run, the lines that end are whole steps.

use super::OutputError;
use crate::run::StepRecord;
use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Name of the file.
pub(super) const NAME: &str = "steps.jsonl";

/// The steps of an unfinished run.
#[derive(Debug)]
pub struct StepsLog {
    path: PathBuf,
    /// Open from the first step on: where the file stands, a step is finished.
    file: Option<File>,
}

impl StepsLog {
    /// No steps yet; `folder` is where the result is gathered.
    pub fn new(folder: &Path) -> Self {
        Self { path: folder.join(NAME), file: None }
    }

    /// Appends a step.
    ///
    /// # Errors
    /// [`OutputError`] when it cannot be written, or when the first one finds steps there already.
    pub fn add(&mut self, record: &StepRecord) -> Result<(), OutputError> {
        // Numbers and texts: nothing that JSON could refuse.
        let line = serde_json::to_string(record).unwrap_or_default() + "\n";
        self.append(&line).map_err(|error| OutputError::new(&self.path, error))
    }

    fn append(&mut self, line: &str) -> io::Result<()> {
        let file = match &mut self.file {
            Some(file) => file,
            none => none.insert(OpenOptions::new().write(true).create_new(true).open(&self.path)?),
        };
        file.write_all(line.as_bytes())
    }
}
