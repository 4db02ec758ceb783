//! `steps.jsonl`: every step of an unfinished run, one line each, appended as it is done.
//!
//! A line is the record of the step as in `summary.json`, with the data for resuming the run: number, load, fingerprint of the
//! run, files with their checksums, and a [checksum](super::trailer) of the line. A step is finished when its line is terminated.

use super::error::AtPath;
use super::json::read_back;
use super::log::{LineLog, whole_lines};
use super::trailer::{with_checksum, without_checksum};
use super::{Files, OutputError};
use percoat_core::load::Load;
use percoat_core::reading::Histogram;
use percoat_core::run::StepRecord;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::Path;

/// Name of the file.
pub(super) const NAME: &str = "steps.jsonl";

/// The steps of an unfinished run.
#[derive(Debug)]
pub(super) struct StepsLog {
    log: LineLog,
    /// [Fingerprint](super::fingerprint) of the run; none where it cannot be resumed.
    run: Option<String>,
    /// Number of steps in the log.
    steps: usize,
}

/// A line of the log.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct LoggedStep {
    #[serde(flatten)]
    pub(super) identity: StepIdentity,
    #[serde(flatten)]
    pub(super) record: StepRecord,
    /// The histograms of a topography, which the serialised record leaves out.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    histograms: Vec<Histogram>,
    pub(super) files: Files,
}

/// Step, run and load of a line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct StepIdentity {
    /// Number of the step, from 1.
    pub(super) step: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) run: Option<String>,
    pub(super) load: Prescribed,
}

/// A load, as prescribed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Prescribed {
    MeanPressure(f64),
    Force(f64),
    Penetration(f64),
    Grip(f64),
}

impl From<Load> for Prescribed {
    fn from(load: Load) -> Self {
        match load {
            Load::MeanPressure(value) => Self::MeanPressure(value),
            Load::Force(value) => Self::Force(value),
            Load::Penetration(value) => Self::Penetration(value),
            Load::Grip { position, .. } => Self::Grip(position),
        }
    }
}

impl StepsLog {
    /// The log in a staging folder after the first `steps` steps of an interrupted run, none in a new one.
    pub(super) fn new(folder: &Path, run: Option<String>, steps: usize) -> Result<Self, OutputError> {
        let path = folder.join(NAME);
        let lines = if steps > 0 { whole_lines(&path).at(&path)? } else { Vec::new() };
        let known = lines.into_iter().take(steps).map(|line| line + "\n").collect();
        Ok(Self { log: LineLog::new(path, known), run, steps })
    }

    /// Appends a step with its files.
    pub(super) fn add(&mut self, load: Load, record: &StepRecord, files: Files) -> Result<(), OutputError> {
        let histograms = record.rough.as_ref().map_or(Vec::new(), |rough| rough.histograms.clone());
        self.steps += 1;
        let identity = StepIdentity { step: self.steps, run: self.run.clone(), load: load.into() };
        let line = serde_json::to_string(&LoggedStep { identity, record: record.clone(), histograms, files });
        let line = with_checksum(&line.expect("a step is numbers and texts under names")) + "\n";
        self.log.add(&line)
    }
}

/// Reads a line of a log; an error where it was changed since it was written.
pub(super) fn logged(line: &str) -> Result<LoggedStep, String> {
    let object = without_checksum(line).map_err(|error| error.to_string())?;
    let value: Value = serde_json::from_str(&object).map_err(|error| error.to_string())?;
    let mut line: LoggedStep = read_back(&value).map_err(|error| error.to_string())?;
    if let Some(rough) = &mut line.record.rough {
        rough.histograms = std::mem::take(&mut line.histograms);
    }
    line.record.check().map_err(|reason| format!("step {}: {reason}", line.identity.step))?;
    Ok(line)
}
